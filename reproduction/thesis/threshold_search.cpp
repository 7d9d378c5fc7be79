#include "reproduction/thesis/threshold_search.hpp"

#include <cmath>

namespace corpuscle {

Result<double> find_threshold(double low, double high, int halvings, SearchScale scale, const std::function<TrialSpec(double)>& trial_at,
                              const std::function<bool(const std::vector<double>& spikes)>& responds) {
    for (int k = 0; k < halvings; ++k) {
        const double middle = scale == SearchScale::linear ? (low + high) / 2 : std::sqrt(low * high);
        const auto spikes = TRY(simulate_train(trial_at(middle)));
        (responds(spikes) ? high : low) = middle;
    }
    return high;
}

}  // namespace corpuscle
