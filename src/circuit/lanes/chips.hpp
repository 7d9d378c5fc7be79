#pragma once
// Between many chips of one circuit, and their equations on SIMD lanes, compiled once for each instruction set: plain data and pointers
// only. A row has one number of each chip; what happens in one chip's column depends on that column alone.

#include <cstddef>
#include <cstdint>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit::lanes {

inline constexpr std::size_t chips = 8;  ///< side by side, whatever the width of an instruction set

struct alignas(64) Row {
    double of[chips];
};

/// Gaussian elimination as a list: see Elimination, whose numbers these are.
struct EliminationList {
    struct Pivot {
        int u_begin, u_end, l_begin, l_end;
    };
    std::size_t size, entries, slots;
    const Pivot* pivots;
    const int *updates, *l_rows, *u_columns;  // l_rows: from slot l_from on
    const int *entry_slot, *entry_row, *rows, *columns;
    const double* scale;
    int l_from;
};

/// Chips as straight lines, I + G x + d/dt (Q + C x) = 0, each true near where its devices were last looked at; and where they are in time.
struct ChipBlock {
    std::size_t unknowns, entries, points, devices;
    EliminationList list;
    const int *row, *column, *slot;  // of each entry; entries are in the order of their slots
    const char* voltage;             // of each unknown: it is one
    const int* fill;                 // slots of the list that no entry stands in
    std::size_t fills;
    const int* terminals;        // [devices][4]: unknowns; ground is the last of x
    Row *I, *Q, *G, *C;          // [unknowns], [entries], and one more, of ground
    Row *x, *q;                  // of the step at work; x has one row more, of ground, 0
    Row *base, *history, *rate;  // currents of sources at its end; what dq/dt has beside a q; dq/dt at the last point
    Row *r, *step, *error;       // what is left over, Newton's step, a step's error
    Row *slots, *per_pivot, *work;
    Row *scale, *per_allowed;  // of each unknown: the largest so far; 1 over its allowed error, 0 if it holds no charge
    Row *relative, *floor;     // its allowed error is relative scale + floor
    Row *past_x, *past_q;      // [points][unknowns]
    Row* looked;               // [devices][4]: where each device was last looked at
};

/// Which chips, 1 or 0; numbers for each.
struct PredictCall {
    Row begins;
    const Row *value, *slope;  // [points]: weights
};
struct SolveCall {
    Row a;       // dq/dt = a q + history
    Row growth;  // out: the largest multiplier
};
struct StepCall {
    Row moves;               // whether x goes along
    Row size, clamped, bad;  // out: the largest part in allowed units; > 0: cut to half a volt; not 0: not finite
};
struct ErrorCall {
    Row of_q, of_rate;
    const Row* of_past;  // [points]
    Row worst;           // out
};
struct AcceptCall {
    Row taken, a;
};

/// A transistor's currents and charges about where it was looked at: i + g v + d/dt (q + c v); g[4 a + b]: of a by the voltage of b.
struct StraightLine {
    double i[4], q[4], g[16], c[16];
};

/// Transistors picked here and there: `of` points to each one's numbers, rounded up to all lanes.
struct PickedCall {
    const UicmConstants* const* of;
    std::size_t count, room;
    const double* v;  // [4][room]
    double gmin;
    StraightLine* out;  // [room]
};

/// What one instruction set offers.
struct ChipLanes {
    std::size_t lanes;
    void (*predict)(const ChipBlock&, const PredictCall&);
    /// A bit for each chip in which a terminal is `far` volts or more from where its device was looked at.
    void (*moved)(const ChipBlock&, double far, std::uint8_t* of_device);
    void (*solve)(const ChipBlock&, SolveCall&);
    /// Of the last solve(): the largest part of a row of J step + r that is left, of the largest number in it. Uses `work` and `error`.
    void (*left_over)(const ChipBlock&, const SolveCall&, Row& worst);
    void (*go)(const ChipBlock&, StepCall&);
    void (*charges)(const ChipBlock&);
    void (*error)(const ChipBlock&, ErrorCall&);
    void (*accept)(const ChipBlock&, const AcceptCall&);
    void (*picked)(const PickedCall&);
};

extern const ChipLanes chips_one_by_one;
namespace baseline {
extern const ChipLanes chip_lanes;
}
namespace avx2 {
extern const ChipLanes chip_lanes;
}
namespace avx512 {
extern const ChipLanes chip_lanes;
}

}  // namespace corpuscle::circuit::lanes
