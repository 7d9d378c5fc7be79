#include "nir/loops.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

namespace corpuscle::nir {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// The edges that leave each node, as indices.
std::vector<std::vector<std::size_t>> edges_from(const Graph& graph) {
    std::vector<std::vector<std::size_t>> out(graph.nodes.size());
    for (std::size_t e = 0; e < graph.edges.size(); ++e) out[graph.edges[e].from].push_back(e);
    return out;
}

/// The strongly connected component of each node: two nodes have the same one if they lie in a loop. Tarjan's algorithm, without recursion,
/// because a chain may be long.
class Components {
    const Graph& graph_;
    std::vector<std::vector<std::size_t>> leaving_;
    std::vector<std::size_t> number_, lowest_, open_;  // number_: order of the first visit; open_: visited nodes without a component
    std::vector<bool> is_open_;
    std::size_t visited_ = 0;
    struct Visit {
        std::size_t node, next_edge;
    };

    void enter(std::size_t node, std::vector<Visit>& visits) {
        number_[node] = lowest_[node] = visited_++;
        open_.push_back(node), is_open_[node] = true;
        visits.push_back({node, 0});
    }

    void leave(std::size_t node) {
        if (lowest_[node] != number_[node]) return;
        for (std::size_t member = none; member != node;) {
            member = open_.back(), open_.pop_back(), is_open_[member] = false;
            of[member] = node;
        }
    }

    void visit_from(std::size_t start) {
        std::vector<Visit> visits;
        enter(start, visits);
        while (!visits.empty()) {
            const std::size_t node = visits.back().node;
            if (visits.back().next_edge < leaving_[node].size()) {
                const auto to = graph_.edges[leaving_[node][visits.back().next_edge++]].to;
                if (number_[to] == none)
                    enter(to, visits);
                else if (is_open_[to])
                    lowest_[node] = std::min(lowest_[node], number_[to]);
                continue;
            }
            leave(node);
            visits.pop_back();
            if (!visits.empty()) lowest_[visits.back().node] = std::min(lowest_[visits.back().node], lowest_[node]);
        }
    }

public:
    std::vector<std::size_t> of;  ///< for each node

    explicit Components(const Graph& graph)
        : graph_(graph), leaving_(edges_from(graph)), number_(graph.nodes.size(), none), lowest_(graph.nodes.size()),
          is_open_(graph.nodes.size()), of(graph.nodes.size()) {
        for (std::size_t n = 0; n < graph.nodes.size(); ++n)
            if (number_[n] == none) visit_from(n);
    }
};

/// A node of a loop without delays. `waiting`: above 0 for the nodes in and behind such loops.
std::size_t node_of_loop(const Graph& graph, const Order& order, const std::vector<std::size_t>& waiting) {
    std::vector<std::size_t> source(graph.nodes.size(), none);  // a source of each waiting node that is waiting itself
    for (std::size_t e = 0; e < graph.edges.size(); ++e)
        if (!order.is_delayed[e] && waiting[graph.edges[e].from] > 0) source[graph.edges[e].to] = graph.edges[e].from;
    auto node = static_cast<std::size_t>(std::find_if(waiting.begin(), waiting.end(), [](auto n) { return n > 0; }) - waiting.begin());
    for (std::size_t k = 0; k < graph.nodes.size(); ++k) node = source[node];  // the way back from any such node ends in a loop
    return node;
}

}  // namespace

Result<Order> order_of(const Graph& graph) {
    Order order;
    const Components components(graph);
    std::vector<std::size_t> waiting(graph.nodes.size());  // edges from nodes that are not in the order yet
    for (const auto& e : graph.edges) {
        const bool has_membrane = graph.nodes[e.from].kind->form == NodeKind::Form::membrane;
        order.is_delayed.push_back(has_membrane && components.of[e.from] == components.of[e.to]);
        if (!order.is_delayed.back()) ++waiting[e.to];
    }
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (waiting[n] == 0) order.nodes.push_back(n);
    const auto leaving = edges_from(graph);
    for (std::size_t k = 0; k < order.nodes.size(); ++k)
        for (const auto e : leaving[order.nodes[k]])
            if (!order.is_delayed[e] && --waiting[graph.edges[e].to] == 0) order.nodes.push_back(graph.edges[e].to);
    if (order.nodes.size() == graph.nodes.size()) return order;
    const auto& node = graph.nodes[node_of_loop(graph, order, waiting)];
    return bad_input(fmt::format("node '{}' ({}) lies in a loop that has no node with a membrane, such as LIF or LI", node.name, node.kind->type));
}

}  // namespace corpuscle::nir
