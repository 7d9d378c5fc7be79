#include "circuit/schematic/schematic.hpp"

#include "circuit/schematic/draw_level.hpp"
#include "circuit/schematic/svg_text.hpp"
#include "circuit/variant/hierarchical_names.hpp"

namespace corpuscle::circuit {
namespace {

Result<std::string> path_of_block(const schematic::LevelReader& levels, std::string_view block) {
    if (block.empty()) return std::string();
    const auto paths = levels.block_paths();
    std::vector<std::string_view> matching;
    for (const auto k : find_matching_names(paths, block, LastPiece::element)) matching.push_back(paths[k]);
    if (matching.size() == 1) return std::string(matching.front());
    std::vector<std::string> short_names;
    for (const auto known : paths) short_names.push_back(short_name(known, piece_count(known), LastPiece::element));
    if (const auto suggestion = did_you_mean(block, short_names); matching.empty() && !suggestion.empty())
        return bad_input(fmt::format("there is no block '{}'{}", block, suggestion));
    if (matching.empty())
        return bad_input(paths.empty() ? fmt::format("there is no block '{}': the netlist has no subcircuits", block)
                                       : fmt::format("there is no block '{}'; blocks are {}", block, abbreviated_list(paths)));
    return bad_input(fmt::format("'{}' is one of several blocks: {}; name one of them", block, abbreviated_list(matching)));
}

Result<void> check_size(const schematic::LevelReader& levels, std::string_view path) {
    const auto size = levels.size_of(path);
    if (size <= max_schematic_parts) return {};
    return bad_input(fmt::format("{} has {} devices, blocks and ports; a schematic has at most {}, so divide it into subcircuits",
                                 path.empty() ? "the top level" : path, size, max_schematic_parts));
}

Schematic draw_block(schematic::LevelReader& levels, std::string_view path) {
    auto level = levels.read(path);
    Schematic out{level.path, level.subcircuit, {}};
    out.svg = schematic::svg_of(schematic::draw_level(std::move(level)));
    return out;
}

}  // namespace

Result<Schematic> draw_schematic(const Netlist& netlist, std::string_view block) {
    const auto circuit = TRY(netlist.elaborate_hierarchy());
    schematic::LevelReader levels(circuit);
    const auto path = TRY(path_of_block(levels, block));
    TRY(check_size(levels, path));
    return draw_block(levels, path);
}

Result<std::vector<Schematic>> draw_schematics(const Netlist& netlist) {
    const auto circuit = TRY(netlist.elaborate_hierarchy());
    schematic::LevelReader levels(circuit);
    TRY(check_size(levels, ""));
    std::vector<Schematic> out = {draw_block(levels, "")};
    for (const auto path : levels.block_paths())
        if (levels.size_of(path) <= max_schematic_parts) out.push_back(draw_block(levels, path));
    return out;
}

}  // namespace corpuscle::circuit
