#pragma once
// Results of calibrating many chips, as text and as JSON: for each number of bits, the fraction of chips that meet the limits.

#include <nlohmann/json_fwd.hpp>

#include "sweep/calibrate/calibrate.hpp"

namespace corpuscle {

/// One set of trims, and the chips calibrated with it.
struct CalibrationResult {
    std::vector<Trim> trims;
    std::vector<CalibratedChip> chips;

    /// Number of chips that meet the limits with at most this many bits; 0: without calibration.
    std::size_t count_within_limits(int bits) const;
    long total_presses() const;  ///< of all chips
    /// Mean number of presses of the chips that do not meet the limits without calibration; 0 if there are no such chips.
    double mean_presses() const;
    std::string names() const;  ///< the first name of each trim: "i_leak, rect.p1b.m"
};

/// A table with one row for each set of trims: percentage of chips that meet the limits without calibration and with at most 1, 2 ... bits,
/// and mean_presses(). Then, of the first set, the values of each trim and the useful number of bits, see useful_bits().
std::string format_calibration(const ChipCalibration&, const std::vector<CalibrationResult>&);
/// The JSON document of the same results.
nlohmann::ordered_json document_of(const ChipCalibration&, const std::vector<CalibrationResult>&);

/// The smallest number of bits that is enough: with `max_bits` instead, at most 1 % of all chips meet the limits in addition.
int useful_bits(const CalibrationResult&, int max_bits);

}  // namespace corpuscle
