#pragma once
// Spike-timing error between two trains that respond to the same stimulus.

#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

struct SpikeTimingError {
    double max = 0, rms = 0;  ///< s, over matched spikes
    double median = 0;        ///< s, over matched spikes; positive if the second train is later
    double unmatched = 0;     ///< number of spikes without a partner, of both trains together
};

/// Spikes within 50 ms of each other can be matched.
Result<SpikeTimingError> spike_timing_error(const std::vector<double>& exact, const std::vector<double>& other);

}  // namespace corpuscle
