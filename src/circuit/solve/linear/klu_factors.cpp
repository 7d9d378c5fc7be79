// SparseFactors by SuiteSparse's KLU. Only this file includes KLU and AMD.

#include <amd.h>
#include <klu.h>

#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {
namespace {

/// One of two functions of KLU: for matrices of real or of complex numbers.
template <class T, class Real, class Complex>
constexpr auto klu_function(Real real, [[maybe_unused]] Complex complex) {
    if constexpr (std::is_same_v<T, double>)
        return real;
    else
        return complex;
}

/// KLU has no const arguments but does not write to the values.
template <class T>
double* klu_values(std::span<const T> values) {
    return reinterpret_cast<double*>(const_cast<T*>(values.data()));
}

}  // namespace

template <class T>
struct SparseFactors<T>::Impl {
    int size;
    std::vector<int> begin, rows;
    klu_common common;
    klu_symbolic* symbolic;
    klu_numeric* numeric = nullptr;

    explicit Impl(const SparsityPattern& p)
        : size(p.size()), begin(p.column_begin().begin(), p.column_begin().end()), rows(p.rows().begin(), p.rows().end()) {
        klu_defaults(&common);
        symbolic = klu_analyze(size, begin.data(), rows.data(), &common);
    }
    ~Impl() {
        free_numeric();
        klu_free_symbolic(&symbolic, &common);
    }
    void free_numeric() {
        if (numeric != nullptr) klu_function<T>(klu_free_numeric, klu_z_free_numeric)(&numeric, &common);
        numeric = nullptr;
    }
};

template <class T>
SparseFactors<T>::SparseFactors(const SparsityPattern& p) : impl_(std::make_unique<Impl>(p)) {}
template <class T>
SparseFactors<T>::~SparseFactors() = default;
template <class T>
SparseFactors<T>::SparseFactors(SparseFactors&&) noexcept = default;

template <class T>
bool SparseFactors<T>::has_analysis() const {
    return impl_->symbolic != nullptr;
}
template <class T>
double SparseFactors<T>::estimated_operations() const {
    return has_analysis() ? impl_->symbolic->est_flops : 0;
}

template <class T>
bool SparseFactors<T>::refactor(std::span<const T> values) {
    auto& k = *impl_;
    return k.numeric != nullptr &&
           klu_function<T>(klu_refactor, klu_z_refactor)(k.begin.data(), k.rows.data(), klu_values(values), k.symbolic, k.numeric,
                                                         &k.common) &&
           klu_function<T>(klu_rcond, klu_z_rcond)(k.symbolic, k.numeric, &k.common) && k.common.status == KLU_OK &&
           k.common.rcond > 1e-13;  // otherwise new pivots may be better
}

template <class T>
bool SparseFactors<T>::factor(std::span<const T> values) {
    auto& k = *impl_;
    k.free_numeric();
    k.numeric = klu_function<T>(klu_factor, klu_z_factor)(k.begin.data(), k.rows.data(), klu_values(values), k.symbolic, &k.common);
    return k.numeric != nullptr && k.common.status == KLU_OK;
}

template <class T>
void SparseFactors<T>::clear() {
    impl_->free_numeric();
}

template <class T>
int SparseFactors<T>::singular_column() const {
    return !has_analysis() || impl_->common.singular_col >= impl_->size ? -1 : impl_->common.singular_col;
}

template <class T>
PivotOrder SparseFactors<T>::pivot_order() const {
    auto& k = *impl_;
    PivotOrder out;
    out.rows.resize(static_cast<std::size_t>(k.size)), out.columns.resize(out.rows.size());
    out.block_begin.resize(static_cast<std::size_t>(k.symbolic->nblocks) + 1);
    klu_extract(k.numeric, k.symbolic, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, out.rows.data(),
                out.columns.data(), nullptr, out.block_begin.data(), &k.common);
    return out;
}

template <class T>
void SparseFactors<T>::solve(std::span<T> b) const {
    klu_function<T>(klu_solve, klu_z_solve)(impl_->symbolic, impl_->numeric, impl_->size, 1, reinterpret_cast<double*>(b.data()),
                                            &impl_->common);
}

template <class T>
void SparseFactors<T>::solve_transposed(std::span<T> b) const {
    auto* numbers = reinterpret_cast<double*>(b.data());
    if constexpr (std::is_same_v<T, double>)
        klu_tsolve(impl_->symbolic, impl_->numeric, impl_->size, 1, numbers, &impl_->common);
    else
        klu_z_tsolve(impl_->symbolic, impl_->numeric, impl_->size, 1, numbers, 0, &impl_->common);
}

template class SparseFactors<double>;
template class SparseFactors<std::complex<double>>;

std::vector<int> minimum_degree_order(std::span<const int> column_begin, std::span<const int> rows) {
    std::vector<int> order(column_begin.size() - 1);
    const auto size = static_cast<int>(order.size());
    if (amd_order(size, column_begin.data(), rows.data(), order.data(), nullptr, nullptr) < AMD_OK) return {};
    return order;
}

}  // namespace corpuscle::circuit
