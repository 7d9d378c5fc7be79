#pragma once
// The order in which the nodes of a graph are computed, and the edges that delay by one step.

#include "nir/graph.hpp"

namespace corpuscle::nir {

struct Order {
    std::vector<std::size_t> nodes;  ///< each after the nodes whose outputs of the same step it uses
    std::vector<bool> is_delayed;    ///< for each edge of the graph: it delays by one step
};

/// Returns an error if a loop has no node with a membrane.
Result<Order> order_of(const Graph&);

}  // namespace corpuscle::nir
