#pragma once
// Interface between batches of chips of one circuit and their kernels on SIMD lanes, compiled once for each instruction set. Plain data
// and pointers only. A row has one number for each chip. The results in a chip's column depend on that column alone.

#include <cstddef>
#include <cstdint>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit::lanes {

inline constexpr std::size_t chips_per_block = 8;  ///< the same for every instruction set

struct alignas(64) LaneRow {
    double value[chips_per_block];
};

/// Gaussian elimination as a list of operations; a view into an Elimination.
struct EliminationList {
    struct Pivot {
        int u_begin, u_end, l_begin, l_end;
    };
    std::size_t size, entries, slots;
    const Pivot* pivots;
    const int *updates, *l_rows, *u_columns;  // l_rows[0] belongs to slot l_first_slot
    const int *entry_slot, *entry_row, *rows, *columns;
    const double* scale;
    int l_first_slot;
};

/// A block of chips: linearized equations I + G x + d/dt (Q + C x) = 0 about the points at which the devices were last evaluated, and the
/// state of each transient. The last index of x, I, Q, G, C is for ground.
struct ChipBlock {
    std::size_t unknowns, entries, points, devices;  // points: length of the history
    EliminationList list;
    const int *row, *column, *slot;  // of each matrix entry; entries are in the order of their slots
    const char* is_voltage;          // [unknowns]: not 0 if the unknown is a voltage
    const int* fill;                 // slots of the list without an entry (fill-in)
    std::size_t fill_count;
    const int* terminals;                       // [devices][4]: unknowns; ground is the last index of x
    LaneRow *I, *Q, *G, *C;                     // [unknowns + 1], [entries + 1]; the last is for ground
    LaneRow *x, *q;                             // unknowns [unknowns + 1] and charges at the end of the current step; ground is 0
    LaneRow *source_currents, *history, *rate;  // source currents at the end of the step; dq/dt - a q; dq/dt at the last point
    LaneRow *r, *step, *error;                  // residual, Newton step, error of the time step
    LaneRow *slots, *inverse_pivot, *work;      // of the elimination
    LaneRow *scale, *inverse_allowed;           // of each unknown: largest magnitude so far; 1 / allowed error, 0 if it has no charge
    LaneRow *relative, *floor;                  // allowed error = relative * scale + floor
    LaneRow *past_x, *past_q;                   // [points][unknowns]
    LaneRow* linearized_at;                     // [devices][4]: voltages at which each device was last evaluated
};

// Arguments of the kernels. A flag is 1 or 0 for each chip.
struct PredictCall {
    LaneRow is_new_step;                           // flag
    const LaneRow *value_weights, *slope_weights;  // [points]: weights
};
struct SolveCall {
    LaneRow a;       // dq/dt = a q + history
    LaneRow growth;  // out: the largest multiplier of the elimination
};
struct StepCall {
    LaneRow updates_x;                  // flag: add the step to x
    LaneRow size, clamped, non_finite;  // out: largest component / allowed error, > 0 if limited to 0.5 V, not 0 if NaN or infinite
};
/// The charge error of unknown n is charge_weight q[n] + rate_weight rate[n] + the sum of past_weights[k] past_q[k][n].
struct ErrorCall {
    LaneRow charge_weight, rate_weight;
    const LaneRow* past_weights;  // [points]
    LaneRow worst;                // out: largest error / allowed error
};
struct AcceptCall {
    LaneRow is_accepted, a;  // flag; dq/dt = a q + history
};

/// Linearized currents and charges of a transistor: i + g v + d/dt (q + c v). g[4 a + b] is the derivative at terminal a with respect to
/// the voltage of terminal b.
struct Linearization {
    double i[4], q[4], g[16], c[16];
};

/// Linearizes selected transistors of several chips. `constants` points to the constants of each; the list is padded to full lanes.
struct LinearizeCall {
    const UicmConstants* const* constants;
    std::size_t count, stride;
    const double* v;     // [4][stride], V
    double gmin;         // S
    Linearization* out;  // [stride]
};

/// The chip kernels of one instruction set.
struct ChipKernels {
    std::size_t lanes;
    void (*predict)(const ChipBlock&, const PredictCall&);
    /// For each device, sets a bit for each chip in which a terminal is at least `radius` (V) from the device's linearization point.
    void (*find_moved)(const ChipBlock&, double radius, std::uint8_t* of_device);
    void (*solve)(const ChipBlock&, SolveCall&);
    /// The largest relative residual of J step + r after the last solve(), relative to the largest term of its row. Overwrites `work` and
    /// `error`.
    void (*residual)(const ChipBlock&, const SolveCall&, LaneRow& worst);
    void (*apply_step)(const ChipBlock&, StepCall&);
    void (*evaluate_charges)(const ChipBlock&);
    void (*estimate_error)(const ChipBlock&, ErrorCall&);
    void (*accept)(const ChipBlock&, const AcceptCall&);
    void (*linearize)(const LinearizeCall&);
};

extern const ChipKernels scalar_chip_kernels;
namespace baseline {
extern const ChipKernels chip_kernel_table;
}
namespace avx2 {
extern const ChipKernels chip_kernel_table;
}
namespace avx512 {
extern const ChipKernels chip_kernel_table;
}

}  // namespace corpuscle::circuit::lanes
