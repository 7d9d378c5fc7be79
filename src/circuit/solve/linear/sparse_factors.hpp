#pragma once
// Sparse LU factors with row pivots, of matrices with one pattern. There are two implementations, of which a build has one: SuiteSparse's
// KLU (klu_factors.cpp), and Eigen's SparseLU (eigen_factors.cpp) for WebAssembly, for which Debian does not package KLU.

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "circuit/solve/linear/pivot_order.hpp"

namespace corpuscle::circuit {

/// T: double or std::complex<double>. The pattern must outlive the factors.
template <class T>
class SparseFactors {
    struct Impl;
    std::unique_ptr<Impl> impl_;

public:
    explicit SparseFactors(const SparsityPattern&);
    ~SparseFactors();
    SparseFactors(SparseFactors&&) noexcept;

    bool has_analysis() const;            ///< false: no matrix of this pattern can be factored
    double estimated_operations() const;  ///< additions and multiplications of a factorization, an estimate from the pattern
    /// Factors a matrix with the pivots of the previous one. Returns false if there was none, or if its pivots may not be stable.
    bool refactor(std::span<const T> values);
    bool factor(std::span<const T> values);                ///< chooses pivots; returns false if the matrix is singular
    void clear();                                          ///< frees the factors
    int singular_column() const;                           ///< after factor() failed: this column depends linearly on others; -1: not known
    PivotOrder pivot_order() const;                        ///< the pivots of the last factorization
    void solve(std::span<T> right_side) const;             ///< A x = b, in place
    void solve_transposed(std::span<T> right_side) const;  ///< A^T x = b (no conjugate), in place
};

extern template class SparseFactors<double>;
extern template class SparseFactors<std::complex<double>>;

/// An order of the columns of a square matrix with little fill-in, if pivots are on the diagonal: AMD. The arguments are those of
/// SparsityPattern. Empty if the pattern is not valid.
std::vector<int> minimum_degree_order(std::span<const int> column_begin, std::span<const int> rows);

}  // namespace corpuscle::circuit
