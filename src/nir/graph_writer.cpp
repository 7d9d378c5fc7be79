#include <fmt/format.h>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "io/hdf5/hdf5_writer.hpp"
#include "nir/graph_file.hpp"

namespace corpuscle::nir {
namespace {

constexpr const char* written_version = "1.0";  // of NIR

Shape shape_of(const Node& node, std::string_view parameter) {
    if (parameter == "weight") return {node.output_shape[0], node.input_shape[0]};
    if (parameter == "shape") return {node.input_shape.size()};
    return node.output_shape;
}

void add_node(Hdf5Writer& file, const Node& node) {
    const auto group = "/node/nodes/" + node.name;
    file.add_group(group);
    file.add_texts(group + "/type", {std::string(node.kind->type)}, true);
    for (const auto& p : node.kind->parameters) {
        const auto path = group + "/" + std::string(p.name);
        if (p.name == "shape") {
            const std::vector<std::int64_t> lengths(node.input_shape.begin(), node.input_shape.end());
            file.add_numbers<std::int64_t>(path, Hdf5Type::int64, lengths, shape_of(node, p.name));
        } else {
            file.add_numbers<double>(path, Hdf5Type::real, node.value(p.name), shape_of(node, p.name));
        }
    }
}

}  // namespace

Result<std::string> graph_bytes(const Graph& graph, const std::vector<Metadata>& metadata) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> temporary(std::tmpfile(), std::fclose);
    if (!temporary) return bad_input(fmt::format("cannot create a temporary file: {}", std::strerror(errno)));
    auto file = TRY(Hdf5Writer::start(::fileno(temporary.get()), "temporary file"));
    file.add_texts("/version", {written_version}, true);
    file.add_group("/node");
    if (!metadata.empty()) file.add_group("/node/metadata");  // first, so that the texts are near the beginning of the file
    for (const auto& m : metadata) file.add_texts("/node/metadata/" + m.name, {m.text}, true);
    file.add_texts("/node/type", {"NIRGraph"}, true);
    std::vector<std::string> ends;
    for (const auto& e : graph.edges) ends.push_back(graph.nodes[e.from].name), ends.push_back(graph.nodes[e.to].name);
    file.add_texts("/node/edges", ends, {graph.edges.size(), 2});
    file.add_group("/node/nodes");
    for (const auto& node : graph.nodes) add_node(file, node);
    TRY(file.finish());
    std::string bytes;
    std::array<char, 65536> block{};
    for (std::size_t count = 1; count > 0; bytes.append(block.data(), count))
        count = std::fread(block.data(), 1, block.size(), temporary.get());
    if (std::ferror(temporary.get())) return bad_input("cannot read a temporary file");
    return bytes;
}

}  // namespace corpuscle::nir
