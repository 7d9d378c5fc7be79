#include "circuit/solve/linear/matrix.hpp"

#include <algorithm>
#include <numeric>

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

template <class T>
LinearSolver<T>::LinearSolver(const SparsityPattern& p)
    // A multiplication and an addition are two operations. The pivots, unknown here, may need fewer than the estimate, but not by far.
    : pattern_(&p), factors_(p), is_large_(factors_.has_analysis() && factors_.estimated_operations() > 4.0 * max_multiplications) {}

template <class T>
bool LinearSolver<T>::factor(std::span<const T> values) {
    if (!factors_.has_analysis()) return false;
    if constexpr (is_real) {
        by_list_ = list_ ? list_->factor(values) : fronts_ && fronts_->factor(values);
        if (by_list_) return true;
        // If there is a list, the previous pivots are not reused: a solution must depend on its matrix only, not on earlier matrices.
        if (list_ || fronts_) return factor_with_new_pivots(values);
    }
    return factors_.refactor(values) || factors_.factor(values);
}

template <class T>
bool LinearSolver<T>::factor_with_new_pivots(std::span<const T> values) {
    by_list_ = false;
    fallback_count_ += list_ || fronts_;
    return factors_.factor(values);
}

/// Prepares the elimination in fronts with pivots on the diagonal. Returns false if it is not possible or not stable for this matrix.
template <class T>
bool LinearSolver<T>::use_diagonal_fronts(std::span<const double> values) {
    constexpr double max_growth = 1e3;  // as with the pivots of SparseFactors
    if (const auto order = diagonal_pivot_order(*pattern_, values)) fronts_ = FrontElimination::make(*pattern_, *order, values);
    if (fronts_ && (!fronts_->factor(values) || fronts_->growth() > max_growth)) fronts_.reset();
    return by_list_ = fronts_.has_value();
}

template <class T>
bool LinearSolver<T>::prefer_fronts(std::span<const T> values) {
    if constexpr (is_real) {
        is_large_ = is_large_ && use_diagonal_fronts(values);  // where it fails it is not tried again
        if (is_large_) factors_.clear();
        return is_large_;
    }
    return false;
}

template <class T>
void LinearSolver<T>::fix_pivot_order(std::span<const T> values) {
    if constexpr (is_real) {
        list_.reset(), fronts_.reset(), by_list_ = false, fallback_count_ = 0;
        if (!factors_.has_analysis()) return;
        if (prefer_fronts(values)) return;
        if (!factors_.factor(values)) return;
        const auto order = factors_.pivot_order();
        list_ = Elimination::make(*pattern_, order.rows, order.columns, values, max_multiplications);
        if (list_ || (!is_large_ && use_diagonal_fronts(values))) return;
        fronts_ = FrontElimination::make(*pattern_, order, values);
    }
    (void)values;
}

template <class T>
void LinearSolver<T>::solve(std::span<T> b) const {
    if constexpr (is_real)
        if (by_list_) return list_ ? list_->solve(b) : fronts_->solve(b);
    factors_.solve(b);
}

template class LinearSolver<double>;
template class LinearSolver<std::complex<double>>;

}  // namespace corpuscle::circuit
