#pragma once
// The memory of a block of chips, as the kernels need it. Devices are linearized again when their voltages have moved.

#include <memory>
#include <vector>

#include "circuit/lanes/chips.hpp"
#include "circuit/solve/elimination.hpp"
#include "circuit/solve/step_equations.hpp"
#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

using lanes::StraightLine;

/// A nonlinear device without kernels, for one chip. It is linearized in every iteration.
struct OtherDevice {
    std::size_t number;  ///< in the system
    std::vector<int> unknowns;
    std::vector<std::size_t> places;              ///< matrix entry of each derivative; the last entry is ground
    std::vector<double> v, looked, line, before;  ///< linearization: i, q, g, c, as in Linearization
};

class ChipMemory {
    std::vector<lanes::Row> rows_;
    std::vector<int> terminals_, row_, column_, slot_, fill_;  // terminals_: unknowns of the transistors' terminals
    std::size_t transistors_;
    std::vector<std::vector<int>> alone_;  // unknowns of each device that is not a transistor
    std::vector<char> voltage_;
    std::vector<std::size_t> entry_;        // by index in the sparsity pattern, and of ground
    std::vector<std::size_t> places_;       // entry of each derivative of the transistors
    std::vector<StraightLine> lines_;       // [chip][transistor]
    std::vector<lanes::Row> still_;         // I, G, C of linear devices
    std::vector<const UicmConstants*> of_;  // [chip][transistor]
    std::vector<std::uint8_t> moved_;
    struct Picked {
        std::size_t device, chip;
    };
    std::vector<Picked> picked_;
    std::vector<const UicmConstants*> picked_of_;
    std::vector<lanes::Row> at_;       // voltages of the moved transistors: drains, gates, sources, bulks
    std::vector<StraightLine> fresh_;  // new linearizations of the moved transistors
    std::vector<OtherDevice> others_[lanes::chips];

    void fetch(const Picked&) const;
    void renew(const Picked&, const StraightLine& now);
    void set_linear(const System&, std::size_t chip, const Instant&);

public:
    lanes::ChipBlock block{};
    double far = 0;  ///< V: a transistor is linearized again after a terminal voltage has moved this far

    /// For chips with the same connections as this system. `points`: length of the history.
    ChipMemory(const System&, const Elimination&, std::size_t points);
    ChipMemory(const ChipMemory&) = delete;

    std::size_t unknowns() const { return block.unknowns; }
    /// True if the devices of a system have the same unknowns as those of the system that this was made for.
    bool fits(const System&) const;
    /// Loads a chip into a column. Its transistors are linearized when they are next needed.
    void seat(std::size_t chip, const System&, const Instant&);
    /// Sums the linearizations of a chip again, so that rounding errors of the updates do not accumulate.
    void freshen(std::size_t chip);

    /// Linearizes all transistors that have moved, in the chips of this bit set.
    void look(const lanes::ChipLanes&, std::uint8_t chips, double gmin);
    /// Linearizes the other nonlinear devices of a chip. Returns true if a device's voltages were limited.
    bool look_at_others(std::size_t chip, const System&, const Instant&, std::vector<double>& limiting_state);
    /// True if the expressions of a chip match their linearizations at x.
    bool formulas_hold(std::size_t chip, const System&, const Instant&, const FormulaTolerance&);
};

}  // namespace corpuscle::circuit
