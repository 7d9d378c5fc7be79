#pragma once
// Gaussian elimination of one sparsity pattern as a flat list of operations. The operations and their order do not depend on the values,
// so one circuit and many circuits on lanes compute the same bits.

#include <optional>
#include <span>
#include <vector>

#include "circuit/lanes/kernels.hpp"

namespace corpuscle::circuit {

class SparsityPattern;

constexpr double max_multiplier = 1e7;  ///< largest allowed magnitude in L; with the pivots that KLU chooses it stays below 1e3

std::vector<int> inverse_permutation(std::span<const int>);

/// P R A Q = L U with row scales R, row order P and column order Q chosen in advance. The array of slots holds the numbers of U row by row,
/// each row starting with its pivot, then those of L column by column, without its diagonal of ones.
class Elimination {
    using Pivot = lanes::EliminationList::Pivot;  // of one elimination step: slots of its row of U after the pivot, of its column of L
    std::vector<Pivot> pivots_;
    std::vector<int> updates_;                 // slots to change, pivot by pivot: for each slot of L one for each slot in the row of U
    std::vector<int> l_rows_, u_columns_;      // row of each slot of L, column of each slot of U, numbered by elimination step
    std::vector<int> entry_slot_, entry_row_;  // slot and row of each entry of the sparsity pattern
    std::vector<int> rows_, columns_;          // P, Q: row and column of A, by elimination step
    std::vector<double> scale_;                // R: factor of each row of A
    std::vector<double> slots_, inverse_pivot_;
    int l_first_slot_ = 0;
    double growth_ = 0;
    mutable std::vector<double> work_;  // buffer of solve()

    Elimination() = default;

public:
    /// rows[k], columns[k]: row and column of A that elimination step k eliminates. values: a matrix from which the row scales are
    /// computed. Nothing if factor() would need more than `max_multiplications`.
    static std::optional<Elimination> make(const SparsityPattern&, std::span<const int> rows, std::span<const int> columns,
                                           std::span<const double> values, std::size_t max_multiplications);

    /// Returns false if the pivot order is not stable for these values (a pivot is far too small compared with its column).
    bool factor(std::span<const double> values);
    void solve(std::span<double> b) const;     ///< A x = b, in place, after factor()
    double growth() const { return growth_; }  ///< largest magnitude in L of the last factorization

    /// The list for the lane kernels, which is valid as long as this object.
    lanes::EliminationList list() const;

    std::size_t multiplications() const { return updates_.size(); }  ///< in one factor(); the number of additions is equal
    std::size_t slots() const { return slots_.size(); }
};

}  // namespace corpuscle::circuit
