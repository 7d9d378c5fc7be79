#pragma once
// Results of calibrating many chips: yield for each number of bits, as text and as JSON.

#include <nlohmann/json_fwd.hpp>

#include "study/sweep/calibrate.hpp"

namespace corpuscle {

/// One set of trims and its results.
struct CalibrationResult {
    std::vector<Trim> trims;
    std::vector<CalibratedChip> chips;

    std::size_t count_within_limits(
        int bits) const;         ///< number of chips that meet the limits with at most this many bits; 0: without calibration
    long total_presses() const;  ///< of all chips
    /// Mean over the chips that do not meet the limits without calibration.
    double mean_presses() const;
    std::string names() const;
};

/// A table with one row for each set of trims: yield without calibration and with 1, 2 ... bits, presses. Then the useful number of bits,
/// see useful_bits().
std::string describe_frame_error(const ChipCalibration&, const std::vector<CalibrationResult>&);
nlohmann::ordered_json document_of(const ChipCalibration&, const std::vector<CalibrationResult>&);

/// The smallest number of bits with which at most 1 % of the chips fail that meet the limits with all bits.
int useful_bits(const CalibrationResult&, int max);

}  // namespace corpuscle
