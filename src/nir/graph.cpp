#include "nir/graph.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::nir {
namespace {

constexpr std::uint64_t max_elements = std::uint64_t{1} << 25;  // of the inputs and outputs of all nodes

using Shapes = std::map<std::string, Shape, std::less<>>;

/// Checks one node and completes its shapes.
class NodeCheck {
    Node& node_;
    const Shapes& shapes_;
    const std::string& path_;

    template <class... T>
    Error bad(fmt::format_string<T...> format, T&&... values) const {
        return bad_input(
            fmt::format("node '{}' ({}): {}", node_.name, node_.kind->type, fmt::format(format, std::forward<T>(values)...)), {path_});
    }

    const Shape& shape_of(std::string_view parameter) const { return shapes_.find(parameter)->second; }

    Result<void> check_names() const {
        for (const auto& [name, values] : node_.values) {
            const auto known = node_.kind->parameters;
            if (std::none_of(known.begin(), known.end(), [given = &name](const auto& p) { return p.name == *given; }))
                return bad("unknown parameter '{}'; a {} has {}", name, node_.kind->type, fmt::join(names(), ", "));
        }
        for (const auto& p : node_.kind->parameters)
            if (!p.default_value && !node_.values.contains(p.name)) return bad("has no {}", p.name);
        return {};
    }
    std::vector<std::string_view> names() const {
        std::vector<std::string_view> out;
        for (const auto& p : node_.kind->parameters) out.push_back(p.name);
        return out;
    }

    Result<void> check_values() const {
        for (const auto& p : node_.kind->parameters) {
            const auto found = node_.values.find(p.name);
            if (found == node_.values.end()) continue;
            for (std::size_t k = 0; k < found->second.size(); ++k)
                if (const double x = found->second[k]; !std::isfinite(x) || (p.is_positive && x <= 0))
                    return bad("{}[{}] = {}, but {} is required", p.name, k, x, p.is_positive ? "a number above 0" : "a finite number");
        }
        return {};
    }

    Result<void> complete_port() {
        const auto& values = node_.value("shape");
        for (const double n : values)
            if (n < 1 || n > 0x1p31 || n != std::floor(n)) return bad("shape has {}, but lengths from 1 to 2^31 are required", n);
        node_.input_shape.assign(values.begin(), values.end());
        node_.output_shape = node_.input_shape;
        return {};
    }

    Result<void> complete_matrix() {
        const auto& weight = shape_of("weight");
        if (weight.size() != 2) return bad("weight has the shape {}, but [outputs, inputs] is required", shape_text(weight));
        node_.output_shape = {weight[0]}, node_.input_shape = {weight[1]};
        if (node_.values.contains("bias") && shape_of("bias") != node_.output_shape)
            return bad("bias has the shape {}, but the {} of weight is required", shape_text(shape_of("bias")),
                       shape_text(node_.output_shape));
        return {};
    }

    /// All parameters have the same shape, or are single numbers.
    Result<void> complete_elements() {
        Shape shape;
        for (const auto& p : node_.kind->parameters)
            if (node_.values.contains(p.name) && !shape_of(p.name).empty() && shape.empty()) shape = shape_of(p.name);
        for (const auto& p : node_.kind->parameters)
            if (node_.values.contains(p.name) && !shape_of(p.name).empty() && shape_of(p.name) != shape)
                return bad("{} has the shape {}, but another parameter {}", p.name, shape_text(shape_of(p.name)), shape_text(shape));
        node_.input_shape = node_.output_shape = shape;
        for (const auto& p : node_.kind->parameters) {
            auto& values = node_.values[std::string(p.name)];
            if (values.empty() && p.default_value) values = {*p.default_value};
            if (values.size() == 1) values.assign(elements_of(shape), values[0]);
        }
        return {};
    }

public:
    NodeCheck(Node& node, const Shapes& shapes, const std::string& path) : node_(node), shapes_(shapes), path_(path) {}

    Result<void> run() {
        TRY(check_names());
        TRY(check_values());
        const auto form = node_.kind->form;
        TRY(form == NodeKind::Form::port     ? complete_port()
            : form == NodeKind::Form::matrix ? complete_matrix()
                                             : complete_elements());
        if (node_.inputs() == 0 || node_.outputs() == 0) return bad("has no elements");
        return {};
    }
};

/// A single number has the shape [], which means the same as [1].
Shape as_list(const Shape& shape) { return shape.empty() ? Shape{1} : shape; }

}  // namespace

std::uint64_t elements_of(const Shape& shape) {
    std::uint64_t count = 1;
    for (const auto n : shape) {
        if (n > 0 && count > std::numeric_limits<std::uint64_t>::max() / n) return std::numeric_limits<std::uint64_t>::max();
        count *= n;
    }
    return count;
}

std::string shape_text(const Shape& shape) { return fmt::format("[{}]", fmt::join(shape, ", ")); }

std::size_t Graph::input_count() const {
    std::size_t count = 0;
    for (const auto n : inputs) count += nodes[n].inputs();
    return count;
}

std::size_t Graph::output_count() const {
    std::size_t count = 0;
    for (const auto n : outputs) count += nodes[n].outputs();
    return count;
}

double Graph::shortest_time_constant() const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& node : nodes)
        for (const auto& p : node.kind->parameters)
            if (p.is_positive)  // the parameters that must be above 0 are the time constants
                for (const double tau : node.value(p.name)) shortest = std::min(shortest, tau);
    return shortest;
}

Result<void> complete_node(Node& node, const Shapes& shapes, const std::string& path) { return NodeCheck(node, shapes, path).run(); }

Result<void> check_graph(const Graph& graph, const std::string& path) {
    std::uint64_t left = max_elements;
    for (const auto& node : graph.nodes)
        for (const auto count : {node.inputs(), node.outputs()}) {
            if (count > left) return bad_input(fmt::format("the nodes of the graph have more than {} elements", max_elements), {path});
            left -= count;
        }
    if (graph.inputs.empty() || graph.outputs.empty())
        return bad_input(fmt::format("the graph has no node of the type {}", graph.inputs.empty() ? "Input" : "Output"), {path});
    std::vector<bool> has_source(graph.nodes.size());
    for (const auto n : graph.inputs) has_source[n] = true;
    for (const auto& e : graph.edges) {
        const auto &from = graph.nodes[e.from], &to = graph.nodes[e.to];
        if (as_list(from.output_shape) != as_list(to.input_shape))
            return bad_input(
                fmt::format("the edge from '{}' to '{}' joins different shapes: the output of '{}' ({}) is {}, the input of '{}' ({}) is {}",
                            from.name, to.name, from.name, from.kind->type, shape_text(from.output_shape), to.name, to.kind->type,
                            shape_text(to.input_shape)),
                {path});
        has_source[e.to] = true;
    }
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (!has_source[n])
            return bad_input(fmt::format("no edge enters node '{}' ({})", graph.nodes[n].name, graph.nodes[n].kind->type), {path});
    return {};
}

}  // namespace corpuscle::nir
