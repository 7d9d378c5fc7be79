#pragma once
// Chips brought back to what they were designed for: each is pressed, its spikes are counted, its trims are set, as a tester would do it.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "circuit/batch/chips.hpp"
#include "circuit/knobs.hpp"
#include "study/sweep/pattern.hpp"

namespace corpuscle {

/// What can be set of a chip once it is made, by a binary code: designed * (1 + range * code / 2^(bits - 1)), code from 1 - 2^(bits - 1) to
/// 2^(bits - 1); 0 is as designed. One bit: as designed, or the most.
struct Trim {
    std::vector<std::string> names;  ///< knobs that are numbers: "i_leak"; "rect.p1b.m" and "rect.n2b.m", switched together
    double designed = 0;
    double range = 0.5;  ///< the largest code's share more than designed
    bool whole = false;  ///< columns of an array: to the nearest whole number, 1 at least

    double value(int code, int bits) const;
};

/// Which chips are trimmed, how, and to what.
struct ChipCalibration {
    std::string netlist;
    std::vector<circuit::Knob> knobs = {};  ///< set of it anyhow: its corner
    std::vector<Trim> trims = {};
    int bits = 4;               ///< of each trim, at the most
    std::vector<double> force;  ///< N, of one press
    double T = 1e-4;            ///< s
    FiringLimits limits;
    circuit::BatchOptions batch = {};
    unsigned threads = 0;  ///< 0: as many as there are cores
    std::function<void(std::size_t chips_left, std::size_t presses)> told = {};
};

/// One chip's calibration. codes and distance at k: the best found with k bits, at 0 as it was made.
struct CalibratedChip {
    std::vector<std::vector<int>> codes;  ///< in steps of the finest converter
    std::vector<double> distance;
    int bits = -1;                              ///< with so many it keeps to the limits: 0 as it was made; -1: with none tried
    int presses = 0;                            ///< in all
    std::vector<double> spikes_before, spikes;  ///< s, as it was made and at the last
    bool lost = false;                          ///< as it was made it did not converge
};

/// Each chip by itself, coarse steps before fine ones: with one bit, then two ..., from the best so far one step up or down with each trim,
/// then along all that helped together, until nothing is better. A chip that keeps to the limits is let go. So the first steps with many
/// bits are those with few, and one search tells what each number of bits is worth.
Result<std::vector<CalibratedChip>> calibrate(const ChipCalibration&, const std::vector<circuit::Draw>& chips);

/// The trim with what the netlist has of its first name; refused if that is no number there.
Result<Trim> trim_of(const std::string& netlist, const std::vector<circuit::Knob>&, std::vector<std::string> names, double range,
                     bool whole);

}  // namespace corpuscle
