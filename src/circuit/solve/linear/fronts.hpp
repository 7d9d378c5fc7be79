#pragma once
// The fronts of a sparse elimination: groups of successive pivots whose columns of L have nearly the same rows. A group is eliminated in
// one dense matrix, and adds what is left of it to that of its parent (the multifrontal method of Duff and Reid, 1983).

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace corpuscle::circuit {

struct FrontTree {
    static constexpr int no_parent = -1;
    struct Node {
        int begin, end;         // pivots
        std::size_t first_row;  // index in `rows` of the other rows of the front
        int others;             // their number
        int parent;             // node with the pivot of the first of these rows
        int size() const { return end - begin + others; }
        int pivots() const { return end - begin; }
    };
    std::vector<Node> nodes;  ///< each before its parent; the children of a node are those just before it that are not below another child
    std::vector<int> rows;    ///< ascending in each node
    std::vector<int> order;   ///< the pivot of `nodes` and `rows` with number k is order[k] of the given matrix
    double multiplications = 0;  ///< of an elimination without use of symmetry

    std::span<const int> other_rows(const Node& n) const {
        return std::span(rows).subspan(n.first_row, static_cast<std::size_t>(n.others));
    }
};

/// `below`: for each entry of the matrix off the diagonal the pair (larger index, smaller index), any order, duplicates allowed. Rows and
/// columns are numbered by elimination step.
FrontTree make_front_tree(int size, std::vector<std::pair<int, int>> below);

}  // namespace corpuscle::circuit
