#pragma once
// Sparse linear equations with one pattern and many sets of values, solved by SuiteSparse's KLU. Only matrix.cpp includes KLU.

#include <complex>

#include "circuit/solve/elimination.hpp"

namespace corpuscle::circuit {

/// The sparsity pattern of a square matrix, in compressed columns: the entries of column c are those from column_begin()[c] to before
/// column_begin()[c + 1].
class SparsityPattern {
    int size_;
    std::vector<int> begin_, rows_;

public:
    /// entries: (row, column), in any order; duplicates are allowed.
    SparsityPattern(int size, std::vector<std::pair<int, int>> entries);
    int size() const { return size_; }
    std::size_t entries() const { return rows_.size(); }
    /// Index of an entry, which must exist, in the array of values.
    std::size_t entry_index(int row, int column) const;
    std::span<const int> column_begin() const { return begin_; }
    std::span<const int> rows() const { return rows_; }  ///< of each entry
    /// Calls use(entry, row, column) for each entry, column by column.
    template <class Use>
    void for_each_entry(const Use& use) const {
        for (std::size_t column = 0; column + 1 < begin_.size(); ++column)
            for (auto e = static_cast<std::size_t>(begin_[column]); e < static_cast<std::size_t>(begin_[column + 1]); ++e)
                use(e, static_cast<std::size_t>(rows_[e]), column);
    }
};

/// Factors matrices of one pattern and solves equations with them. The pattern must outlive the solver. T: double or std::complex<double>.
template <class T>
class LinearSolver {
    struct Impl;
    std::unique_ptr<Impl> impl_;  // of KLU
    std::optional<Elimination> list_;
    bool by_list_ = false;  // the last factorization used the list
    long fallback_count_ = 0;

public:
    explicit LinearSolver(const SparsityPattern&);
    ~LinearSolver();
    LinearSolver(LinearSolver&&) noexcept;

    /// Factors the matrix with these values and reuses the previous pivots if they are still stable. Returns false if the matrix is
    /// singular.
    bool factor(std::span<const T> values);
    int singular_column() const;  ///< why it failed: this column depends linearly on others; -1: not known
    /// Fixes the pivot order of this matrix and prepares its elimination as a list. Later matrices use the list; if its pivots are not
    /// stable for a matrix, that matrix gets new pivots. No effect on complex matrices and on very large ones.
    void fix_pivot_order(std::span<const T> values);
    const Elimination* elimination() const { return list_ ? &*list_ : nullptr; }  ///< null: no list
    long fallback_count() const { return fallback_count_; }  ///< number of matrices since fix_pivot_order() for which the list was not used
    /// The largest multiplier in the last factorization, see Elimination::growth(). If it is large, the solution should be checked. 0: the
    /// list was not used.
    double growth() const { return by_list_ ? list_->growth() : 0; }
    bool factor_with_new_pivots(std::span<const T> values);  ///< chooses new pivots even if there is a list; increases fallback_count()
    void solve(std::span<T> right_side) const;               ///< A x = b, in place
    void solve_transposed(std::span<T> right_side) const;    ///< A^T x = b (no conjugate), in place; not after fix_pivot_order()
};

extern template class LinearSolver<double>;
extern template class LinearSolver<std::complex<double>>;

}  // namespace corpuscle::circuit
