#pragma once
// Interface to the kernels of dense matrices in a sparse elimination (circuit/solve/linear/front_elimination.hpp), compiled once for each
// instruction set. Each number is computed by the same operations in the same order with every set.

#include <cstddef>

#include "core/number/instruction_set.hpp"

namespace corpuscle::circuit::lanes {

inline constexpr std::size_t front_padding = 16;      ///< numbers after the last row of each column of a front that a kernel may overwrite
inline constexpr std::size_t front_block = 16;        ///< pivots that are eliminated together
inline constexpr std::size_t front_partial_sums = 8;  ///< of a product of a row and a column

/// A dense matrix of size x size in columns, of which the first `pivots` rows and columns are eliminated.
struct Front {
    double* values;  ///< [size][stride]; the stride includes front_padding
    std::size_t size, stride, pivots;
    bool is_symmetric;       ///< only the elements on and below the diagonal are used
    double* inverse_pivot;   ///< out, [pivots]
    double *rows, *columns;  ///< buffers of front_block * (size + front_padding) numbers each
};

/// The result of an elimination for its first `pivots` unknowns: L, and U or the pivots.
struct FrontFactors {
    const double* lower;          ///< [pivots][size]: columns of L; above the diagonal, U of the pivots
    const double* upper;          ///< [pivots][size - pivots]: the rest of each row of U; null: symmetric
    const double* inverse_pivot;  ///< [pivots]
    std::size_t size, pivots;
};

struct FrontKernels {
    /// Eliminates the pivots: A = L U, or L D L^T. Returns the largest multiplier; NaN or infinity if a pivot is 0.
    double (*factor)(const Front&);
    /// Solves L y = y for the pivots' unknowns and subtracts the effect on the others from `rest`.
    void (*forward)(const FrontFactors&, double* y, double* rest);
    /// Solves for the pivots' unknowns, given the others in `rest`.
    void (*backward)(const FrontFactors&, double* y, const double* rest);
};

CORPUSCLE_KERNELS(FrontKernels, front_kernel_table)

}  // namespace corpuscle::circuit::lanes
