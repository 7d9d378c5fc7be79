#pragma once
// Calibration of chips: each chip is simulated under a press, its spikes are compared with limits, and its trims (parameters that can be
// set on a finished chip) are set accordingly, as on a tester. The results are given as text and as JSON: for each number of bits, the
// fraction of chips that meet the limits.

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "sweep/subject/firing_limits.hpp"

namespace corpuscle {

/// A parameter that can be set on a finished chip by a binary code. Its value is designed * (1 + range * code / 2^(bits - 1)), with
/// code = -2^(bits - 1) + 1 ... 2^(bits - 1); code 0 is the designed value. With one bit: the designed value or the largest.
struct Trim {
    /// Netlist parameters that all get the value of the trim: "i_leak", or "rect.p1b.m" and "rect.n2b.m".
    std::vector<std::string> names;
    double designed = 0;      ///< value as designed, at code 0
    double range = 0.5;       ///< relative change at the largest code
    bool is_integer = false;  ///< true for a number of columns of an array: the value is rounded to the nearest integer, at least 1

    /// The value with a code of this many bits.
    double value(int code, int bits) const;
};

/// The chips to calibrate, their trims, and the target.
struct ChipCalibration {
    std::string netlist;                            ///< name or path
    std::vector<ParameterOverride> overrides = {};  ///< fixed settings, e.g. the process corner
    std::vector<Trim> trims = {};
    int bits = 4;               ///< maximum number of bits of each trim
    std::vector<double> force;  ///< N, of one press
    double T = 1e-4;            ///< step of `force`, s
    FiringLimits limits;        ///< a chip that meets them needs no further calibration
    circuit::BatchOptions batch = {};
    unsigned threads = 0;  ///< 0: one for each core
    /// Called after each round of presses. `chips_left`: chips whose search is not finished; `presses`: so far, of all chips.
    std::function<void(std::size_t chips_left, std::size_t presses)> on_progress = {};
};

/// The calibration of one chip.
struct CalibratedChip {
    /// codes[k][trim], distance[k]: the best codes found with k bits, and their FiringLimits::distance(). k = 0: without calibration. They
    /// end at the first k with which the chip meets the limits. For every k, the codes are for Trim::value() with ChipCalibration::bits.
    std::vector<std::vector<int>> codes;
    std::vector<double> distance;
    int bits = -1;    ///< smallest number of bits with which the chip meets the limits; 0: without calibration; -1: it never meets them
    int presses = 0;  ///< number of presses simulated in the search
    std::vector<double> spikes_before, spikes;  ///< times since the start of the press without calibration, and with the best codes, s
    bool diverged = false;                      ///< true if the simulation without calibration did not converge
};

/// Calibrates each chip separately, from coarse steps to fine ones: with one bit, then two, and so on. From the best codes so far, each
/// trim is moved one step up or down; then all trims that reduced the distance are moved together. This is repeated until no move reduces
/// the distance. The search ends at the first codes that meet the limits. The search with k bits is the beginning of the search with more
/// bits, so one search gives the result for each number of bits.
Result<std::vector<CalibratedChip>> calibrate(const ChipCalibration&, const std::vector<circuit::ChipSample>& chips);

/// Makes a trim. Its designed value is the value of names[0] in the netlist; an error if the netlist has no such number.
Result<Trim> trim_of(const std::string& netlist, const std::vector<ParameterOverride>&, std::vector<std::string> names, double range,
                     bool is_integer);

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
