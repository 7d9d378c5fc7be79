#pragma once
// The memory of a block of chips, as the kernels need it. Transistors are linearized again when their voltages have moved.

#include "circuit/solve/step_equations.hpp"

namespace corpuscle::circuit {

using lanes::Linearization;

/// A nonlinear device of one chip that is not a transistor. It is linearized in every iteration.
struct NonlinearDevice {
    std::size_t index;  ///< in the system
    std::vector<int> unknowns;
    std::vector<std::size_t> entries;  ///< matrix entry of each derivative; for ground the number of entries
    std::vector<double> v, limited_v;  ///< values of its unknowns, before and after limiting
    StampBuffer buffer, last_buffer;
    Stamp last;  ///< i, q, g, c, as in Linearization, that the sums of the block contain; in last_buffer
};

/// The parameter `chip` of the functions is the column of a chip in the block, from 0.
class ChipMemory {
    // The arrays to which the pointers of `block` with similar names refer; rows_ holds all rows.
    std::vector<lanes::LaneRow> rows_;
    std::vector<int> terminals_, row_, column_, slot_, fill_;
    std::size_t transistors_;                        // number of transistors of a chip
    std::vector<std::vector<int>> scalar_unknowns_;  // unknowns of each device that is not a transistor
    std::vector<char> is_voltage_;
    std::vector<std::size_t> diagonal_;            // by unknown, entry of the block
    std::vector<std::size_t> entry_;               // entry of the block, by entry of the sparsity pattern; the last one is for ground
    std::vector<std::size_t> entries_;             // [transistor][16]: entry of the block of each derivative
    std::vector<Linearization> linearizations_;    // [chip][transistor]
    std::vector<lanes::LaneRow> linear_sums_;      // I, G, C of the linear devices, one after another; their Q is 0
    std::vector<const UicmConstants*> constants_;  // [chip][transistor]
    std::vector<std::uint8_t> moved_;              // [transistor]: chips in which it has moved, as bits
    struct DeviceOnChip {
        std::size_t device, chip;
    };
    // The moved transistors of all chips, their constants, voltages (all drains, gates, sources, bulks) and new linearizations.
    std::vector<DeviceOnChip> moved_devices_;
    std::vector<const UicmConstants*> moved_constants_;
    std::vector<lanes::LaneRow> moved_v_;
    std::vector<Linearization> new_linearizations_;
    std::vector<NonlinearDevice> nonlinear_devices_[lanes::chips_per_block];  // by chip

    void prefetch(const DeviceOnChip&) const;
    void replace_linearization(const DeviceOnChip&, const Linearization& updated);
    void sum_linear_devices(const System&, std::size_t chip, const EvalContext&);

public:
    lanes::ChipBlock block{};
    double linearization_radius = 0;  ///< V: a transistor is linearized again after a terminal voltage has moved this far

    /// Memory for chips with the same connections as this system. `points`: length of the history.
    ChipMemory(const System&, const Elimination&, std::size_t points);
    ChipMemory(const ChipMemory&) = delete;

    std::size_t unknowns() const { return block.unknowns; }
    /// The entry of the block on the diagonal in row n.
    std::size_t diagonal(std::size_t n) const { return diagonal_[n]; }
    /// True if the devices of this system have the same unknowns as those of the system passed to the constructor.
    bool is_compatible(const System&) const;
    /// Loads the devices of a chip into its column. Its transistors are linearized at the next relinearize().
    void load_chip(std::size_t chip, const System&, const EvalContext&);
    /// Computes the sums I, Q, G and C of a chip again from its linearizations, so that rounding errors of the updates do not accumulate.
    void sum_again(std::size_t chip);

    /// Linearizes all transistors that have moved by linearization_radius, in the chips of this bit set. gmin: S.
    void relinearize(const lanes::ChipKernels&, std::uint8_t chips, double gmin);
    /// Linearizes the other nonlinear devices of a chip. Returns true if a device's voltages were limited.
    bool relinearize_nonlinear_devices(std::size_t chip, const System&, const EvalContext&, std::vector<double>& limiting_state);
    /// True if the expressions with jumps of a chip match their linearizations at x.
    bool expressions_match(std::size_t chip, const System&, const EvalContext&, const ExpressionTolerance&);
};

}  // namespace corpuscle::circuit
