#pragma once
// Sparse linear equations with one pattern and many sets of values.

#include <complex>

#include "circuit/solve/linear/elimination.hpp"
#include "circuit/solve/linear/front_elimination.hpp"
#include "circuit/solve/linear/sparse_factors.hpp"

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
    int find_entry(int row, int column) const;  ///< index of an entry; -1: there is none
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
    static constexpr bool is_real = std::is_same_v<T, double>;
    const SparsityPattern* pattern_;
    SparseFactors<T> factors_;  // chooses pivots; used without a list
    std::optional<Elimination> list_;
    std::optional<FrontElimination> fronts_;  // if there is no list, because it would be too long
    bool by_list_ = false;                    // the last factorization used the list or the fronts
    bool is_large_ = false;                   // probably the list would be too long, and fronts have not failed
    long fallback_count_ = 0;

    bool use_diagonal_fronts(std::span<const double> values);

public:
    explicit LinearSolver(const SparsityPattern&);

    /// Factors the matrix with these values and reuses the previous pivots if they are still stable. Returns false if the matrix is
    /// singular.
    bool factor(std::span<const T> values);
    /// Why it failed: this column depends linearly on others; -1: not known.
    int singular_column() const { return factors_.singular_column(); }
    /// Fixes the pivot order of this matrix and prepares its elimination as a list. Later matrices use the list; if its pivots are not
    /// stable for a matrix, that matrix gets new pivots. Where the list would be too long, the elimination in dense fronts takes its place.
    /// No effect on complex matrices.
    void fix_pivot_order(std::span<const T> values);
    /// If the matrix is large and can be eliminated with pivots on the diagonal, fixes this order of pivots. Returns true if it has done
    /// so.
    bool prefer_fronts(std::span<const T> values);
    bool has_fixed_order() const { return list_ || fronts_; }
    const Elimination* elimination() const { return list_ ? &*list_ : nullptr; }  ///< null: no list
    long fallback_count() const { return fallback_count_; }  ///< number of matrices since fix_pivot_order() for which the list was not used
    /// The largest multiplier in the last factorization, see Elimination::growth(). If it is large, the solution should be checked. 0:
    /// neither the list nor the fronts were used.
    double growth() const { return !by_list_ ? 0 : list_ ? list_->growth() : fronts_->growth(); }
    bool factor_with_new_pivots(std::span<const T> values);  ///< chooses new pivots even if there is a list; increases fallback_count()
    void solve(std::span<T> right_side) const;               ///< A x = b, in place
    /// A^T x = b (no conjugate), in place; not after fix_pivot_order().
    void solve_transposed(std::span<T> right_side) const { factors_.solve_transposed(right_side); }
};

extern template class LinearSolver<double>;
extern template class LinearSolver<std::complex<double>>;

}  // namespace corpuscle::circuit
