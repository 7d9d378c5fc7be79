#pragma once
// Interface between circuit code, compiled for every machine, and the kernels of transistors and of batches of chips on SIMD lanes,
// compiled once for each instruction set. Plain data and pointers only.

#include <cstddef>
#include <cstdint>

#include "circuit/device/uicm_constants.hpp"
#include "core/number/instruction_set.hpp"

namespace corpuscle::circuit::lanes {

inline constexpr std::size_t max_lanes = 8;  ///< a multiple of the number of lanes of every instruction set

/// The stamps of several devices of one kind. The elements have the order of Stamp, but each element is a row of `stride` numbers, one for
/// each device, aligned to 64 bytes.
struct BatchStamp {
    std::size_t stride;  ///< at least the number of devices, rounded up to the number of lanes
    const double* v;     ///< values of the unknowns
    double *f, *df;
    double* max_term;  ///< for each f, the largest |df/dv| max(|v|, phi_t), the scale of its rounding error; null: not needed
    double *q, *dq;    ///< null: not needed
    double rate = 0;   ///< 1/s: rate q is added to f, and rate dq to df
};

/// A batch of transistors. The unknowns are drain, gate, source, bulk.
struct TransistorCall : BatchStamp {
    const std::byte* models;  ///< from build(), one for each register of transistors
    std::size_t count;        ///< number of transistors
    double gmin;              ///< S, in parallel with every junction
};

/// The transistor kernels of one instruction set.
struct TransistorKernels {
    std::size_t lanes, model_bytes;  ///< number of lanes; size of a model, which holds one transistor per lane
    void (*build)(std::byte* to, const UicmConstants* constants);  ///< constructs a model from one element of `constants` per lane
    void (*eval)(const TransistorCall&);
    void (*extrapolate)(std::size_t stride, const double* dv, const double* dq, double* q);  ///< q += dq dv for the whole stride
};

extern const TransistorKernels scalar_transistor_kernels;
CORPUSCLE_KERNELS(TransistorKernels, transistor_kernel_table)

inline constexpr std::size_t chips_per_block = 8;  ///< the same for every instruction set

/// One number for each chip of a block. The results in a chip's column depend on that column alone.
struct alignas(64) LaneRow {
    double value[chips_per_block];
};

/// Gaussian elimination as a list of operations: a view into an Elimination, with the names of its members.
struct EliminationList {
    struct Pivot {           // its slot is u_begin - 1
        int u_begin, u_end;  // slots of the rest of its row of U; the end is not included
        int l_begin, l_end;  // slots of its column of L
    };
    std::size_t size, entries, slots;  // numbers of pivots, of matrix entries, of slots
    const Pivot* pivots;
    const int *updates, *l_rows, *u_columns;  // l_rows[0] belongs to slot l_first_slot, u_columns[0] to slot 0
    const int *entry_slot, *entry_row, *rows, *columns;
    const double* scale;
    int l_first_slot;
};

/// A block of chips: the equations I + G x + d/dt (Q + C x) = 0, in which each device is linearized at the voltages of its last evaluation,
/// and the state of each transient. Devices are transistors here; the caller adds all others to I, Q, G and C. The last index of x, I, Q,
/// G, C is for ground.
struct ChipBlock {
    std::size_t unknowns, entries, points, devices;  // numbers of these; points: length of the history
    EliminationList list;
    const int *row, *column, *slot;  // of each matrix entry; entries are in the order of their slots
    const char* is_voltage;          // [unknowns]: not 0 if the unknown is a voltage
    const int* fill;                 // slots of the list without an entry (fill-in)
    std::size_t fill_count;
    const int* terminals;                   // [devices][4]: unknowns; ground is the last index of x
    LaneRow *I, *Q;                         // [unknowns + 1]
    LaneRow *G, *C;                         // [entries + 1]
    LaneRow *x, *q;                         // unknowns [unknowns + 1] and charges at the end of the current step; ground is 0
    LaneRow* source_currents;               // f of the time-dependent sources at x = 0, at the end of the step
    LaneRow *history, *rate;                // dq/dt - a q; dq/dt at the newest point
    LaneRow *r, *step, *error;              // residual; Newton step; error of the time step in each equation, then in each unknown
    LaneRow *slots, *inverse_pivot, *work;  // of the elimination
    LaneRow *scale, *inverse_allowed;       // of each unknown: largest magnitude so far; 1 / allowed error, 0 if it has no charge
    LaneRow *relative, *floor;              // allowed error = relative * scale + floor
    LaneRow *past_x, *past_q;               // [points][unknowns], a ring buffer with a start of its own for each chip
    LaneRow* linearized_at;                 // [devices][4]: voltages at which each device was last evaluated
};

// Arguments of the kernels. A flag is 1 or 0 for each chip.
struct PredictCall {
    LaneRow is_new_step;                           // flag: predict x and compute history
    const LaneRow *value_weights, *slope_weights;  // [points]: weights of past_x and past_q
};
struct SolveCall {
    LaneRow a;       // dq/dt = a q + history
    LaneRow growth;  // out: the largest multiplier of the elimination
};
struct StepCall {
    LaneRow updates_x;   // flag: add the step to x
    LaneRow size;        // out: largest component of the step / allowed error
    LaneRow clamped;     // out: above 0 if a voltage was limited to 0.5 V
    LaneRow non_finite;  // out: not 0 if a component is NaN or infinite
};
/// The error of the time step in equation n is charge_weight q[n] + rate_weight rate[n] + the sum of past_weights[k] past_q[k][n].
struct ErrorCall {
    LaneRow charge_weight, rate_weight;
    const LaneRow* past_weights;  // [points]
    LaneRow worst;                // out: largest error of an unknown / allowed error
};
struct AcceptCall {
    LaneRow is_accepted, a;  // flag: the time step was accepted; dq/dt = a q + history
};

/// Linearized currents and charges of a transistor: i + g v + d/dt (q + c v). g[4 a + b] is the derivative at terminal a with respect to
/// the voltage of terminal b.
struct Linearization {
    double i[4], q[4], g[16], c[16];
};

/// Linearizes selected transistors of several chips.
struct LinearizeCall {
    const UicmConstants* const* constants;  // [stride]: those of each transistor
    std::size_t count, stride;              // number of transistors; a multiple of chips_per_block, filled with copies of the last one
    const double* v;                        // [4][stride], V
    double gmin;                            // S, in parallel with every junction
    Linearization* out;                     // [stride]
};

/// The chip kernels of one instruction set.
struct ChipKernels {
    std::size_t lanes;  ///< in a register
    /// Sets x to the predicted values and computes history.
    void (*predict)(const ChipBlock&, const PredictCall&);
    /// Writes to of_device[d] the set (as bits) of the chips in which a terminal voltage of device d differs by at least `radius` (V) from
    /// linearized_at.
    void (*find_moved)(const ChipBlock&, double radius, std::uint8_t* of_device);
    /// Computes the residual r and the Jacobian J at x, and solves J step + r = 0.
    void (*solve)(const ChipBlock&, SolveCall&);
    /// Writes to `worst` the largest residual of J step + r after the last solve(), relative to the largest term of its row. Overwrites
    /// `work` and `error`.
    void (*residual)(const ChipBlock&, const SolveCall&, LaneRow& worst);
    /// Adds the Newton step to x, with voltages limited to 0.5 V.
    void (*apply_step)(const ChipBlock&, StepCall&);
    /// q = Q + C x
    void (*evaluate_charges)(const ChipBlock&);
    /// Converts the error of the equations to that of the unknowns, with the last elimination.
    void (*estimate_error)(const ChipBlock&, ErrorCall&);
    /// Converts `error` from an error of the equations to that of the unknowns, with the last elimination.
    void (*solve_perturbation)(const ChipBlock&);
    /// Updates rate, scale and inverse_allowed after accepted time steps.
    void (*accept)(const ChipBlock&, const AcceptCall&);
    void (*linearize)(const LinearizeCall&);
};

extern const ChipKernels scalar_chip_kernels;
CORPUSCLE_KERNELS(ChipKernels, chip_kernel_table)

}  // namespace corpuscle::circuit::lanes
