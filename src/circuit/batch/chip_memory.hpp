#pragma once
// The memory of a block of chips, as the kernels need it. Devices are linearized again when their voltages have moved.

#include <memory>
#include <vector>

#include "circuit/lanes/chip_kernels.hpp"
#include "circuit/solve/elimination.hpp"
#include "circuit/solve/step_equations.hpp"
#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

using lanes::Linearization;

/// A nonlinear device without kernels, for one chip. It is linearized in every iteration.
struct NonlinearDevice {
    std::size_t index;  ///< in the system
    std::vector<int> unknowns;
    std::vector<std::size_t> entries;                                     ///< matrix entry of each derivative; the last entry is ground
    std::vector<double> v, limited_v, linearization, last_linearization;  ///< linearization: i, q, g, c, as in Linearization
};

class ChipMemory {
    std::vector<lanes::LaneRow> rows_;
    std::vector<int> terminals_, row_, column_, slot_, fill_;  // terminals_: unknowns of the transistors' terminals
    std::size_t transistors_;
    std::vector<std::vector<int>> scalar_unknowns_;  // unknowns of each device that is not a transistor
    std::vector<char> voltage_;
    std::vector<std::size_t> entry_;               // matrix entry by index in the sparsity pattern; the last one is for ground
    std::vector<std::size_t> entries_;             // entry of each derivative of the transistors
    std::vector<Linearization> linearizations_;    // [chip][transistor]
    std::vector<lanes::LaneRow> linear_sums_;      // I, G, C of linear devices
    std::vector<const UicmConstants*> constants_;  // [chip][transistor]
    std::vector<std::uint8_t> moved_;
    struct DeviceOnChip {
        std::size_t device, chip;
    };
    std::vector<DeviceOnChip> moved_devices_;
    std::vector<const UicmConstants*> moved_constants_;
    std::vector<lanes::LaneRow> moved_v_;            // voltages of the moved transistors: drains, gates, sources, bulks
    std::vector<Linearization> new_linearizations_;  // new linearizations of the moved transistors
    std::vector<NonlinearDevice> nonlinear_devices_[lanes::chips_per_block];

    void prefetch(const DeviceOnChip&) const;
    void replace_linearization(const DeviceOnChip&, const Linearization& updated);
    void sum_linear_devices(const System&, std::size_t chip, const EvalContext&);

public:
    lanes::ChipBlock block{};
    double linearization_radius = 0;  ///< V: a transistor is linearized again after a terminal voltage has moved this far

    /// For chips with the same connections as this system. `points`: length of the history.
    ChipMemory(const System&, const Elimination&, std::size_t points);
    ChipMemory(const ChipMemory&) = delete;

    std::size_t unknowns() const { return block.unknowns; }
    /// True if the devices of this system have the same unknowns as those of the system passed to the constructor.
    bool is_compatible(const System&) const;
    /// Loads a chip into a column. Its transistors are linearized when they are next needed.
    void load_chip(std::size_t chip, const System&, const EvalContext&);
    /// Sums the linearizations of a chip again, so that rounding errors of the updates do not accumulate.
    void sum_again(std::size_t chip);

    /// Linearizes all transistors that have moved, in the chips of this bit set.
    void relinearize(const lanes::ChipKernels&, std::uint8_t chips, double gmin);
    /// Linearizes the other nonlinear devices of a chip. Returns true if a device's voltages were limited.
    bool relinearize_nonlinear_devices(std::size_t chip, const System&, const EvalContext&, std::vector<double>& limiting_state);
    /// True if the expressions of a chip match their linearizations at x.
    bool expressions_match(std::size_t chip, const System&, const EvalContext&, const ExpressionTolerance&);
};

}  // namespace corpuscle::circuit
