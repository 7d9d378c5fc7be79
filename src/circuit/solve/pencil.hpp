#pragma once
// The finite eigenvalues s of a matrix pencil: det(G + s C) = 0.

#include <complex>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle::circuit {

/// A square matrix pencil G + s C, by its entries. Entries at the same position add up.
struct Pencil {
    struct Entry {
        int row, column;
        double g, c;
    };
    int size = 0;
    std::vector<Entry> entries;

    void add(int row, int column, double g, double c = 0) { entries.push_back({row, column, g, c}); }
};

inline constexpr int max_pencil_size = 500;  // the work grows with the third power: a few seconds

/// The finite eigenvalues, those of smallest magnitude first. Conjugate pairs are adjacent. C may be singular: eigenvalues that rounding
/// cannot tell from infinity are left out, and those that it cannot tell from 0 are 0.
///
/// They are found by the QZ method (LAPACK's dggevx, Golub and Van Loan, Matrix Computations, 4th ed., section 7.7) on the balanced
/// matrices. A Rayleigh quotient with the left and right eigenvectors y and x, s = -(y G x) / (y C x), then corrects each; its error is of
/// second order in those of the vectors. Inverse iterations with the sparse matrix follow. Errors: more than max_pencil_size unknowns; no
/// convergence.
Result<std::vector<std::complex<double>>> finite_eigenvalues(const Pencil&);

}  // namespace corpuscle::circuit
