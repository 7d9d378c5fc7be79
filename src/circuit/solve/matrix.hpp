#pragma once
// Sparse linear equations with one pattern and many sets of values, solved by SuiteSparse's KLU. Only matrix.cpp includes KLU.

#include <complex>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace corpuscle::circuit {

/// The sparsity pattern of a square matrix, in compressed columns.
class Pattern {
    int size_;
    std::vector<int> begin_, rows_;

public:
    /// entries: (row, column), in any order; duplicates are allowed.
    Pattern(int size, std::vector<std::pair<int, int>> entries);
    int size() const { return size_; }
    std::size_t entries() const { return rows_.size(); }
    /// Index of an entry in the array of values.
    std::size_t place(int row, int column) const;
    std::span<const int> begin() const { return begin_; }
    std::span<const int> rows() const { return rows_; }
};

/// The column at which a factorization failed, which depends linearly on others. -1: not known.
struct Singular {
    int column = -1;
};

class Elimination;

/// T: double or std::complex<double>.
template <class T>
class Solver {
    struct Impl;
    std::unique_ptr<Impl> impl_;

public:
    explicit Solver(const Pattern&);
    ~Solver();
    Solver(Solver&&) noexcept;

    /// Factors the matrix with these values and reuses the previous pivots if they are still stable. Returns false if the matrix is
    /// singular; see singularity().
    bool factor(std::span<const T> values);
    Singular where() const;
    /// Fixes the pivot order of this matrix and prepares its elimination as a list. Later matrices use the list; if its pivots are not
    /// stable for a matrix, that matrix gets new pivots. No effect on complex matrices and on very large ones.
    void settle(std::span<const T> values);
    const Elimination* list() const;  ///< null: no list
    long strayed() const;             ///< number of matrices since then for which the list was not used
    /// The largest multiplier of the last factorization by the list. If it is large, the solution should be checked. 0: the list was not
    /// used.
    double growth() const;
    bool factor_anew(std::span<const T> values);           ///< chooses new pivots even if there is a list; increases fallback_count()
    void solve(std::span<T> right_side) const;             ///< A x = b, in place
    void solve_transposed(std::span<T> right_side) const;  ///< A^T x = b (no conjugate)
};

extern template class Solver<double>;
extern template class Solver<std::complex<double>>;

}  // namespace corpuscle::circuit
