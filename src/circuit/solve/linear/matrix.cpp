#include "circuit/solve/linear/matrix.hpp"

#include <klu.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace corpuscle::circuit {

SparsityPattern::SparsityPattern(int size, std::vector<std::pair<int, int>> entries)
    : size_(size), begin_(static_cast<std::size_t>(size) + 1) {
    for (const auto& entry : entries) ++begin_[static_cast<std::size_t>(entry.second) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<int> all(entries.size()), next(begin_.begin(), begin_.end());  // the rows, column by column
    for (const auto& [row, column] : entries) all[static_cast<std::size_t>(next[static_cast<std::size_t>(column)]++)] = row;
    for (std::size_t column = 0; column + 1 < begin_.size(); ++column) {
        const auto first = all.begin() + begin_[column], last = all.begin() + begin_[column + 1];
        std::sort(first, last);
        begin_[column] = static_cast<int>(rows_.size());
        rows_.insert(rows_.end(), first, std::unique(first, last));
    }
    begin_.back() = static_cast<int>(rows_.size());
}

std::size_t SparsityPattern::entry_index(int row, int column) const {
    const auto from = rows_.begin() + begin_[static_cast<std::size_t>(column)],
               to = rows_.begin() + begin_[static_cast<std::size_t>(column) + 1];
    return static_cast<std::size_t>(std::lower_bound(from, to, row) - rows_.begin());
}

int SparsityPattern::find_entry(int row, int column) const {
    const auto entry = entry_index(row, column);
    return entry < static_cast<std::size_t>(begin_[static_cast<std::size_t>(column) + 1]) && rows_[entry] == row ? static_cast<int>(entry)
                                                                                                                 : -1;
}

constexpr std::size_t max_multiplications = 500'000;  // of a list; above, fronts are faster, since a list does not fit into the cache

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
    /// The pivots of the last factorization.
    PivotOrder pivot_order() {
        PivotOrder out;
        out.rows.resize(static_cast<std::size_t>(size)), out.columns.resize(out.rows.size());
        out.block_begin.resize(static_cast<std::size_t>(symbolic->nblocks) + 1);
        klu_extract(numeric, symbolic, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, out.rows.data(),
                    out.columns.data(), nullptr, out.block_begin.data(), &common);
        return out;
    }
    bool factor(double* values) {
        free_numeric();
        numeric = of_type<T>(klu_factor, klu_z_factor)(begin.data(), rows.data(), values, symbolic, &common);
        return numeric != nullptr && common.status == KLU_OK;
    }
};

template <class T>
LinearSolver<T>::LinearSolver(const SparsityPattern& p) : impl_(std::make_unique<Impl>(p)) {
    // A multiplication and an addition are two operations. KLU's pivots, unknown here, may need fewer than the estimate, but not by far.
    is_large_ = impl_->symbolic != nullptr && impl_->symbolic->est_flops > 4.0 * max_multiplications;
}
template <class T>
LinearSolver<T>::~LinearSolver() = default;
template <class T>
LinearSolver<T>::LinearSolver(LinearSolver&&) noexcept = default;

template <class T>
bool LinearSolver<T>::factor(std::span<const T> values) {
    auto* numbers = reinterpret_cast<double*>(const_cast<T*>(values.data()));  // KLU has no const arguments but does not write here
    if (impl_->symbolic == nullptr) return false;
    if constexpr (!Impl::is_complex) {
        by_list_ = list_ ? list_->factor(values) : fronts_ && fronts_->factor(values);
        if (by_list_) return true;
        // If there is a list, KLU's previous pivots are not reused: a solution must depend on its matrix only, not on earlier matrices.
        if (list_ || fronts_) return factor_with_new_pivots(values);
    }
    return (impl_->numeric != nullptr && impl_->refactor(numbers)) || impl_->factor(numbers);
}

template <class T>
bool LinearSolver<T>::factor_with_new_pivots(std::span<const T> values) {
    by_list_ = false;
    fallback_count_ += list_ || fronts_;
    return impl_->factor(reinterpret_cast<double*>(const_cast<T*>(values.data())));
}

/// Prepares the elimination in fronts with pivots on the diagonal. Returns false if it is not possible or not stable for this matrix.
template <class T>
bool LinearSolver<T>::use_diagonal_fronts(std::span<const double> values) {
    constexpr double max_growth = 1e3;  // as with the pivots of KLU
    if (const auto order = diagonal_pivot_order(impl_->pattern, values)) fronts_ = FrontElimination::make(impl_->pattern, *order, values);
    if (fronts_ && (!fronts_->factor(values) || fronts_->growth() > max_growth)) fronts_.reset();
    return by_list_ = fronts_.has_value();
}

template <class T>
bool LinearSolver<T>::prefer_fronts(std::span<const T> values) {
    if constexpr (!Impl::is_complex) {
        is_large_ = is_large_ && use_diagonal_fronts(values);  // where it fails it is not tried again
        if (is_large_) impl_->free_numeric();
        return is_large_;
    }
    return false;
}

template <class T>
void LinearSolver<T>::fix_pivot_order(std::span<const T> values) {
    if constexpr (!Impl::is_complex) {
        list_.reset(), fronts_.reset(), by_list_ = false, fallback_count_ = 0;
        if (impl_->symbolic == nullptr) return;
        if (prefer_fronts(values)) return;
        if (!impl_->factor(const_cast<double*>(values.data()))) return;
        auto order = impl_->pivot_order();
        list_ = Elimination::make(impl_->pattern, order.rows, order.columns, values, max_multiplications);
        if (list_ || (!is_large_ && use_diagonal_fronts(values))) return;
        fronts_ = FrontElimination::make(impl_->pattern, order, values);
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
        if (by_list_) return list_ ? list_->solve(b) : fronts_->solve(b);
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
