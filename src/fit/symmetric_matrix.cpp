#include "fit/symmetric_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace corpuscle {
namespace {

/// Rotates the plane of p and q so that the element (p, q) of `a` becomes 0, and turns the vectors `v` with it.
void rotate(Matrix& a, Matrix& v, std::size_t n, std::size_t p, std::size_t q) {
    const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
    const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    const auto turn = [&](double& to_p, double& to_q) {
        const double x = to_p, y = to_q;
        to_p = c * x - s * y, to_q = s * x + c * y;
    };
    for (std::size_t k = 0; k < n; ++k) turn(a[k * n + p], a[k * n + q]);
    for (std::size_t k = 0; k < n; ++k) turn(a[p * n + k], a[q * n + k]);
    for (std::size_t k = 0; k < n; ++k) turn(v[k * n + p], v[k * n + q]);
}

/// True if the elements beside the diagonal are negligible.
bool is_diagonal(const Matrix& a, std::size_t n) {
    double off = 0, scale = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) (i == j ? scale : off) += a[i * n + j] * a[i * n + j];
    return !(off > 1e-30 * scale);
}

}  // namespace

double dot_product(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

Eigensystem symmetric_eigensystem(Matrix a, std::size_t n) {
    Matrix v(n * n);
    for (std::size_t i = 0; i < n; ++i) v[i * n + i] = 1;
    for (int sweep = 0; sweep < 60 && !is_diagonal(a, n); ++sweep)
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q)
                if (a[p * n + q] != 0) rotate(a, v, n, p, q);
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return std::pair(a[i * n + i], i) < std::pair(a[j * n + j], j); });
    Eigensystem out;
    for (const auto i : order) {
        out.values.push_back(a[i * n + i]);
        Vector vector;
        for (std::size_t k = 0; k < n; ++k) vector.push_back(v[k * n + i]);
        out.vectors.push_back(std::move(vector));
    }
    return out;
}

}  // namespace corpuscle
