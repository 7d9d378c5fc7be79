#include "circuit/solve/linear/fronts.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace corpuscle::circuit {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// The lists of second elements, by first element, ascending and without duplicates.
struct Lists {
    std::vector<std::size_t> begin;
    std::vector<int> values;

    Lists(int size, Pairs& pairs) : begin(at(size) + 1) {
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        for (const auto& [first, second] : pairs) ++begin[at(first) + 1], values.push_back(second);
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
    }
    std::span<const int> operator[](int k) const { return std::span(values).subspan(begin[at(k)], begin[at(k) + 1] - begin[at(k)]); }
};

/// The parent of each pivot in the elimination tree (Liu): the first row below the diagonal in its column of L.
std::vector<int> elimination_tree(const Lists& columns_of_row, int size) {
    std::vector<int> parent(at(size), FrontTree::no_parent), ancestor = parent;
    for (int row = 0; row < size; ++row)
        for (const int column : columns_of_row[row])
            for (int k = column; k != FrontTree::no_parent && k != row;) {
                const int next = std::exchange(ancestor[at(k)], row);
                if (next == FrontTree::no_parent) parent[at(k)] = row;
                k = next;
            }
    return parent;
}

/// An order in which the pivots below each pivot of the tree directly precede it.
std::vector<int> postorder(const std::vector<int>& parent) {
    const int size = static_cast<int>(parent.size());
    std::vector<int> first_child(parent.size(), -1), sibling(parent.size(), -1), out, stack;
    for (int k = size - 1; k >= 0; --k)
        if (parent[at(k)] >= 0) sibling[at(k)] = std::exchange(first_child[at(parent[at(k)])], k);
    for (int root = 0; root < size; ++root) {
        if (parent[at(root)] >= 0) continue;
        for (stack.push_back(root); !stack.empty();) {
            const int k = stack.back();
            if (const int child = std::exchange(first_child[at(k)], -1); child >= 0)
                for (int c = child; c >= 0; c = sibling[at(c)]) stack.push_back(c);
            else
                out.push_back(k), stack.pop_back();
        }
    }
    return out;
}

/// Merges the pivots of a column with those of its parent where this makes the matrices larger, but few numbers are zero in them.
class Merger {
    std::vector<FrontTree::Node>& nodes_;
    std::vector<double> zeros_;  // by node

    /// The part of zeros up to which a front with this number of pivots is made.
    static double max_zeros(int pivots) { return pivots <= 4 ? 1 : pivots <= 16 ? 0.8 : pivots <= 48 ? 0.1 : 0.05; }
    static double numbers(const FrontTree::Node& n) { return n.pivots() * (n.pivots() + 1) / 2.0 + double(n.pivots()) * n.others; }

public:
    explicit Merger(std::vector<FrontTree::Node>& nodes) : nodes_(nodes), zeros_(nodes.size()) {}

    /// Merges the child, whose pivots directly precede those of the parent, into the parent.
    bool merge(int child, int parent) {
        auto &c = nodes_[at(child)], &p = nodes_[at(parent)];
        FrontTree::Node both = p;
        both.begin = c.begin;
        const double added = numbers(both) - numbers(c) - numbers(p), zeros = zeros_[at(child)] + zeros_[at(parent)] + added;
        if (added > 0 && zeros > max_zeros(both.pivots()) * numbers(both)) return false;
        p = both, zeros_[at(parent)] = zeros;
        return true;
    }
};

/// The tree with its pivots in the order of postorder(), so that each pivot directly follows those below it.
struct OrderedTree {
    std::vector<int> order, parent;

    explicit OrderedTree(const std::vector<int>& parent_before) : order(postorder(parent_before)), parent(order.size()) {
        const auto number = numbers();
        for (std::size_t k = 0; k < order.size(); ++k) {
            const int p = parent_before[at(order[k])];
            parent[k] = p < 0 ? FrontTree::no_parent : number[at(p)];
        }
    }
    /// By pivot in the order before.
    std::vector<int> numbers() const {
        std::vector<int> out(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) out[at(order[k])] = static_cast<int>(k);
        return out;
    }
};

/// The rows below the diagonal in each column of L: those of the matrix and of the columns below it in the tree. Empty if they are too
/// many.
std::vector<std::vector<int>> rows_with_fill(const Lists& rows_of_column, const std::vector<int>& parent) {
    constexpr std::size_t max_fill = 200;  // rows for each one of the matrix; this limits the memory
    const std::size_t max_rows = max_fill * (parent.size() + rows_of_column.values.size());
    std::vector<std::vector<int>> rows(parent.size()), children(parent.size());
    std::vector<int> last_column_with(parent.size(), -1);
    std::size_t count = 0;
    for (int k = 0; k < static_cast<int>(parent.size()); ++k) {
        auto& own = rows[at(k)];
        const auto add = [&](std::span<const int> from) {
            for (const int row : from)
                if (row > k && std::exchange(last_column_with[at(row)], k) != k) own.push_back(row);
        };
        add(rows_of_column[k]);
        for (const int child : children[at(k)]) add(rows[at(child)]);
        std::sort(own.begin(), own.end());
        if ((count += own.size()) > max_rows) return {};
        if (parent[at(k)] >= 0) children[at(parent[at(k)])].push_back(k);
    }
    return rows;
}

/// Groups of pivots, each at the place of its last pivot; the places of the others are empty.
std::vector<std::optional<FrontTree::Node>> merged_nodes(const std::vector<std::vector<int>>& rows, const std::vector<int>& parent) {
    std::vector<FrontTree::Node> nodes;
    for (const auto& each : rows) {
        const int k = static_cast<int>(nodes.size());
        nodes.push_back({k, k + 1, 0, static_cast<int>(each.size()), 0});
    }
    Merger merger(nodes);
    std::vector<std::optional<FrontTree::Node>> out(nodes.size());
    for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
        // The last child directly precedes the first pivot of its parent, again and again.
        for (int child = k - 1; child >= 0 && parent[at(child)] >= nodes[at(k)].begin && parent[at(child)] <= k && merger.merge(child, k);
             child = nodes[at(k)].begin - 1)
            out[at(child)].reset();
        out[at(k)] = nodes[at(k)];
    }
    return out;
}

}  // namespace

/// Without nodes if there is too much fill-in.
FrontTree make_front_tree(int size, Pairs below) {
    const OrderedTree tree(elimination_tree(Lists(size, below), size));
    const auto number = tree.numbers();
    for (auto& [first, second] : below) {  // now (column, row), with the new numbers
        first = number[at(first)], second = number[at(second)];
        if (first > second) std::swap(first, second);
    }
    const auto rows = rows_with_fill(Lists(size, below), tree.parent);
    FrontTree out;
    out.order = tree.order;
    for (const auto& each : rows) {
        const auto count = static_cast<double>(each.size());
        out.multiplications += count * (count + 1);
    }
    std::vector<int> node_of(at(size));
    for (const auto& merged : merged_nodes(rows, tree.parent)) {
        if (!merged) continue;
        auto node = *merged;
        const auto& others = rows[at(node.end - 1)];
        node.first_row = out.rows.size();
        out.rows.insert(out.rows.end(), others.begin(), others.end());
        std::fill(node_of.begin() + node.begin, node_of.begin() + node.end, static_cast<int>(out.nodes.size()));
        out.nodes.push_back(node);
    }
    for (auto& node : out.nodes) node.parent = node.others == 0 ? FrontTree::no_parent : node_of[at(out.rows[node.first_row])];
    return out;
}

}  // namespace corpuscle::circuit
