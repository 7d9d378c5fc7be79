#pragma once
// Results of calibrating many chips: yield for each number of bits, as text and as JSON.

#include <nlohmann/json_fwd.hpp>

#include "study/sweep/calibrate.hpp"

namespace corpuscle {

/// One set of trims and its results.
struct CalibrationResult {
    std::vector<Trim> trims;
    std::vector<CalibratedChip> chips;

    /// Number of chips that meet the limits with at most this many bits; 0: without calibration.
    std::size_t count_within_limits(int bits) const;
    long total_presses() const;  ///< of all chips
    /// Mean number of presses of the chips that do not meet the limits without calibration.
    double mean_presses() const;
    std::string names() const;
};

/// A table with one row for each set of trims: yield without calibration and with 1, 2 ... bits, presses. Then the useful number of bits,
/// see useful_bits().
std::string format_calibration(const ChipCalibration&, const std::vector<CalibrationResult>&);
nlohmann::ordered_json document_of(const ChipCalibration&, const std::vector<CalibrationResult>&);

/// The smallest number of bits that is sufficient for 99 % of the chips that meet the limits with `max` bits.
int useful_bits(const CalibrationResult&, int max);

}  // namespace corpuscle
