#include "circuit/solve/matrix.hpp"

#include <klu.h>

#include <algorithm>
#include <type_traits>

namespace corpuscle::circuit {

SparsityPattern::SparsityPattern(int size, std::vector<std::pair<int, int>> entries)
    : size_(size), begin_(static_cast<std::size_t>(size) + 1) {
    std::sort(entries.begin(), entries.end(), [](auto a, auto b) { return std::pair(a.second, a.first) < std::pair(b.second, b.first); });
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    for (const auto& [row, column] : entries) rows_.push_back(row), ++begin_[static_cast<std::size_t>(column) + 1];
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
}

std::size_t SparsityPattern::entry_index(int row, int column) const {
    const auto from = rows_.begin() + begin_[static_cast<std::size_t>(column)],
               to = rows_.begin() + begin_[static_cast<std::size_t>(column) + 1];
    return static_cast<std::size_t>(std::lower_bound(from, to, row) - rows_.begin());
}

/// One of two functions of KLU: for matrices of real or of complex numbers.
template <class T, class Real, class Complex>
static constexpr auto of_type(Real real, [[maybe_unused]] Complex complex) {
    if constexpr (std::is_same_v<T, double>)
        return real;
    else
        return complex;
}

template <class T>
struct LinearSolver<T>::Impl {
    static constexpr bool is_complex = !std::is_same_v<T, double>;
    const SparsityPattern& pattern;
    int size;
    std::vector<int> begin, rows;
    klu_common common;
    klu_symbolic* symbolic;
    klu_numeric* numeric = nullptr;

    explicit Impl(const SparsityPattern& p)
        : pattern(p), size(p.size()), begin(p.column_begin().begin(), p.column_begin().end()), rows(p.rows().begin(), p.rows().end()) {
        klu_defaults(&common);
        symbolic = klu_analyze(size, begin.data(), rows.data(), &common);
    }
    ~Impl() {
        free_numeric();
        klu_free_symbolic(&symbolic, &common);
    }
    void free_numeric() {
        if (numeric != nullptr) of_type<T>(klu_free_numeric, klu_z_free_numeric)(&numeric, &common);
        numeric = nullptr;
    }
    bool refactor(double* values) {
        return of_type<T>(klu_refactor, klu_z_refactor)(begin.data(), rows.data(), values, symbolic, numeric, &common) &&
               of_type<T>(klu_rcond, klu_z_rcond)(symbolic, numeric, &common) && common.status == KLU_OK &&
               common.rcond > 1e-13;  // otherwise new pivots may be better
    }
    bool factor(double* values) {
        free_numeric();
        numeric = of_type<T>(klu_factor, klu_z_factor)(begin.data(), rows.data(), values, symbolic, &common);
        return numeric != nullptr && common.status == KLU_OK;
    }
};

template <class T>
LinearSolver<T>::LinearSolver(const SparsityPattern& p) : impl_(std::make_unique<Impl>(p)) {}
template <class T>
LinearSolver<T>::~LinearSolver() = default;
template <class T>
LinearSolver<T>::LinearSolver(LinearSolver&&) noexcept = default;

template <class T>
bool LinearSolver<T>::factor(std::span<const T> values) {
    auto* numbers = reinterpret_cast<double*>(const_cast<T*>(values.data()));  // KLU has no const arguments but does not write here
    if (impl_->symbolic == nullptr) return false;
    if constexpr (!Impl::is_complex) {
        by_list_ = list_ && list_->factor(values);
        if (by_list_) return true;
        // If there is a list, KLU's previous pivots are not reused: a solution must depend on its matrix only, not on earlier matrices.
        if (list_) return factor_with_new_pivots(values);
    }
    return (impl_->numeric != nullptr && impl_->refactor(numbers)) || impl_->factor(numbers);
}

template <class T>
bool LinearSolver<T>::factor_with_new_pivots(std::span<const T> values) {
    by_list_ = false;
    fallback_count_ += list_.has_value();  // 1 if there is a list
    return impl_->factor(reinterpret_cast<double*>(const_cast<T*>(values.data())));
}

template <class T>
void LinearSolver<T>::fix_pivot_order(std::span<const T> values) {
    if constexpr (!Impl::is_complex) {
        constexpr std::size_t max_multiplications = 500'000;  // above, KLU is faster: a list does not fit into the cache
        auto* numbers = const_cast<double*>(values.data());
        if (impl_->symbolic == nullptr || !impl_->factor(numbers)) return;
        std::vector<int> rows(static_cast<std::size_t>(impl_->size)), columns(rows.size());
        klu_extract(impl_->numeric, impl_->symbolic, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                    rows.data(), columns.data(), nullptr, nullptr, &impl_->common);
        list_ = Elimination::make(impl_->pattern, rows, columns, values, max_multiplications);
        fallback_count_ = 0;
    }
    (void)values;
}

template <class T>
int LinearSolver<T>::singular_column() const {
    return impl_->symbolic == nullptr || impl_->common.singular_col >= impl_->size ? -1 : impl_->common.singular_col;
}

template <class T>
void LinearSolver<T>::solve(std::span<T> b) const {
    auto* numbers = reinterpret_cast<double*>(b.data());
    if constexpr (!Impl::is_complex)
        if (by_list_) return list_->solve(b);
    of_type<T>(klu_solve, klu_z_solve)(impl_->symbolic, impl_->numeric, impl_->size, 1, numbers, &impl_->common);
}

template <class T>
void LinearSolver<T>::solve_transposed(std::span<T> b) const {
    auto* numbers = reinterpret_cast<double*>(b.data());
    if constexpr (Impl::is_complex)
        klu_z_tsolve(impl_->symbolic, impl_->numeric, impl_->size, 1, numbers, 0, &impl_->common);
    else
        klu_tsolve(impl_->symbolic, impl_->numeric, impl_->size, 1, numbers, &impl_->common);
}

template class LinearSolver<double>;
template class LinearSolver<std::complex<double>>;

}  // namespace corpuscle::circuit
