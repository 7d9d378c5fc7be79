#include "circuit/solve/pencil.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "circuit/solve/linear/matrix.hpp"

// LAPACK. The lengths of the texts are the last arguments of a Fortran function.
extern "C" void dggevx_(const char* balance, const char* left, const char* right, const char* sense, const int* n, double* a,
                        const int* lda, double* b, const int* ldb, double* alpha_real, double* alpha_imag, double* beta, double* vl,
                        const int* ldvl, double* vr, const int* ldvr, int* ilo, int* ihi, double* lscale, double* rscale, double* a_norm,
                        double* b_norm, double* rconde, double* rcondv, double* work, const int* lwork, int* iwork, int* bwork, int* info,
                        std::size_t, std::size_t, std::size_t, std::size_t);

namespace corpuscle::circuit {
namespace {

using Complex = std::complex<double>;
using Vector = std::vector<Complex>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double rounding = 1e4 * epsilon;  // a generous bound of the rounding errors of entries, relative to them

struct EigenPair {
    Complex s;         // rad/s
    Vector x, y;       // right and left: (G + s C) x = 0 and y^T (G + s C) = 0
    bool is_finite;    // s differs from infinity by more than rounding
    double error = 0;  // bound of the relative error of s that rounding may cause
};

/// Bilinear forms y^T G x and y^T C x, and the sums of the magnitudes of their terms.
struct Forms {
    Complex g, c;
    double g_size = 0, c_size = 0;

    Forms(const Pencil& p, const Vector& x, const Vector& y) {
        for (const auto& e : p.entries) {
            const auto product = y[static_cast<std::size_t>(e.row)] * x[static_cast<std::size_t>(e.column)];
            g += product * e.g, c += product * e.c;
            g_size += std::abs(product * e.g), c_size += std::abs(product * e.c);
        }
    }
    /// Rounding changes c by this much, that of g included, which is |s| times that of c.
    double error_of_c(Complex s) const { return rounding * (c_size + (s == 0.0 ? 0 : g_size / std::abs(s))); }
    bool is_zero() const { return std::abs(g) <= rounding * g_size; }
};

/// The eigenvalue by the Rayleigh quotient, and whether it is finite. `s` is its first estimate.
void correct(const Pencil& p, EigenPair& pair) {
    const Forms f(p, pair.x, pair.y);
    if (f.c != 0.0) pair.s = -f.g / f.c;
    pair.is_finite = std::abs(f.c) > f.error_of_c(pair.s) || (f.is_zero() && std::abs(f.c) > rounding * f.c_size);
    if (f.is_zero() && pair.is_finite) pair.s = 0;
    pair.error = f.error_of_c(pair.s) / std::abs(f.c);
}

/// A frequency, rad/s, at which the entries of G and s C are of similar size.
double typical_frequency(const Pencil& p) {
    std::vector<double> g(static_cast<std::size_t>(p.size)), c = g;
    for (const auto& e : p.entries) {
        auto& row_g = g[static_cast<std::size_t>(e.row)];
        auto& row_c = c[static_cast<std::size_t>(e.row)];
        row_g = std::max(row_g, std::abs(e.g)), row_c = std::max(row_c, std::abs(e.c));
    }
    double sum = 0, count = 0;
    for (std::size_t k = 0; k < g.size(); ++k)
        if (g[k] > 0 && c[k] > 0) sum += std::log(g[k] / c[k]), ++count;
    return count > 0 ? std::exp(sum / count) : 1;
}

/// All eigenvalues with their vectors, from LAPACK.
class DenseSolver {
    int n_;
    std::size_t rows_;
    double scale_;                         // rad/s; LAPACK's eigenvalues are s / scale
    std::vector<double> a_, b_, vl_, vr_;  // by columns
    std::vector<double> re_, im_, beta_, lscale_, rscale_, rconde_, rcondv_, work_;

public:
    explicit DenseSolver(const Pencil& p) : n_(p.size), rows_(static_cast<std::size_t>(p.size)), scale_(typical_frequency(p)) {
        for (auto* matrix : {&a_, &b_, &vl_, &vr_}) matrix->resize(rows_ * rows_);
        for (auto* vector : {&re_, &im_, &beta_, &lscale_, &rscale_, &rconde_, &rcondv_}) vector->resize(rows_);
        for (const auto& e : p.entries) {
            const auto at = static_cast<std::size_t>(e.column) * rows_ + static_cast<std::size_t>(e.row);
            a_[at] += e.g, b_[at] -= scale_ * e.c;
        }
    }

    Result<std::vector<EigenPair>> run() {
        double best_size = 0;
        work_.resize(1);
        int info = call(-1);
        best_size = work_[0];
        work_.resize(std::max<std::size_t>(static_cast<std::size_t>(best_size), 2 * rows_ * rows_ + 12 * rows_ + 16));
        info = call(static_cast<int>(work_.size()));
        if (info != 0) return Error{ErrorCode::not_converged, fmt::format("the QZ method did not converge ({})", info)};
        std::vector<EigenPair> out;
        for (std::size_t k = 0; k < rows_; ++k) {
            const bool is_pair = im_[k] > 0;
            if (beta_[k] != 0 && im_[k] >= 0) {
                const Complex s = scale_ * Complex(re_[k], im_[k]) / beta_[k];
                out.push_back({s, vector(vr_, k, is_pair, false), vector(vl_, k, is_pair, true), true});
            }
        }
        return out;
    }

private:
    /// Column k as an eigenvector; the imaginary part of a complex one is in the next column. LAPACK's left vectors are for y^H.
    Vector vector(const std::vector<double>& v, std::size_t k, bool is_complex, bool is_conjugate) const {
        Vector out(rows_);
        for (std::size_t r = 0; r < rows_; ++r) {
            const double imag = is_complex ? v[(k + 1) * rows_ + r] : 0;
            out[r] = {v[k * rows_ + r], is_conjugate ? -imag : imag};
        }
        return out;
    }
    int call(int work_size) {
        int ilo = 0, ihi = 0, info = 0;
        double a_norm = 0, b_norm = 0;
        std::vector<int> iwork(rows_ + 6), bwork(rows_);
        dggevx_("B", "V", "V", "N", &n_, a_.data(), &n_, b_.data(), &n_, re_.data(), im_.data(), beta_.data(), vl_.data(), &n_, vr_.data(),
                &n_, &ilo, &ihi, lscale_.data(), rscale_.data(), &a_norm, &b_norm, rconde_.data(), rcondv_.data(), work_.data(), &work_size,
                iwork.data(), bwork.data(), &info, 1, 1, 1, 1);
        return info;
    }
};

/// Inverse iterations with the sparse matrix G + s C, whose pivots keep small entries exact beside large ones.
class Refinement {
    const Pencil& p_;
    SparsityPattern pattern_;
    LinearSolver<Complex> solver_;
    std::vector<std::size_t> entries_;

    static SparsityPattern pattern_of(const Pencil& p) {
        std::vector<std::pair<int, int>> positions;
        for (const auto& e : p.entries) positions.emplace_back(e.row, e.column);
        return {p.size, std::move(positions)};
    }
    bool factor(Complex s) {
        Vector values(pattern_.entries());
        for (std::size_t k = 0; k < entries_.size(); ++k) values[entries_[k]] += p_.entries[k].g + s * p_.entries[k].c;
        return solver_.factor_with_new_pivots(values);
    }
    Vector times_c(const Vector& x, bool is_transposed) const {
        Vector out(x.size());
        for (const auto& e : p_.entries) {
            const auto from = static_cast<std::size_t>(is_transposed ? e.row : e.column);
            out[static_cast<std::size_t>(is_transposed ? e.column : e.row)] += e.c * x[from];
        }
        return out;
    }
    static void normalize(Vector& x) {
        double largest = 0;
        for (const auto& value : x) largest = std::max(largest, std::abs(value));
        if (largest > 0)
            for (auto& value : x) value /= largest;
    }

public:
    explicit Refinement(const Pencil& p) : p_(p), pattern_(pattern_of(p)), solver_(pattern_) {
        for (const auto& e : p.entries) entries_.push_back(pattern_.entry_index(e.row, e.column));
    }
    /// Iterates until s changes by rounding only. Keeps the last estimate if that is not reached, or if s moves by more than `radius`.
    void refine(EigenPair& pair, double radius) {
        auto next = pair;
        for (int k = 0; k < 8; ++k) {
            if (!factor(next.s)) return;  // s is exact
            next.x = times_c(next.x, false), next.y = times_c(next.y, true);
            solver_.solve(next.x), solver_.solve_transposed(next.y);
            normalize(next.x), normalize(next.y);
            const auto before = next.s;
            correct(p_, next);
            if (!next.is_finite || !(std::abs(next.s - pair.s) < radius)) return;
            if (std::abs(next.s - before) <= 8 * epsilon * std::abs(next.s)) break;
        }
        if (pair.s.imag() == 0) next.s = next.s.real();
        pair = std::move(next);
    }
};

void refine_all(const Pencil& p, std::vector<EigenPair>& pairs) {
    Refinement refinement(p);
    for (auto& pair : pairs) {
        if (pair.s == 0.0) continue;
        double distance = std::abs(pair.s);
        for (const auto& other : pairs)
            if (&other != &pair) distance = std::min(distance, std::abs(other.s - pair.s));
        refinement.refine(pair, distance / 4);
    }
}

}  // namespace

Result<std::vector<Complex>> finite_eigenvalues(const Pencil& p) {
    if (p.size > max_pencil_size) return bad_input(fmt::format("the circuit has {} unknowns; the limit is {}", p.size, max_pencil_size));
    if (p.size == 0) return std::vector<Complex>();
    auto pairs = TRY(DenseSolver(p).run());
    for (auto& pair : pairs) correct(p, pair);
    std::erase_if(pairs, [](const EigenPair& pair) { return !pair.is_finite; });
    refine_all(p, pairs);
    const double smallest = epsilon * typical_frequency(p);
    for (auto& pair : pairs)
        if (std::abs(pair.s) < smallest) pair.s = 0;
    // By magnitude; of two conjugates, that with the positive imaginary part first.
    std::ranges::sort(pairs, {}, [](const EigenPair& pair) { return std::pair(std::abs(pair.s), -pair.s.imag()); });
    std::vector<Complex> out;
    for (const auto& pair : pairs) {
        // Rounding may split a double real root into a pair.
        const bool is_real = std::abs(pair.s.imag()) <= pair.error * std::abs(pair.s);
        const Complex s = is_real ? pair.s.real() : pair.s;
        out.push_back(s);
        if (pair.s.imag() != 0) out.push_back(std::conj(s));
    }
    return out;
}

}  // namespace corpuscle::circuit
