#include "circuit/solve/linear/front_elimination.hpp"

#include <algorithm>
#include <cmath>

#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {
namespace {

std::size_t to_size(int k) { return static_cast<std::size_t>(k); }

std::size_t rounded_up(std::size_t n) { return (n + 7) / 8 * 8; }

}  // namespace

std::optional<FrontElimination> FrontElimination::make(const SparsityPattern& p, const PivotOrder& order, std::span<const double> values) {
    const auto set = instruction_set();
    if (!set) return {};
    const auto &rows = order.rows, &columns = order.columns, &block_begin = order.block_begin;
    FrontElimination out;
    out.kernels_ = &lanes::front_kernel_table(*set);
    const auto step_of_row = inverse_permutation(rows), step_of_column = inverse_permutation(columns);
    std::vector<int> block_of(rows.size());
    for (std::size_t b = 0; b + 1 < block_begin.size(); ++b)
        std::fill(block_of.begin() + block_begin[b], block_of.begin() + block_begin[b + 1], static_cast<int>(b));
    std::vector<std::pair<int, int>> below;
    out.scale_.assign(rows.size(), 0);
    p.for_each_entry([&](std::size_t entry, std::size_t row, std::size_t column) {
        const int i = step_of_row[row], j = step_of_column[column];
        if (i != j && block_of[to_size(i)] == block_of[to_size(j)]) below.emplace_back(std::max(i, j), std::min(i, j));
        out.scale_[row] = std::max(out.scale_[row], std::abs(values[entry]));
    });
    for (double& s : out.scale_) s = s > 0 ? 1 / s : 1;
    out.tree_ = make_front_tree(p.size(), std::move(below));
    if (out.tree_.nodes.empty()) return {};
    for (const int k : out.tree_.order) out.rows_.push_back(rows[to_size(k)]), out.columns_.push_back(columns[to_size(k)]);
    // The order of the fronts keeps the pivots of a block together, and the blocks in their order.
    std::size_t node = 0;
    for (std::size_t b = 1; b < block_begin.size(); ++b) {
        while (node < out.tree_.nodes.size() && out.tree_.nodes[node].end <= block_begin[b]) ++node;
        out.blocks_.push_back({node, 0, block_begin[b]});
    }
    out.connect_nodes();
    out.place_entries(p);
    return out;
}

/// Makes the lists of children, and the places of the rows of each front in that of its parent.
void FrontElimination::connect_nodes() {
    const auto& nodes = tree_.nodes;
    std::vector<std::vector<int>> children(nodes.size());
    place_in_parent_.resize(tree_.rows.size());
    std::size_t lower = 0, upper = 0, size = 0, contribution = 0, max_contributions = 0;
    std::vector<std::size_t> contribution_of(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto& n = nodes[k];
        const auto others = to_size(n.others), pivots = to_size(n.pivots());
        const std::size_t stride = rounded_up(to_size(n.size()) + lanes::front_padding);
        nodes_.push_back({0, 0, 0, children_.size(), children_.size() + children[k].size(), lower, upper, stride});
        children_.insert(children_.end(), children[k].begin(), children[k].end());
        for (const int child : children[k]) contribution -= contribution_of[to_size(child)];
        contribution += contribution_of[k] = others * others;
        max_contributions = std::max(max_contributions, contribution);
        lower += pivots * to_size(n.size()), upper += pivots * others;
        max_front_ = std::max(max_front_, stride * to_size(n.size())), size = std::max(size, to_size(n.size()));
        if (n.parent == FrontTree::no_parent) continue;
        children[to_size(n.parent)].push_back(static_cast<int>(k));
        const auto& parent = nodes[to_size(n.parent)];
        const auto parent_rows = tree_.other_rows(parent);
        for (std::size_t r = 0; r < others; ++r) {
            const int row = tree_.rows[n.first_row + r];
            place_in_parent_[n.first_row + r] =
                row < parent.end ? row - parent.begin
                                 : parent.pivots() + static_cast<int>(std::lower_bound(parent_rows.begin(), parent_rows.end(), row) -
                                                                      parent_rows.begin());
        }
    }
    lower_.resize(lower), upper_size_ = upper, inverse_pivot_.resize(rows_.size()), contributions_.resize(max_contributions);
    max_size_ = size, work_.resize(rows_.size()), rest_.resize(size);
    buffers_.resize((max_front_ + 2 * lanes::front_block * rounded_up(size + lanes::front_padding)) / 8);
}

/// Finds the place of each matrix entry.
void FrontElimination::place_entries(const SparsityPattern& p) {
    const auto step_of_row = inverse_permutation(rows_), step_of_column = inverse_permutation(columns_);
    std::vector<std::size_t> node_of(rows_.size()), block_of(rows_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
        for (int pivot = tree_.nodes[k].begin; pivot < tree_.nodes[k].end; ++pivot) node_of[to_size(pivot)] = k;
    for (std::size_t b = 0, k = 0; b < blocks_.size(); ++b)
        for (; k < to_size(blocks_[b].end_pivot); ++k) block_of[k] = b;
    std::vector<std::pair<std::size_t, FrontEntry>> front_entries;  // with 2 node + (1 above the diagonal)
    std::vector<std::pair<std::size_t, CouplingEntry>> couplings;   // with the block of the column
    p.for_each_entry([&](std::size_t entry, std::size_t row, std::size_t column) {
        const int i = step_of_row[row], j = step_of_column[column], e = static_cast<int>(entry), row_of_A = static_cast<int>(row);
        if (block_of[to_size(i)] > block_of[to_size(j)]) return zeros_.push_back(e);
        if (block_of[to_size(i)] != block_of[to_size(j)]) return couplings.push_back({block_of[to_size(j)], {e, i, j, row_of_A}});
        const std::size_t k = node_of[to_size(std::min(i, j))];
        const auto& n = tree_.nodes[k];
        const auto others = tree_.other_rows(n);
        const auto place = [&](int pivot) {
            return pivot < n.end ? to_size(pivot - n.begin)
                                 : to_size(n.pivots()) +
                                       static_cast<std::size_t>(std::lower_bound(others.begin(), others.end(), pivot) - others.begin());
        };
        const int mirror = p.find_entry(rows_[to_size(j)], columns_[to_size(i)]);
        can_be_symmetric_ &= mirror >= 0;
        front_entries.push_back({2 * k + (i < j), {e, row_of_A, mirror, place(i) + place(j) * nodes_[k].stride}});
    });
    const auto by_group = [](const auto& a, const auto& b) {
        return std::pair(a.first, a.second.entry) < std::pair(b.first, b.second.entry);
    };
    std::sort(front_entries.begin(), front_entries.end(), by_group), std::sort(couplings.begin(), couplings.end(), by_group);
    std::size_t at = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const auto end_of = [&](std::size_t group) {
            while (at < front_entries.size() && front_entries[at].first == group) ++at;
            return at;
        };
        nodes_[k].first_entry = at, nodes_[k].first_upper = end_of(2 * k), nodes_[k].end_entry = end_of(2 * k + 1);
    }
    for (const auto& each : front_entries) front_entries_.push_back(each.second);
    std::size_t end = 0;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        while (end < couplings.size() && couplings[end].first == b) ++end;
        blocks_[b].end_coupling = end;
    }
    for (const auto& each : couplings) couplings_.push_back(each.second);
    coupling_values_.resize(couplings_.size());
}

bool FrontElimination::has_equal_halves(std::span<const double> values) const {
    return can_be_symmetric_ && std::all_of(front_entries_.begin(), front_entries_.end(),
                                            [&](const FrontEntry& p) { return values[to_size(p.entry)] == values[to_size(p.mirror)]; });
}

/// Writes the entries of a node into its front, which is zero.
void FrontElimination::assemble(const Node& node, std::span<const double> values, double* front) const {
    if (is_symmetric_) {
        for (std::size_t k = node.first_entry; k < node.first_upper; ++k)
            front[front_entries_[k].offset] = values[to_size(front_entries_[k].entry)];
    } else {
        for (std::size_t k = node.first_entry; k < node.end_entry; ++k)
            front[front_entries_[k].offset] = values[to_size(front_entries_[k].entry)] * scale_[to_size(front_entries_[k].row)];
    }
}

bool FrontElimination::factor(std::span<const double> values) {
    if (std::ranges::any_of(zeros_, [&](int entry) { return values[to_size(entry)] != 0; })) return false;
    is_symmetric_ = has_equal_halves(values), growth_ = 0;
    if (!is_symmetric_) upper_.resize(upper_size_);
    for (std::size_t k = 0; k < couplings_.size(); ++k)
        coupling_values_[k] = values[to_size(couplings_[k].entry)] * (is_symmetric_ ? 1 : scale_[to_size(couplings_[k].row_of_A)]);
    double* const front = buffers_.data()->values;
    double* const rows = front + max_front_;
    double* const columns = rows + lanes::front_block * rounded_up(max_size_ + lanes::front_padding);
    double* contribution = contributions_.data();  // end of the contributions that are not yet added
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const auto& node = nodes_[k];
        const auto& n = tree_.nodes[k];
        const auto size = to_size(n.size()), pivots = to_size(n.pivots()), others = to_size(n.others), stride = node.stride;
        for (std::size_t j = 0; j < size; ++j) std::fill(front + j * stride + (is_symmetric_ ? j : 0), front + j * stride + size, 0.0);
        assemble(node, values, front);
        for (std::size_t c = node.end_child; c-- > node.first_child;) {  // the last contribution first
            const auto& child = tree_.nodes[to_size(children_[c])];
            const auto count = to_size(child.others);
            const int* const place = place_in_parent_.data() + child.first_row;
            contribution -= count * count;
            for (std::size_t j = 0; j < count; ++j) {
                double* const to = front + to_size(place[j]) * stride;
                const double* const from = contribution + j * count;
                for (std::size_t i = is_symmetric_ ? j : 0; i < count; ++i) to[place[i]] += from[i];
            }
        }
        const double multiplier =
            kernels_->factor({front, size, stride, pivots, is_symmetric_, inverse_pivot_.data() + n.begin, rows, columns});
        if (!(multiplier <= max_multiplier)) return false;
        growth_ = std::max(growth_, multiplier);
        for (std::size_t j = 0; j < pivots; ++j) std::copy_n(front + j * stride, size, lower_.data() + node.lower + j * size);
        for (std::size_t j = 0; j < others; ++j, contribution += others)
            std::copy_n(front + (pivots + j) * stride + pivots + (is_symmetric_ ? j : 0), others - (is_symmetric_ ? j : 0),
                        contribution + (is_symmetric_ ? j : 0));
        for (std::size_t j = 0; j < others && !is_symmetric_; ++j)
            for (std::size_t i = 0; i < pivots; ++i) upper_[node.upper + i * others + j] = front[(pivots + j) * stride + i];
    }
    return true;
}

lanes::FrontFactors FrontElimination::factors_of(std::size_t k) const {
    const auto& n = tree_.nodes[k];
    return {lower_.data() + nodes_[k].lower, is_symmetric_ ? nullptr : upper_.data() + nodes_[k].upper, inverse_pivot_.data() + n.begin,
            to_size(n.size()), to_size(n.pivots())};
}

void FrontElimination::solve(std::span<double> b) const {
    double *const y = work_.data(), *const rest = rest_.data();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const auto row = to_size(rows_[k]);
        y[k] = is_symmetric_ ? b[row] : b[row] * scale_[row];
    }
    for (std::size_t block = blocks_.size(); block-- > 0;) {
        const std::size_t first = block == 0 ? 0 : blocks_[block - 1].end_node, end = blocks_[block].end_node;
        for (std::size_t k = first; k < end; ++k) {
            const auto& n = tree_.nodes[k];
            const int* const others = tree_.rows.data() + n.first_row;
            for (std::size_t r = 0; r < to_size(n.others); ++r) rest[r] = y[others[r]];
            kernels_->forward(factors_of(k), y + n.begin, rest);
            for (std::size_t r = 0; r < to_size(n.others); ++r) y[others[r]] = rest[r];
        }
        for (std::size_t k = end; k-- > first;) {
            const auto& n = tree_.nodes[k];
            const int* const others = tree_.rows.data() + n.first_row;
            for (std::size_t r = 0; r < to_size(n.others); ++r) rest[r] = y[others[r]];
            kernels_->backward(factors_of(k), y + n.begin, rest);
        }
        for (std::size_t k = block == 0 ? 0 : blocks_[block - 1].end_coupling; k < blocks_[block].end_coupling; ++k)
            y[couplings_[k].row] -= coupling_values_[k] * y[couplings_[k].column];
    }
    for (std::size_t k = 0; k < columns_.size(); ++k) b[to_size(columns_[k])] = y[k];
}

}  // namespace corpuscle::circuit
