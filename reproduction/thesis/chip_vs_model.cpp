#include "reproduction/thesis/chip_vs_model.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle {

Result<ChipVsModel> compare_chip_with_model(const TrialSpec& chip_spec, const std::string& model) {
    auto chip = run_trial(chip_spec);
    if (!chip) return chip.error();
    auto train = simulate_train({model});
    if (!train) return train.error();
    return ChipVsModel{std::move(*chip), std::move(*train)};
}

double min_jump_ratio(const StudyCurve& trace, const std::vector<double>& spikes, double duration) {
    double min_ratio = std::numeric_limits<double>::infinity();
    for (const double t : spikes)
        min_ratio = std::min(min_ratio, trace.between(t, t + duration).max() / trace.between(t - 2 * duration, t - duration / 2).max());
    return min_ratio;
}

double longest_time_above(const StudyCurve& trace, double level) {
    double longest = 0, start = NAN;
    for (std::size_t k = 0; k < trace.x.size(); ++k) {
        if (trace.y[k] < level)
            start = NAN;
        else if (std::isnan(start))
            start = trace.x[k];
        else
            longest = std::max(longest, trace.x[k] - start);
    }
    return longest;
}

}  // namespace corpuscle
