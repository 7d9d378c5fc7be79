#pragma once
// Spike-timing error of a train with respect to an exact train, in response to the same stimulus.

#include <vector>

#include "core/error.hpp"

namespace corpuscle {

struct SpikeTimingError {
    double max = 0, rms = 0;  ///< s, largest absolute and rms time difference of matched spikes
    double median = 0;        ///< s, median time difference of matched spikes; positive if `other` is later
    double unmatched = 0;     ///< number of unmatched spikes in both trains together
};

/// Compares two trains (spike times in s, in order). Spikes less than 50 ms apart can be matched.
Result<SpikeTimingError> spike_timing_error(const std::vector<double>& exact, const std::vector<double>& other);

}  // namespace corpuscle
