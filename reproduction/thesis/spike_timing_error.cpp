#include "reproduction/thesis/spike_timing_error.hpp"

#include <algorithm>
#include <cmath>

#include "core/median.hpp"
#include "measure/train_distance.hpp"

namespace corpuscle {

Result<SpikeTimingError> spike_timing_error(const std::vector<double>& exact, const std::vector<double>& other) {
    const auto alignment = TRY(align_trains(exact, other, 2 / 50e-3));  // a cost at which only spikes less than 50 ms apart can be matched
    SpikeTimingError out;
    std::vector<double> delays;
    for (const auto& m : alignment.moved) delays.push_back(other[m.b] - exact[m.a]);
    for (const double t : delays) out.max = std::max(out.max, std::abs(t)), out.rms += t * t / static_cast<double>(delays.size());
    out.rms = std::sqrt(out.rms);
    out.unmatched = static_cast<double>(exact.size() + other.size() - 2 * delays.size());
    if (delays.empty()) return out;
    out.median = median_of(delays);
    return out;
}

}  // namespace corpuscle
