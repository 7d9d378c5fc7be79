#include "fit/targets/target_problem.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/quantity.hpp"
#include "run/simulate.hpp"

namespace corpuscle {
namespace {

constexpr double deviations_of_range = 1.96;  // from the target to the end of its range: 95 % of a normal distribution
constexpr double worst_deviation = 100;       // of an undefined measure, and the limit of any other

/// A stimulus as samples, as a function of its strength: force = base + strength * shape.
struct ScaledStimulus {
    std::vector<double> force;        // with its own strength, N
    std::vector<double> base, shape;  // empty if the stimulus has no strength
    Clock clock;
};

/// The parameter of the stimulus that is its strength: "sine.F_amp". "": it has none.
std::string strength_parameter(const std::string& stimulus) {
    for (const auto member : stimulus_members(stimulus))
        for (const auto& entry : stimulus_catalog())
            if (entry.name == member)
                for (const std::string_view wanted : {"F_amp", "F_ridge", "F_sd", "F_max"})
                    for (const auto& p : entry.parameters)
                        if (p.name == wanted) return fmt::format("{}.{}", member, wanted);
    return "";
}

Result<ScaledStimulus> scaled_stimulus(const TargetRow& row, const TargetProblemOptions& options, TimeWindow& window) {
    const auto force_of = [&](const std::string& setting) -> Result<std::vector<double>> {
        auto settings = row.settings;
        settings.push_back(TRY(parse_override(setting)));
        const auto source = TRY(make_stimulus(row.stimulus, settings, options.rate, options.seed));
        return read_channel(*source.result);
    };
    const auto source = TRY(make_stimulus(row.stimulus, row.settings, options.rate, options.seed));
    ScaledStimulus out{TRY(read_channel(*source.result)), {}, {}, source.result->clock()};
    window = {0, out.clock.T() * static_cast<double>(out.force.size()), source.result->cycle_frequency()};
    for (const auto& phase : source.result->phases())
        if (phase.name == row.phase) window.from = phase.from, window.to = phase.to;
    if (row.window) window.from = row.window->first, window.to = row.window->second;
    const auto strength = strength_parameter(row.stimulus);
    if (strength.empty() || !row.measure->needs_strength) return out;
    out.base = TRY(force_of(strength + "=0")), out.shape = TRY(force_of(strength + "=1"));
    for (std::size_t k = 0; k < out.shape.size(); ++k) out.shape[k] -= out.base[k];
    return out;
}

class TargetProblem final : public FitProblem {
    struct Target {
        TargetRow row;
        ScaledStimulus stimulus;
        TimeWindow window;
    };
    std::vector<Target> targets_;

    /// The value of an irregular afferent is the mean of several simulations, without those in which it is undefined.
    static Result<double> value_of(const Target& target, const AfferentPlan& plan) {
        if (!plan.traits().is_irregular || target.row.measure->needs_strength) return value_once(target, plan, 0);
        double sum = 0, count = 0;
        for (std::size_t seed = 0; seed < irregular_realisations; ++seed)
            if (const double value = TRY(value_once(target, plan, seed)); !std::isnan(value)) sum += value, ++count;
        return count > 0 ? sum / count : no_value;
    }
    static Result<double> value_once(const Target& target, const AfferentPlan& plan, std::uint64_t seed) {
        const auto afferent = make_afferent(plan, {.dt = target.stimulus.clock.T(), .seed = seed});
        StimulusResponse response;
        response.window = target.window, response.has_strength = !target.stimulus.shape.empty();
        response.train = [&](std::optional<double> strength) -> Result<std::vector<double>> {
            auto force = target.stimulus.force;
            for (std::size_t k = 0; k < force.size() && strength; ++k)
                force[k] = target.stimulus.base[k] + *strength * target.stimulus.shape[k];
            const auto simulated = TRY(simulate(*afferent, force));
            return spike_times(simulated.spikes, target.stimulus.clock);
        };
        return target.row.measure->compute(response);
    }
    /// The deviation from the target, in standard deviations.
    static double deviation(const TargetRow& row, double value) {
        const auto scaled = [&](double x) { return row.measure->is_logarithmic ? num::log(x) : x; };
        if (!std::isfinite(value) || (row.measure->is_logarithmic && !(value > 0))) return worst_deviation;
        const double difference = scaled(value) - scaled(row.value);
        const double up = scaled(row.high) - scaled(row.value), down = scaled(row.value) - scaled(row.low);
        const double range = difference > 0 ? (up > 0 ? up : down) : (down > 0 ? down : up);
        return std::clamp(deviations_of_range * difference / range, -worst_deviation, worst_deviation);
    }

    /// A window must lie within the stimulus.
    static Result<void> check_window(const Target& t) {
        const double end = t.stimulus.clock.T() * static_cast<double>(t.stimulus.force.size());
        if (!t.row.window || (t.window.from >= 0 && t.window.to <= end * (1 + 1e-9))) return {};
        return bad_input(
            fmt::format("the window '{}' is not within {}, which is from 0 to {:.4g} s; write a window within it, such as "
                        "{}@0s..{:.4g}s",
                        t.row.measure_text.substr(t.row.measure_text.find('@') + 1), t.row.stimulus, end, t.row.measure->info.name, end),
            t.row.measure_location);
    }
    /// Why a row has no value, for the user.
    static std::string reason_of(const Target& t, double value) {
        if (std::isfinite(value)) return "";
        if (std::isnan(value)) return "it is undefined for the fitted afferent";
        return value > 0 ? fmt::format("not reached with any strength up to {}", format_quantity(strongest, "N"))
                         : fmt::format(
                               "reached already with the weakest strength that is tried, {}: {} excites the afferent without it, by its "
                               "force at rest or "
                               "its mean, so the measure has no value",
                               format_quantity(weakest, "N"), t.row.stimulus);
    }

public:
    explicit TargetProblem(std::vector<TargetRow> rows) {
        for (auto& row : rows) targets_.push_back({std::move(row), {}, {}});
    }
    Result<void> prepare(const TargetProblemOptions& options) {
        for (auto& t : targets_) {
            t.stimulus = TRY(scaled_stimulus(t.row, options, t.window));
            TRY(check_window(t));
            if (t.row.measure->needs_strength && t.stimulus.shape.empty())
                return bad_input(fmt::format("{} needs a stimulus with a strength, such as ramp-hold or sine", t.row.measure->info.name),
                                 t.row.location);
        }
        return {};
    }

    std::size_t stages() const override { return 2; }
    /// The first stage compresses large deviations, so that one row cannot outweigh all others.
    Result<std::vector<ResidualBlock>> residuals(const AfferentPlan& plan, std::size_t stage) const override {
        std::vector<ResidualBlock> out;
        for (const auto& t : targets_) {
            double r = deviation(t.row, TRY(value_of(t, plan)));
            if (stage == 0) r = std::copysign(num::log(std::abs(r) + std::sqrt(r * r + 1)), r);
            out.push_back({{r * std::sqrt(t.row.weight)}, t.row.is_test});
        }
        return out;
    }
    double slope_effect() const override { return 0.05 * reference_cost(false); }
    bool has_known_deviations() const override { return true; }
    Result<std::vector<FitRow>> rows(const AfferentPlan& plan) const override {
        std::vector<FitRow> out;
        for (const auto& t : targets_) {
            const double value = TRY(value_of(t, plan));
            out.push_back({.data = t.row.settings_text.empty() ? t.row.stimulus : t.row.stimulus + " " + t.row.settings_text,
                           .measure = t.row.measure_text,
                           .unit = std::string(t.row.measure->info.unit),
                           .target = t.row.value,
                           .low = t.row.low,
                           .high = t.row.high,
                           .fitted = value,
                           .is_test = t.row.is_test,
                           .source = t.row.source,
                           .reason = reason_of(t, value)});
        }
        return out;
    }
    double reference_cost(bool is_test) const override {
        double sum = 0;
        for (const auto& t : targets_)
            if (t.row.is_test == is_test) sum += t.row.weight * deviations_of_range * deviations_of_range;
        return sum;
    }
    std::size_t size() const override {
        return static_cast<std::size_t>(std::count_if(targets_.begin(), targets_.end(), [](const Target& t) { return !t.row.is_test; }));
    }
    std::string score_meaning() const override {
        return "mean squared deviation from the targets; 0: all are met, 1: at the ends of their ranges";
    }
};

/// Holds out a fraction of the rows, evenly spread over the table.
void hold_out_rows(std::vector<TargetRow>& rows, double fraction) {
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (std::floor(fraction * static_cast<double>(k + 1)) > std::floor(fraction * static_cast<double>(k))) rows[k].is_test = true;
}

}  // namespace

Result<std::unique_ptr<FitProblem>> make_target_problem(std::vector<TargetRow> rows, const TargetProblemOptions& options) {
    hold_out_rows(rows, options.hold_out);
    auto problem = std::make_unique<TargetProblem>(std::move(rows));
    if (problem->size() == 0) return bad_input("all targets are held out; none is left to fit");
    TRY(problem->prepare(options));
    return std::unique_ptr<FitProblem>(std::move(problem));
}

}  // namespace corpuscle
