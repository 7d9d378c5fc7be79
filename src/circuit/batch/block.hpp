#pragma once
// Chips side by side in memory, as kernels see them: straight lines that are renewed wherever a device has moved.

#include <memory>
#include <vector>

#include "circuit/lanes/chips.hpp"
#include "circuit/solve/elimination.hpp"
#include "circuit/solve/step_equations.hpp"
#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

using lanes::StraightLine;

/// A device that no kernel knows, as a chip has it; looked at anew each time.
struct OtherDevice {
    std::size_t number;  ///< in the system
    std::vector<int> unknowns;
    std::vector<std::size_t> places;              ///< of its slopes, as entries; the last is of ground
    std::vector<double> v, looked, line, before;  ///< line: i, q, g, c, as in StraightLine
};

class ChipMemory {
    std::vector<lanes::Row> rows_;
    std::vector<int> terminals_, row_, column_, slot_, fill_;  // terminals: of transistors
    std::size_t transistors_;
    std::vector<std::vector<int>> alone_;  // unknowns of each device that is no transistor
    std::vector<char> voltage_;
    std::vector<std::size_t> entry_;        // of each place of the pattern, and of ground
    std::vector<std::size_t> places_;       // of transistors' slopes, as entries
    std::vector<StraightLine> lines_;       // [chip][transistor]
    std::vector<lanes::Row> still_;         // I, G, C of linear devices
    std::vector<const UicmConstants*> of_;  // [chip][transistor]
    std::vector<std::uint8_t> moved_;
    struct Picked {
        std::size_t device, chip;
    };
    std::vector<Picked> picked_;
    std::vector<const UicmConstants*> picked_of_;
    std::vector<lanes::Row> at_;       // where those that are picked stand: drains, gates, sources, bulks
    std::vector<StraightLine> fresh_;  // theirs
    std::vector<OtherDevice> others_[lanes::chips];

    void fetch(const Picked&) const;
    void renew(const Picked&, const StraightLine& now);
    void set_linear(const System&, std::size_t chip, const Instant&);

public:
    lanes::ChipBlock block{};
    double far = 0;  ///< V: how far a transistor may move before it is looked at again

    /// Of systems like this one; `points`: how many of the past are kept.
    ChipMemory(const System&, const Elimination&, std::size_t points);
    ChipMemory(const ChipMemory&) = delete;

    std::size_t unknowns() const { return block.unknowns; }
    /// Whether a system has its devices at the same places as the one that this was made for.
    bool fits(const System&) const;
    /// A chip takes its place; its transistors are looked at when they are next needed.
    void seat(std::size_t chip, const System&, const Instant&);
    /// Sums its lines anew, so that what rounding leaves does not add up.
    void freshen(std::size_t chip);

    /// Looks at all transistors that have moved, in those chips, by kernels of this set.
    void look(const lanes::ChipLanes&, std::uint8_t chips, double gmin);
    /// Looks at a chip's other devices; whether one could not be looked at where it stands.
    bool look_at_others(std::size_t chip, const System&, const Instant&, std::vector<double>& memory);
    /// Whether its formulas give at x what their straight lines give there.
    bool formulas_hold(std::size_t chip, const System&, const Instant&, const FormulaTolerance&);
};

}  // namespace corpuscle::circuit
