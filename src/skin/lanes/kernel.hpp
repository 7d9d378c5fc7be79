#pragma once
// Between receptive fields, compiled for every machine, and their sums on SIMD lanes, compiled once for each instruction set: plain data
// and pointers only. All sums are in the order that they are told in: the same bits from each.

#include <cstddef>
#include <cstdint>

#include "signal/instruction_set.hpp"

namespace corpuscle::lanes {

inline constexpr std::size_t eight = 8;  ///< weights that lie side by side

/// What one instruction set offers.
struct FieldLanes {
    /// 64 units at one step: sums[u] = sum over k of w * now[row[k] + u], w being number u % eight of the eight weights that begin at
    /// weights[eights[(64 k + u) / eight]].
    void (*add_rows)(const std::ptrdiff_t* row, std::size_t rows, const std::uint32_t* eights, const double* weights, const double* now,
                     double* sums);
    /// One site over some steps to each who feels it: sums[unit[k] * stride + t] += weight[k] * force[t].
    void (*add_site)(const std::uint32_t* unit, const double* weight, std::size_t count, const double* force, std::size_t steps,
                     double* sums, std::size_t stride);
    /// One unit over some steps: column[t * stride] = sum over k of weight[k] * of[site[k]][t].
    void (*add_unit)(const std::uint32_t* site, const double* weight, std::size_t count, const double* const* of, std::size_t steps,
                     double* column, std::size_t stride);
};

namespace baseline {
extern const FieldLanes fields;
}
namespace avx2 {
extern const FieldLanes fields;
}
namespace avx512 {
extern const FieldLanes fields;
}

inline const FieldLanes& field_lanes(InstructionSet set) {
#ifdef __x86_64__
    if (set == InstructionSet::avx512) return avx512::fields;
    if (set == InstructionSet::avx2) return avx2::fields;
#endif
    (void)set;
    return baseline::fields;
}

}  // namespace corpuscle::lanes
