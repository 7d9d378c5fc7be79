#include "circuit/solve/linear/pivot_order.hpp"

#include <array>

#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {
namespace {

/// Removes rows and columns with one entry until there are none.
class SingletonSearch {
    struct Side {
        std::vector<std::vector<int>> crossing;  // for each row its columns, or for each column its rows
        std::vector<int> count;                  // of those that are not removed
        std::vector<char> is_removed;
    };
    Side rows_, columns_;

    static void add(Side& side, std::size_t k, std::size_t crossing) {
        side.crossing[k].push_back(static_cast<int>(crossing)), ++side.count[k];
    }
    static void remove(Side& side, int k, Side& other) {
        side.is_removed[static_cast<std::size_t>(k)] = 1;
        for (const int c : side.crossing[static_cast<std::size_t>(k)]) --other.count[static_cast<std::size_t>(c)];
    }
    /// Removes all of a side that have one entry, with the crossing rows or columns of this entry.
    static std::vector<std::pair<int, int>> remove_all(Side& side, Side& other) {
        std::vector<std::pair<int, int>> removed;
        std::vector<int> waiting;
        for (std::size_t k = 0; k < side.count.size(); ++k)
            if (side.count[k] == 1 && side.is_removed[k] == 0) waiting.push_back(static_cast<int>(k));
        while (!waiting.empty()) {
            const auto k = static_cast<std::size_t>(waiting.back());
            waiting.pop_back();
            if (side.is_removed[k] != 0 || side.count[k] != 1) continue;
            int crossing = -1;
            for (const int c : side.crossing[k])
                if (other.is_removed[static_cast<std::size_t>(c)] == 0) crossing = c;
            remove(side, static_cast<int>(k), other), remove(other, crossing, side);
            removed.emplace_back(static_cast<int>(k), crossing);
            for (const int next : other.crossing[static_cast<std::size_t>(crossing)])
                if (side.count[static_cast<std::size_t>(next)] == 1) waiting.push_back(next);
        }
        return removed;
    }

public:
    SingletonSearch(const SparsityPattern& p, std::span<const double> values) {
        const auto n = static_cast<std::size_t>(p.size());
        for (auto* side : {&rows_, &columns_}) side->crossing.resize(n), side->count.resize(n), side->is_removed.resize(n);
        p.for_each_entry([&](std::size_t e, std::size_t row, std::size_t column) {
            if (row == column && values[e] == 0) return;
            add(rows_, row, column), add(columns_, column, row);
        });
    }
    /// The first pivots (column, row) and the last ones (row, column), in the order of their removal.
    std::pair<std::vector<std::pair<int, int>>, std::vector<std::pair<int, int>>> run() {
        auto first = remove_all(columns_, rows_);
        auto last = remove_all(rows_, columns_);
        return {std::move(first), std::move(last)};
    }
    bool is_left(std::size_t row, std::size_t column) const { return rows_.is_removed[row] == 0 && columns_.is_removed[column] == 0; }
};

/// An order of the unknowns with little fill-in, by AMD. `kept`: the unknowns, ascending.
std::vector<int> minimum_degree(const SparsityPattern& p, const std::vector<int>& kept) {
    std::vector<int> number(static_cast<std::size_t>(p.size()), -1), begin, rows;
    for (std::size_t k = 0; k < kept.size(); ++k) number[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
    for (const int column : kept) {
        begin.push_back(static_cast<int>(rows.size()));
        for (int e = p.column_begin()[static_cast<std::size_t>(column)]; e < p.column_begin()[static_cast<std::size_t>(column) + 1]; ++e)
            if (const int row = number[static_cast<std::size_t>(p.rows()[static_cast<std::size_t>(e)])]; row >= 0) rows.push_back(row);
    }
    begin.push_back(static_cast<int>(rows.size()));
    auto order = minimum_degree_order(begin, rows);
    for (int& k : order) k = kept[static_cast<std::size_t>(k)];
    return order;
}

}  // namespace

std::optional<PivotOrder> diagonal_pivot_order(const SparsityPattern& p, std::span<const double> values) {
    SingletonSearch search(p, values);
    const auto [first, last] = search.run();
    std::vector<int> kept;
    for (int k = 0; k < p.size(); ++k) {
        const auto n = static_cast<std::size_t>(k);
        if (!search.is_left(n, n)) continue;
        const int diagonal = p.find_entry(k, k);
        if (diagonal < 0 || values[static_cast<std::size_t>(diagonal)] == 0) return {};
        kept.push_back(k);
    }
    if (first.size() + last.size() + kept.size() != static_cast<std::size_t>(p.size())) return {};  // a row is left without its column
    const auto middle = minimum_degree(p, kept);
    if (middle.size() != kept.size()) return {};
    PivotOrder out;
    const auto add = [&](int row, int column) { out.rows.push_back(row), out.columns.push_back(column); };
    const auto begin_block = [&] { out.block_begin.push_back(static_cast<int>(out.rows.size())); };
    for (const auto& [column, row] : first) begin_block(), add(row, column);
    if (!middle.empty()) begin_block();
    for (const int k : middle) add(k, k);
    for (auto at = last.rbegin(); at != last.rend(); ++at) begin_block(), add(at->first, at->second);
    begin_block();
    return out;
}

}  // namespace corpuscle::circuit
