#pragma once
// The thesis's chips under the press stimulus at many operating conditions, simulated side by side on SIMD lanes.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// An operating condition of a chip.
struct ChipCondition {
    std::string_view corner = "tt";
    double supply = 0.7, celsius = 27;  // V, C
    bool high_threshold = true;         ///< false: with leak mirror and switches of the standard threshold (hv_membrane=0)
    bool operator==(const ChipCondition&) const = default;
};

/// The response of a chip at one condition.
struct ConditionResponse {
    ChipCondition condition;
    std::vector<double> spikes;               ///< times, s
    std::vector<std::string> range_warnings;  ///< OperatingRange::meaning of each range that was violated
    std::string error;                        ///< if it did not converge, else ""
};

/// Simulates a chip ("sa1-circuit") at each condition, and returns the responses in the same order. `progress`: called now and then with
/// the number of finished chips; must return false to stop, which is an error of code `interrupted`.
Result<std::vector<ConditionResponse>> run_conditions(const std::string& chip, const std::vector<ChipCondition>&,
                                                      const std::function<bool(std::size_t)>& progress);

}  // namespace corpuscle
