#pragma once
// Calibration of chips: each chip is pressed, its spikes are counted, and its trims are set, as a tester would do it.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/netlist_overrides.hpp"
#include "study/sweep/firing_limits.hpp"

namespace corpuscle {

/// A parameter that can be set on a finished chip by a binary code. Its value is designed * (1 + range * code / 2^(bits - 1)), with
/// code = -2^(bits - 1) + 1 ... 2^(bits - 1); code 0 is the designed value. With one bit: the designed value or the largest.
struct Trim {
    std::vector<std::string> names;  ///< numeric netlist parameters: "i_leak"; "rect.p1b.m" and "rect.n2b.m" are switched together
    double designed = 0;
    double range = 0.5;       ///< relative change at the largest code
    bool is_integer = false;  ///< columns of an array: rounded to the nearest integer, at least 1

    double value(int code, int bits) const;
};

/// The chips to calibrate, their trims, and the target.
struct ChipCalibration {
    std::string netlist;
    std::vector<circuit::NetlistOverride> overrides = {};  ///< fixed settings, e.g. the process corner
    std::vector<Trim> trims = {};
    int bits = 4;               ///< maximum number of bits of each trim
    std::vector<double> force;  ///< N, of one press
    double T = 1e-4;            ///< s
    FiringLimits limits;
    circuit::BatchOptions batch = {};
    unsigned threads = 0;  ///< 0: one for each core
    std::function<void(std::size_t chips_left, std::size_t presses)> on_progress = {};
};

/// One chip's calibration. codes[k] and distance[k]: the best result with k bits; index 0 is the chip without calibration.
struct CalibratedChip {
    std::vector<std::vector<int>> codes;  ///< in steps of the finest code
    std::vector<double> distance;
    int bits = -1;                              ///< smallest number with which it meets the limits; 0: without calibration; -1: with none
    int presses = 0;                            ///< total number of presses
    std::vector<double> spikes_before, spikes;  ///< s, before calibration and after
    bool diverged = false;                      ///< did not converge without calibration
};

/// Calibrates each chip separately, from coarse steps to fine ones: with one bit, then two, and so on. From the best codes so far, each
/// trim is moved one step up or down, then all improving trims together, until nothing improves. A chip that meets the limits is finished.
/// A search with many bits begins with the steps of a search with few bits, so one search gives the result for each number of bits.
Result<std::vector<CalibratedChip>> calibrate(const ChipCalibration&, const std::vector<circuit::ChipSample>& chips);

/// A trim whose designed value is the netlist's value of the first name; fails if that is not a number.
Result<Trim> trim_of(const std::string& netlist, const std::vector<circuit::NetlistOverride>&, std::vector<std::string> names, double range,
                     bool is_integer);

}  // namespace corpuscle
