#pragma once
// A NIR graph: nodes and the edges between them.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "nir/node_kinds.hpp"

namespace corpuscle::nir {

/// The lengths of an array in each dimension.
using Shape = std::vector<std::uint64_t>;

std::uint64_t elements_of(const Shape&);
std::string shape_text(const Shape&);  ///< "[38, 12]"

struct Node {
    std::string name;  ///< of a node in a graph within the graph: "inner.lif"
    const NodeKind* kind = nullptr;
    Shape input_shape{}, output_shape{};
    /// The values of each parameter in row-major order: of a matrix [output, input], otherwise one for each element.
    std::map<std::string, std::vector<double>, std::less<>> values{};

    std::size_t inputs() const { return elements_of(input_shape); }
    std::size_t outputs() const { return elements_of(output_shape); }
    /// True if it has one membrane, which can be recorded.
    bool has_single_membrane() const { return kind->form == NodeKind::Form::membrane && outputs() == 1; }
    const std::vector<double>& value(std::string_view parameter) const { return values.find(parameter)->second; }
};

/// The output of node `from` is added to the input of node `to`; both are indices.
struct Edge {
    std::size_t from, to;
};

struct Graph {
    std::string version;  ///< of NIR, as the file states it
    std::vector<Node> nodes;
    std::vector<Edge> edges;
    std::vector<std::size_t> inputs, outputs;  ///< the nodes through which signals enter and leave, ordered by name

    std::size_t input_count() const;   ///< number of signals that enter
    std::size_t output_count() const;  ///< number of signals that leave
    /// The shortest time constant of all nodes, s; infinity if there is none.
    double shortest_time_constant() const;
};

/// Sets the shapes of a node from its values, and checks them. `shapes`: the shape of each parameter; a parameter of a membrane that is a
/// single number, of shape [], applies to all elements. Fills in parameters that were left out. `path`: of the file, for messages.
Result<void> complete_node(Node&, const std::map<std::string, Shape, std::less<>>& shapes, const std::string& path);

/// Checks the size of the graph and its edges: shapes agree, and every node except the inputs has an edge that enters it. The graph must
/// have an input and an output.
Result<void> check_graph(const Graph&, const std::string& path);

}  // namespace corpuscle::nir
