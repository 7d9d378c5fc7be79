#pragma once
// How far one train is from another that stands for the same touch.

#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

struct Apart {
    double worst = 0, rms = 0;  ///< s, of spikes that stand for each other
    double median = 0;          ///< s, of the same; above 0: the second is late
    double unmatched = 0;       ///< spikes of either without a partner
};

/// Spikes within 50 ms can stand for each other.
Result<Apart> apart(const std::vector<double>& exact, const std::vector<double>& other);

}  // namespace corpuscle
