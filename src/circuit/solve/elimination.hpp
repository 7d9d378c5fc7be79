#pragma once
// Gaussian elimination of one matrix pattern, written out once as a flat list: the same operations in the same order whatever the
// numbers, so that one circuit, or many on lanes, do exactly the same.

#include <optional>
#include <span>
#include <vector>

#include "circuit/lanes/chips.hpp"

namespace corpuscle::circuit {

class Pattern;

/// P R A Q = L U with the row scales R, rows P and columns Q chosen beforehand. Slots hold U, row by row, each beginning with its pivot,
/// then L, column by column.
class Elimination {
    using Pivot = lanes::EliminationList::Pivot;  // slots of U's row, after its pivot; slots of L's column
    std::vector<Pivot> pivots_;
    std::vector<int> updates_;             // target slots, pivot by pivot: for each of L's slots as many as U's row has
    std::vector<int> l_rows_, u_columns_;  // of the slots: steps of elimination
    std::vector<int> entry_slot_, entry_row_;
    std::vector<int> rows_, columns_;  // P, Q
    std::vector<double> scale_, slots_, per_pivot_;
    int l_from_ = 0;
    double growth_ = 0;
    mutable std::vector<double> work_;

public:
    /// rows[k], columns[k]: of A, eliminated in step k. values: those that scale the rows.
    Elimination(const Pattern&, std::span<const int> rows, std::span<const int> columns, std::span<const double> values);

    /// False: with these numbers the order does not serve (a pivot is far too small against its column).
    bool factor(std::span<const double> values);
    void solve(std::span<double> b) const;     ///< A x = b, in place
    double growth() const { return growth_; }  ///< the largest multiplier of the last matrix, of scaled rows

    /// For many matrices at once; it lives as long as this does.
    lanes::EliminationList list() const;

    std::size_t multiplications() const { return updates_.size(); }  ///< and as many additions, in one factor()
    std::size_t slots() const { return slots_.size(); }
};

}  // namespace corpuscle::circuit
