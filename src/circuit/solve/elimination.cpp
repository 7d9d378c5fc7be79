#include "circuit/solve/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "circuit/solve/matrix.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double max_multiplier = 1e7;  // largest allowed magnitude in L; with the pivots that KLU chooses it stays below 1e3

std::vector<int> inverse_permutation(std::span<const int> permutation) {
    std::vector<int> out(permutation.size());
    for (std::size_t k = 0; k < permutation.size(); ++k) out[static_cast<std::size_t>(permutation[k])] = static_cast<int>(k);
    return out;
}

/// The columns in each row of the factored matrix, including fill-in. Rows and columns are numbered by elimination step.
std::vector<std::vector<int>> pattern_with_fill(const SparsityPattern& p, std::span<const int> step_of_row,
                                                std::span<const int> step_of_column) {
    const auto n = static_cast<std::size_t>(p.size());
    std::vector<std::vector<char>> occupied(n, std::vector<char>(n));
    p.for_each_entry([&](std::size_t, std::size_t row, std::size_t column) {
        occupied[static_cast<std::size_t>(step_of_row[row])][static_cast<std::size_t>(step_of_column[column])] = 1;
    });
    for (std::size_t k = 0; k < n; ++k) {
        occupied[k][k] = 1;
        for (std::size_t i = k + 1; i < n; ++i)
            for (std::size_t j = k + 1; occupied[i][k] && j < n; ++j) occupied[i][j] = static_cast<char>(occupied[i][j] | occupied[k][j]);
    }
    std::vector<std::vector<int>> out(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            if (occupied[i][j]) out[i].push_back(static_cast<int>(j));
    return out;
}

}  // namespace

Elimination::Elimination(const SparsityPattern& p, std::span<const int> rows, std::span<const int> columns, std::span<const double> values)
    : rows_(rows.begin(), rows.end()), columns_(columns.begin(), columns.end()) {
    const auto n = static_cast<std::size_t>(p.size());
    const auto step_of_row = inverse_permutation(rows), step_of_column = inverse_permutation(columns);
    const auto columns_of_row = pattern_with_fill(p, step_of_row, step_of_column);

    std::map<std::pair<int, int>, int> slot;  // by (row, column), numbered by elimination step
    const auto add_slot = [&](int i, int j) {
        const int index = static_cast<int>(slot.size());
        slot[{i, j}] = index;
        return index;
    };
    pivots_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        add_slot(static_cast<int>(k), static_cast<int>(k));
        pivots_[k].u_begin = static_cast<int>(slot.size());
        for (const int j : columns_of_row[k])
            if (j > static_cast<int>(k)) add_slot(static_cast<int>(k), j);
        pivots_[k].u_end = static_cast<int>(slot.size());
    }
    l_first_slot_ = static_cast<int>(slot.size());
    u_columns_.resize(slot.size());
    for (const auto& [position, index] : slot) u_columns_[static_cast<std::size_t>(index)] = position.second;
    for (std::size_t k = 0; k < n; ++k) {
        pivots_[k].l_begin = static_cast<int>(slot.size());
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::binary_search(columns_of_row[i].begin(), columns_of_row[i].end(), static_cast<int>(k))) {
                add_slot(static_cast<int>(i), static_cast<int>(k));
                l_rows_.push_back(static_cast<int>(i));
            }
        pivots_[k].l_end = static_cast<int>(slot.size());
    }
    for (auto& pivot : pivots_) {
        for (int l = pivot.l_begin; l < pivot.l_end; ++l)
            for (int u = pivot.u_begin; u < pivot.u_end; ++u)
                updates_.push_back(
                    slot.at({l_rows_[static_cast<std::size_t>(l - l_first_slot_)], u_columns_[static_cast<std::size_t>(u)]}));
    }
    scale_.assign(n, 0);
    p.for_each_entry([&](std::size_t entry, std::size_t row, std::size_t column) {
        entry_slot_.push_back(slot.at({step_of_row[row], step_of_column[column]}));
        entry_row_.push_back(p.rows()[entry]);
        scale_[row] = std::max(scale_[row], std::abs(values[entry]));
    });
    for (double& s : scale_) s = s > 0 ? 1 / s : 1;
    slots_.resize(slot.size()), inverse_pivot_.resize(n), work_.resize(n);
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
