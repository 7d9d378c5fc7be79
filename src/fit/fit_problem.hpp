#pragma once
// The data that an afferent is fitted to: the differences between its response and the data, as residuals.

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// The number of simulations of an irregular afferent (see AfferentTraits), of which its rate or measure is the mean.
inline constexpr std::size_t irregular_realisations = 32;

/// Residuals that belong together: a stretch of time of a recording, or one row of a table of targets. Different blocks are independent.
struct ResidualBlock {
    std::vector<double> residuals;
    bool is_test = false;  ///< held out: not fitted, but scored
};

/// One line of the result: a number of the data and that of the fitted afferent.
struct FitRow {
    std::string data;     ///< the recording and train, or the stimulus with its settings
    std::string measure;  ///< "spikes", "plateau.mean_rate"
    std::string unit = {};
    double target = 0;
    std::optional<double> low = {}, high = {};  ///< the range of the target, if it has one
    double fitted = 0;                          ///< of the fitted afferent; NaN: undefined, for example a latency without a spike
    bool is_test = false;
    std::string source = {};
    std::string reason = {};  ///< why `fitted` has no value, for the user; "" if it has one or no reason is known

    /// Whether the number is in the range of the target; no value if there is no range.
    std::optional<bool> is_within() const {
        if (!low || !high) return {};
        return fitted >= *low && fitted <= *high;
    }
};

/// Data to which parameters are fitted. The functions may be called from several threads at once.
class FitProblem {
public:
    FitProblem() = default;
    FitProblem(const FitProblem&) = delete;
    FitProblem& operator=(const FitProblem&) = delete;
    virtual ~FitProblem() = default;

    /// The number of stages of the search. In an early stage the residuals are less sensitive to details, so that the search finds its way
    /// from far away; the last stage has the residuals that count.
    virtual std::size_t stages() const { return 1; }
    /// The residuals of an afferent, the same blocks for each afferent. The cost of an afferent is the sum of their squares.
    virtual Result<std::vector<ResidualBlock>> residuals(const AfferentPlan&, std::size_t stage) const = 0;
    /// True if repetition() is available for this afferent.
    virtual bool can_repeat(const AfferentPlan&) const { return false; }
    /// The residuals of an imagined repetition: of this afferent with membrane noise (A), instead of the data. They show how data scatter.
    virtual Result<std::vector<ResidualBlock>> repetition(const AfferentPlan&, double /*noise*/, std::uint64_t /*seed*/) const {
        return std::vector<ResidualBlock>();
    }
    /// The effect of the steps over which slopes of the residuals are taken, see linearize(): large where residuals are counts of spikes.
    virtual double slope_effect() const { return 1e-3 * reference_cost(false); }
    /// True if the standard deviation of each residual is known to be 1 where the afferent is right.
    virtual bool has_known_deviations() const { return false; }
    /// The rows of the result for an afferent.
    virtual Result<std::vector<FitRow>> rows(const AfferentPlan&) const = 0;
    /// The cost of the data that are (or are not) held out, at which the score is 1.
    virtual double reference_cost(bool is_test) const = 0;
    /// The number of data: spikes or targets that are not held out.
    virtual std::size_t size() const = 0;
    /// The meaning of the score, for the user: "squared distance ... (0: equal, 1: as far as silence)".
    virtual std::string score_meaning() const = 0;
    /// Warnings about the data, for the afferent that was fitted.
    virtual std::vector<std::string> warnings(const AfferentPlan&) const { return {}; }
    /// Why data of this kind cannot determine the parameter with this name; "" if they may.
    virtual std::string reason_not_determined(std::string_view /*parameter*/) const { return ""; }
};

/// The sum of the squares of the residuals that are (or are not) held out.
double cost_of(std::span<const ResidualBlock>, bool is_test = false);

}  // namespace corpuscle
