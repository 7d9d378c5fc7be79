#pragma once
// Vectors, and small symmetric matrices.

#include <cstddef>
#include <vector>

namespace corpuscle {

using Vector = std::vector<double>;
using Matrix = std::vector<double>;  ///< n by n, row after row

double dot_product(const Vector& a, const Vector& b);

/// Eigenvalues of a symmetric matrix, in ascending order, and their unit vectors (Jacobi's method).
struct Eigensystem {
    Vector values;
    std::vector<Vector> vectors;  ///< one for each value
};
Eigensystem symmetric_eigensystem(Matrix, std::size_t n);

}  // namespace corpuscle
