#include "fit/targets/target_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle {
namespace {

/// The spikes in the window.
std::size_t spikes_inside(std::span<const double> train, const TimeWindow& window) {
    return static_cast<std::size_t>(std::count_if(train.begin(), train.end(), [&](double t) { return t >= window.from && t < window.to; }));
}

/// The strength at which is_above() becomes true, to 0.4 %. It must be false below and true above. Infinity: it is never true;
/// minus infinity: it is true at the weakest strength.
template <class F>
Result<double> threshold(const F& is_above) {
    constexpr double ratio = 4;
    double low = weakest, high = weakest;
    while (!TRY(is_above(high))) {
        if (high >= strongest) return std::numeric_limits<double>::infinity();
        low = high, high *= ratio;
    }
    if (low == high) return -std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < 8; ++pass) {
        const double middle = std::sqrt(low * high);
        (TRY(is_above(middle)) ? high : low) = middle;
    }
    return std::sqrt(low * high);
}

/// The least strength with at least `count` spikes in the window.
Result<double> strength_for(const StimulusResponse& r, double count) {
    return threshold(
        [&](double strength) -> Result<bool> { return static_cast<double>(spikes_inside(TRY(r.train(strength)), r.window)) >= count; });
}

double cycles(const StimulusResponse& r) { return CycleMeasure<SingleSpikeSum>::cycles(r.window); }

// One spike in nineteen of twenty cycles counts as one a cycle, because the first or last cycle may lack its spike.
constexpr double some_missing = 0.95, some_extra = 1.05;

Result<double> least_force(const StimulusResponse& r) { return strength_for(r, 1); }
Result<double> least_amplitude(const StimulusResponse& r) { return strength_for(r, some_missing * cycles(r)); }
Result<double> largest_amplitude(const StimulusResponse& r) { return strength_for(r, some_extra * cycles(r)); }
Result<double> plateau_ratio(const StimulusResponse& r) {
    const double least = TRY(least_amplitude(r)), largest = TRY(largest_amplitude(r));
    return std::isfinite(least) && std::isfinite(largest) ? largest / least : no_value;
}
Result<double> min_interval(const StimulusResponse& r) {
    const auto train = TRY(r.train({}));
    double least = no_value;
    for (std::size_t k = 0; k + 1 < train.size(); ++k)
        if (const double d = train[k + 1] - train[k]; train[k] >= r.window.from && train[k + 1] < r.window.to && !(d >= least)) least = d;
    return least;
}

/// The measure with this index in `measures`.
std::function<Result<double>(const StimulusResponse&)> of_train(std::size_t index) {
    return [index](const StimulusResponse& r) -> Result<double> {
        MeasureAccumulator accumulator({r.window}, 1);
        for (const double t : TRY(r.train({}))) accumulator.spike(0, t);
        return accumulator.values(0, 0)[index];
    };
}

std::vector<TargetMeasure> make_measures() {
    std::vector<TargetMeasure> out;
    for (std::size_t k = 0; k < std::size(measures); ++k) {
        const bool needs_cycle = k == measure_index<VectorStrength>() || k == measure_index<Entrainment>();
        out.push_back({measures[k], false, needs_cycle, false, of_train(k)});
    }
    out.push_back({{"min_interval", "least interval", "s", 4, "shortest interval between two spikes of the window"},
                   false,
                   false,
                   false,
                   min_interval});
    out.push_back({{"least_force", "least force", "N", 4, "least strength of the stimulus (F_max, F_amp ...) with a spike in the window"},
                   true,
                   false,
                   true,
                   least_force});
    out.push_back(
        {{"least_amplitude", "least amplitude", "N", 4, "least amplitude with a spike a cycle"}, true, true, true, least_amplitude});
    out.push_back({{"largest_amplitude", "largest amplitude", "N", 4, "largest amplitude with not more than a spike a cycle"},
                   true,
                   true,
                   true,
                   largest_amplitude});
    out.push_back(
        {{"plateau_ratio", "entrainment plateau", "", 2, "largest_amplitude over least_amplitude"}, true, true, true, plateau_ratio});
    return out;
}

}  // namespace

const std::vector<TargetMeasure>& target_measures() {
    static const auto all = make_measures();
    return all;
}

const TargetMeasure* find_target_measure(std::string_view name) {
    for (const auto& m : target_measures())
        if (m.info.name == name) return &m;
    return nullptr;
}

}  // namespace corpuscle
