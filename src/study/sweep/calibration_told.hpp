#pragma once
// What a calibration of many chips came to: yields with each number of bits, in words and as JSON.

#include <nlohmann/json_fwd.hpp>

#include "study/sweep/calibrate.hpp"

namespace corpuscle {

/// One set of trims and what it did.
struct CalibrationTold {
    std::vector<Trim> trims;
    std::vector<CalibratedChip> chips;

    std::size_t kept(int bits) const;  ///< chips that keep to the limits with so many bits or fewer; 0: as they were made
    long presses() const;              ///< of all chips
    /// Of the chips that did not keep to the limits as they were made: the mean.
    double presses_of_one() const;
    std::string names() const;
};

/// A table, a row a set of trims: yield before and with 1, 2 ... bits, presses. Then how many bits are worth having: the fewest with which
/// the first set keeps as many as with all of them, less one in a hundred.
std::string text_of(const ChipCalibration&, const std::vector<CalibrationTold>&);
nlohmann::ordered_json document_of(const ChipCalibration&, const std::vector<CalibrationTold>&);

/// The fewest bits beyond which no more than a hundredth of the chips is gained.
int bits_worth_having(const CalibrationTold&, int most);

}  // namespace corpuscle
