// From the datasets of a NIR file to a graph. A file has the datasets /version, /node/type ("NIRGraph"), /node/edges and, for each node,
// /node/nodes/NAME/type and its parameters.

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "nir/graph_file.hpp"

namespace corpuscle::nir {
namespace {

constexpr int max_depth = 16;  // of graphs within graphs
constexpr std::size_t max_nodes = 100'000;

class GraphReader {
    std::map<std::string, const Hdf5Array*, std::less<>> arrays_;  // by path
    const std::string& path_;
    Graph graph_;
    /// The nodes with which an edge to or from a name connects: for a graph within the graph, its Input and Output.
    struct Ends {
        std::size_t in, out;
    };
    using NamedEnds = std::map<std::string, Ends, std::less<>>;
    std::set<std::string> names_;  // of all nodes

    Error bad(std::string message) const { return bad_input(std::move(message), {path_}); }

    const Hdf5Array* find(const std::string& path) const {
        const auto found = arrays_.find(path);
        return found == arrays_.end() ? nullptr : found->second;
    }

    /// The text of a dataset that has a single one; "" if there is no such dataset.
    std::string text(const std::string& path) const {
        const auto* array = find(path);
        return array && array->texts.size() == 1 ? array->texts[0] : "";
    }

    /// The names of the groups and datasets in a group.
    std::vector<std::string> members(const std::string& group) const {
        std::vector<std::string> out;
        for (auto at = arrays_.lower_bound(group + "/"); at != arrays_.end() && at->first.starts_with(group + "/"); ++at) {
            auto name = at->first.substr(group.size() + 1);
            name.resize(std::min(name.find('/'), name.size()));
            if (out.empty() || out.back() != name) out.push_back(std::move(name));
        }
        return out;
    }

    Result<Ends> add_node(const std::string& group, const std::string& name, const std::string& type) {
        const auto* kind = find_node_kind(type);
        std::vector<std::string_view> known;
        for (const auto& k : node_kinds()) known.push_back(k.type);
        if (is_other_nir_type(type))
            return bad(fmt::format("node '{}' has the type {}, which is not simulated; the types are {}", name, type, joined(known)));
        if (!kind) return bad(fmt::format("node '{}' has the unknown type '{}'{}", name, type, did_you_mean(type, known)));
        if (graph_.nodes.size() == max_nodes) return bad(fmt::format("the graph has more than {} nodes", max_nodes));
        Node node{.name = name, .kind = kind};
        std::map<std::string, Shape, std::less<>> shapes;
        for (const auto& member : members(group)) {
            if (member == "type" || member == "metadata") continue;
            const auto* array = find(group + "/" + member);
            if (!array || array->is_text || array->is_other)
                return bad(fmt::format("node '{}' ({}): '{}' is not a dataset of numbers", name, type, member));
            node.values[member] = array->numbers, shapes[member] = array->shape;
        }
        TRY(complete_node(node, shapes, path_));
        if (!names_.insert(name).second) return bad(fmt::format("two nodes have the name '{}', which a graph within the graph gives to one", name));
        graph_.nodes.push_back(std::move(node));
        return Ends{graph_.nodes.size() - 1, graph_.nodes.size() - 1};
    }

    /// The only one of the ports of a graph within the graph.
    Result<std::size_t> only_port(const std::vector<std::size_t>& ports, std::string_view type, const std::string& graph) const {
        if (ports.size() == 1) return ports[0];
        return bad(fmt::format("the graph '{}' within the graph has {} nodes of the type {}, but one is required", graph, ports.size(), type));
    }

    /// Adds the edges of one graph. `ends`: of its nodes and of the graphs within it, by name.
    Result<void> add_edges(const std::string& group, const NamedEnds& ends) {
        const auto* edges = find(group + "/edges");
        if (!edges) return bad(fmt::format("has no dataset {}/edges", group));
        if (edges->shape.size() != 2 || edges->shape[1] != 2 || (!edges->is_text && edges->element_count() > 0))
            return bad(fmt::format("{}/edges has the shape {}, but pairs of names are required: [edges, 2]", group, shape_text(edges->shape)));
        std::vector<std::string_view> names;
        for (const auto& e : ends) names.push_back(e.first);
        for (std::size_t k = 0; k + 1 < edges->texts.size(); k += 2) {
            const auto from = ends.find(edges->texts[k]), to = ends.find(edges->texts[k + 1]);
            for (const auto& [end, name] : {std::pair(from, edges->texts[k]), std::pair(to, edges->texts[k + 1])})
                if (end == ends.end())
                    return bad(fmt::format("{}/edges: edge {} names the node '{}', which does not exist{}", group, k / 2, name, did_you_mean(name, names)));
            graph_.edges.push_back({from->second.out, to->second.in});
        }
        return {};
    }

    /// Adds the nodes of a graph. Of a graph within the graph, whose nodes have names that begin with `prefix`, returns the ends.
    Result<Ends> add_graph(const std::string& group, const std::string& prefix, int depth) {
        if (depth > max_depth) return bad(fmt::format("graphs within graphs are nested more than {} deep", max_depth));
        NamedEnds ends;
        std::vector<std::size_t> inputs, outputs;
        for (const auto& name : members(group + "/nodes")) {
            const auto node = group + "/nodes/" + name;
            const auto type = text(node + "/type");
            if (type.empty()) return bad(fmt::format("{} has no type", node));
            const auto added = TRY(type == "NIRGraph" ? add_graph(node, prefix + name + ".", depth + 1) : add_node(node, prefix + name, type));
            ends[name] = added;
            if (type == "Input") inputs.push_back(added.in);
            if (type == "Output") outputs.push_back(added.out);
        }
        TRY(add_edges(group, ends));
        if (prefix.empty()) {
            graph_.inputs = std::move(inputs), graph_.outputs = std::move(outputs);
            return Ends{};
        }
        const auto name = prefix.substr(0, prefix.size() - 1);
        const auto in = TRY(only_port(inputs, "Input", name)), out = TRY(only_port(outputs, "Output", name));
        return Ends{in, out};
    }

public:
    GraphReader(std::span<const Hdf5Array> arrays, const std::string& path) : path_(path) {
        for (const auto& array : arrays) arrays_.emplace(array.path, &array);
    }

    Result<Graph> read() {
        if (text("/node/type") != "NIRGraph")
            return bad("this HDF5 file is not a NIR graph: it has no dataset /node/type with the text NIRGraph");
        graph_.version = text("/version");
        TRY(add_graph("/node", "", 0));
        TRY(check_graph(graph_, path_));
        return std::move(graph_);
    }
};

}  // namespace

Result<Graph> graph_of(std::span<const Hdf5Array> arrays, const std::string& path) { return GraphReader(arrays, path).read(); }

Result<Graph> read_graph(const std::string& path) { return graph_of(TRY(read_hdf5_tree(path, "metadata")), path); }

}  // namespace corpuscle::nir
