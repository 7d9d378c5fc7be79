#pragma once
// The interface between FieldForce, which is compiled once for all machines, and its sums on SIMD lanes (kernel.cpp), which are compiled
// once for each instruction set. It consists of plain data and pointers only. The terms of a sum are added in the given order, so each
// instruction set gives the same bits.

#include <cstddef>
#include <cstdint>

#include "core/number/instruction_set.hpp"

namespace corpuscle::lanes {

inline constexpr std::size_t group_size = 8;  ///< number of weights in one group

/// One term of a sum of delayed values: weight * value[t] + weight_before * value[t - 1] in step t.
struct DelayedTerm {
    const double* value;
    double weight, weight_before;
};

/// The functions of one instruction set.
struct FieldKernels {
    /// The force on 64 afferents u at one step: sums[u] = sum over k < rows of w * now[row[k] + u], where w is the weight of afferent u in
    /// row k: weights[groups[(64 k + u) / group_size] + u % group_size].
    void (*sum_rows)(const std::ptrdiff_t* row, std::size_t rows, const std::uint32_t* groups, const double* weights, const double* now,
                     double* sums);
    /// Adds the force of one site in all steps t to the `count` afferents that respond to it: sums[(afferent[k] - origin) * stride + t] +=
    /// weight[k] * force[t].
    void (*add_site)(const std::uint32_t* afferent, const double* weight, std::size_t count, std::uint32_t origin, const double* force,
                     std::size_t steps, double* sums, std::size_t stride);
    /// The force on one afferent in all steps t: column[t * stride] = sum over k < count of weight[k] * rows[site[k]][t].
    void (*sum_afferent)(const std::uint32_t* site, const double* weight, std::size_t count, const double* const* rows, std::size_t steps,
                         double* column, std::size_t stride);
    /// The sum of all terms in all steps t: sums[t].
    void (*sum_delayed)(const DelayedTerm* terms, std::size_t count, std::size_t steps, double* sums);
    /// Transposes the columns of a tile: rows[64 t + u] = columns[u][t] for 64 u and all steps t. If `base` is not null, columns[u][t] is
    /// added to base[base_stride * t + u].
    void (*transpose)(const double* const* columns, std::size_t steps, const double* base, std::size_t base_stride, double* rows);
    /// DepthKernel::corner() of a kernel at this depth, at `count` points with the same x: out[k] = corner(x, y[k]).
    void (*stress_corners)(double depth, double x, const double* y, std::size_t count, double* out);
};

CORPUSCLE_KERNELS(FieldKernels, field_kernels)

}  // namespace corpuscle::lanes
