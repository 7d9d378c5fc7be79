#pragma once
// Copies of one afferent whose parameters vary: each value is sampled from a distribution around the original's value (doc/populations.md).

#include "model/catalog.hpp"

namespace corpuscle {

/// The distribution of one parameter over the copies: a normal one whose mean is the value of the original afferent, or a lognormal one
/// whose median is this value.
struct ParameterDistribution {
    std::string afferent;  ///< AfferentPlan::name of the original
    std::string_view parameter, unit;
    double deviation = 0;                 ///< standard deviation, SI
    std::optional<double> fraction = {};  ///< set if the deviation was given as a percentage of the mean: 0.1 for "10%"
    /// Not set: the distribution is normal. Set: it is lognormal, ln(factor) is the standard deviation of the logarithm, and `deviation` is
    /// not used. 3 for "x3": two thirds of the copies are between a third of the median and three times the median.
    std::optional<double> factor = {};
    /// The spread as the user writes it: "10%", "2.5 Hz", "x3".
    std::string text() const;
    bool operator==(const ParameterDistribution&) const = default;
};

/// The copies that the user requests: how many of each afferent, and how their parameters vary.
struct CopySpec {
    std::uint32_t count = 0;  ///< copies of each afferent; 0: the original afferents themselves are simulated
    std::vector<ParameterDistribution> distributions;
};

inline constexpr std::uint32_t max_copies = 1'000'000;  ///< limit of CopySpec::count

/// The distributions that the values of --spread (`overrides`: "sa1.f_B=10%", "sa1.f_B=2Hz", "sa1.f_B=x1.5") give to the parameters of this
/// plan. Refuses a parameter that all copies share, a percentage or a factor of a value that is 0, and the same parameter twice.
Result<Applied<std::vector<ParameterDistribution>>> distributions_for(const AfferentPlan&, std::span<const ParameterOverride> overrides);

/// Copies 1 to n of a plan, each with its own parameter values. A value depends only on the seed, the names of afferent and parameter, and
/// the number of the copy. A value outside the parameter's range is sampled again. If the values violate an order constraint, all
/// parameters of that constraint are sampled again.
Result<std::vector<AfferentPlan>> make_copies(const AfferentPlan&, std::uint32_t n, std::span<const ParameterDistribution>,
                                              std::uint64_t seed);

/// For plans in which the copies of each afferent follow one another: the index of the first copy of each afferent, then the number of
/// plans. An afferent that is not a copy is a group by itself.
std::vector<std::size_t> copy_group_starts(std::span<const AfferentPlan>);

/// The name of the original if the plan is a copy ("sa1" for "sa1#3"), otherwise the plan's own name.
const std::string& base_name(const AfferentPlan&);

}  // namespace corpuscle
