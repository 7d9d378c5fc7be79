#include "circuit/solve/linear/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {
namespace {

/// The columns in each row of the factored matrix, ascending, including fill-in. Rows and columns are numbered by elimination step. Nothing
/// if the elimination needs more than `max_multiplications`.
std::optional<std::vector<std::vector<int>>> pattern_with_fill(const SparsityPattern& p, std::span<const int> step_of_row,
                                                               std::span<const int> step_of_column, std::size_t max_multiplications) {
    const auto n = static_cast<std::size_t>(p.size());
    std::vector<std::vector<int>> out(n);
    p.for_each_entry([&](std::size_t, std::size_t row, std::size_t column) {
        out[static_cast<std::size_t>(step_of_row[row])].push_back(step_of_column[column]);
    });
    std::size_t multiplications = 0;
    std::vector<std::size_t> last_row_with(n, n);  // by column
    std::vector<int> left;                         // columns of L whose row of U is still to be added: a heap, the smallest one first
    for (std::size_t i = 0; i < n; ++i) {
        auto& row = out[i];
        left.clear();
        const auto add = [&](int column) {
            if (std::exchange(last_row_with[static_cast<std::size_t>(column)], i) == i) return false;
            if (static_cast<std::size_t>(column) < i) left.push_back(column), std::push_heap(left.begin(), left.end(), std::greater<>{});
            return true;
        };
        row.push_back(static_cast<int>(i));
        row.erase(std::remove_if(row.begin(), row.end(), [&](int column) { return !add(column); }), row.end());
        while (!left.empty()) {
            std::pop_heap(left.begin(), left.end(), std::greater<>{});
            const int k = left.back();
            left.pop_back();
            const auto& above = out[static_cast<std::size_t>(k)];
            for (auto at = std::upper_bound(above.begin(), above.end(), k); at != above.end(); ++at) {
                if (add(*at)) row.push_back(*at);
                if (++multiplications > max_multiplications) return std::nullopt;
            }
        }
        std::sort(row.begin(), row.end());
    }
    return out;
}

}  // namespace

std::vector<int> inverse_permutation(std::span<const int> permutation) {
    std::vector<int> out(permutation.size());
    for (std::size_t k = 0; k < permutation.size(); ++k) out[static_cast<std::size_t>(permutation[k])] = static_cast<int>(k);
    return out;
}

std::optional<Elimination> Elimination::make(const SparsityPattern& p, std::span<const int> rows, std::span<const int> columns,
                                             std::span<const double> values, std::size_t max_multiplications) {
    const auto n = static_cast<std::size_t>(p.size());
    const auto step_of_row = inverse_permutation(rows), step_of_column = inverse_permutation(columns);
    const auto columns_of_row = pattern_with_fill(p, step_of_row, step_of_column, max_multiplications);
    if (!columns_of_row) return std::nullopt;

    Elimination out;
    out.rows_.assign(rows.begin(), rows.end()), out.columns_.assign(columns.begin(), columns.end());
    out.pivots_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {  // slots of U
        const auto& row = (*columns_of_row)[k];
        const auto pivot = std::lower_bound(row.begin(), row.end(), static_cast<int>(k));
        out.pivots_[k].u_begin = static_cast<int>(out.u_columns_.size()) + 1;
        out.u_columns_.insert(out.u_columns_.end(), pivot, row.end());
        out.pivots_[k].u_end = static_cast<int>(out.u_columns_.size());
    }
    out.l_first_slot_ = static_cast<int>(out.u_columns_.size());
    std::vector<std::vector<int>> rows_of_column(n);  // of L
    for (std::size_t i = 0; i < n; ++i)
        for (const int k : (*columns_of_row)[i])
            if (static_cast<std::size_t>(k) < i) rows_of_column[static_cast<std::size_t>(k)].push_back(static_cast<int>(i));
    for (std::size_t k = 0; k < n; ++k) {
        out.pivots_[k].l_begin = out.l_first_slot_ + static_cast<int>(out.l_rows_.size());
        out.l_rows_.insert(out.l_rows_.end(), rows_of_column[k].begin(), rows_of_column[k].end());
        out.pivots_[k].l_end = out.l_first_slot_ + static_cast<int>(out.l_rows_.size());
    }
    const auto slot_of = [&](int i, int j) {
        const bool in_l = i > j;
        const auto& pivot = out.pivots_[static_cast<std::size_t>(in_l ? j : i)];
        const auto& numbers = in_l ? out.l_rows_ : out.u_columns_;
        const auto first = numbers.begin() + (in_l ? pivot.l_begin - out.l_first_slot_ : pivot.u_begin - 1),
                   last = numbers.begin() + (in_l ? pivot.l_end - out.l_first_slot_ : pivot.u_end);
        const auto at = std::lower_bound(first, last, in_l ? i : j);
        return static_cast<int>(at - numbers.begin()) + (in_l ? out.l_first_slot_ : 0);
    };
    for (const auto& pivot : out.pivots_)
        for (int l = pivot.l_begin; l < pivot.l_end; ++l)
            for (int u = pivot.u_begin; u < pivot.u_end; ++u)
                out.updates_.push_back(
                    slot_of(out.l_rows_[static_cast<std::size_t>(l - out.l_first_slot_)], out.u_columns_[static_cast<std::size_t>(u)]));
    out.scale_.assign(n, 0);
    p.for_each_entry([&](std::size_t entry, std::size_t row, std::size_t column) {
        out.entry_slot_.push_back(slot_of(step_of_row[row], step_of_column[column]));
        out.entry_row_.push_back(p.rows()[entry]);
        out.scale_[row] = std::max(out.scale_[row], std::abs(values[entry]));
    });
    for (double& s : out.scale_) s = s > 0 ? 1 / s : 1;
    out.slots_.resize(out.u_columns_.size() + out.l_rows_.size()), out.inverse_pivot_.resize(n), out.work_.resize(n);
    return out;
}

lanes::EliminationList Elimination::list() const {
    return {pivots_.size(),     entry_slot_.size(), slots_.size(), pivots_.data(),  updates_.data(), l_rows_.data(), u_columns_.data(),
            entry_slot_.data(), entry_row_.data(),  rows_.data(),  columns_.data(), scale_.data(),   l_first_slot_};
}

bool Elimination::factor(std::span<const double> values) {
    std::fill(slots_.begin(), slots_.end(), 0.0);
    double* const s = slots_.data();
    for (std::size_t e = 0; e < entry_slot_.size(); ++e) s[entry_slot_[e]] = values[e] * scale_[static_cast<std::size_t>(entry_row_[e])];
    double largest = 0;
    const int* target = updates_.data();
    for (std::size_t k = 0; k < pivots_.size(); ++k) {
        const Pivot& p = pivots_[k];
        const double inverse = 1 / s[p.u_begin - 1];  // the pivot's slot precedes those of its row
        inverse_pivot_[k] = inverse;
        for (int l = p.l_begin; l < p.l_end; ++l) {
            const double m = s[l] *= inverse;
            largest = std::max(largest, std::abs(m));
            for (int u = p.u_begin; u < p.u_end; ++u) s[*target++] -= m * s[u];
        }
        if (!(std::abs(inverse) < 1e300)) return false;
    }
    growth_ = largest;
    return largest <= max_multiplier;
}

void Elimination::solve(std::span<double> b) const {
    const double* const s = slots_.data();
    double* const y = work_.data();
    const auto n = pivots_.size();
    for (std::size_t k = 0; k < n; ++k) y[k] = b[static_cast<std::size_t>(rows_[k])] * scale_[static_cast<std::size_t>(rows_[k])];
    for (std::size_t k = 0; k < n; ++k)
        for (int l = pivots_[k].l_begin; l < pivots_[k].l_end; ++l) y[l_rows_[static_cast<std::size_t>(l - l_first_slot_)]] -= s[l] * y[k];
    for (std::size_t k = n; k-- > 0;) {
        double x = y[k];
        for (int u = pivots_[k].u_begin; u < pivots_[k].u_end; ++u) x -= s[u] * y[u_columns_[static_cast<std::size_t>(u)]];
        y[k] = x * inverse_pivot_[k];
        b[static_cast<std::size_t>(columns_[k])] = y[k];
    }
}

}  // namespace corpuscle::circuit
