#pragma once
// The order of the pivots of a large matrix whose diagonal can be eliminated.

#include <optional>
#include <span>
#include <vector>

namespace corpuscle::circuit {

class SparsityPattern;

struct PivotOrder {
    std::vector<int> rows, columns;  ///< of each pivot
    std::vector<int> block_begin;    ///< first pivot of each block, then the number of pivots; below the diagonal blocks the matrix is zero
};

/// First the columns with one entry, as that of the current of a voltage source between a node and ground; last the rows with one entry, as
/// that of this source's equation. In between all others, with the pivots on the diagonal, in an order with little fill-in. A zero on the
/// diagonal does not count as an entry; later matrices must have it, too. Nothing if the matrix needs a pivot that is not on the diagonal.
std::optional<PivotOrder> diagonal_pivot_order(const SparsityPattern&, std::span<const double> values);

}  // namespace corpuscle::circuit
