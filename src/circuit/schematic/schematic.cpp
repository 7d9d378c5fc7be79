#include "circuit/schematic/schematic.hpp"

#include "circuit/error_at.hpp"
#include "circuit/schematic/draw_level.hpp"
#include "circuit/schematic/svg_text.hpp"
#include "circuit/variant/hierarchical_names.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// A block, or a subcircuit that no X line uses.
struct BlockChoice {
    std::string path;        // of the instance; "" for the top level
    std::string definition;  // the name of the subcircuit; "" for an instance
};

using Names = std::vector<std::string_view>;

Error several_blocks(std::string_view block, const Names& paths) {
    return bad_input(fmt::format("'{}' is one of several blocks: {}; name one of them", block, abbreviated_list(paths)));
}

Error no_block(std::string_view block, const Names& paths, const std::vector<Netlist::Subcircuit>& definitions) {
    std::vector<std::string> known;
    for (const auto path : paths) known.push_back(short_name(path, piece_count(path), LastPiece::element));
    for (const auto& definition : definitions) known.push_back(definition.name);
    if (const auto suggestion = did_you_mean(block, known); !suggestion.empty())
        return bad_input(fmt::format("there is no block '{}'{}", block, suggestion));
    if (!paths.empty()) return bad_input(fmt::format("there is no block '{}'; blocks are {}", block, abbreviated_list(paths)));
    if (definitions.empty()) return bad_input(fmt::format("there is no block '{}': the netlist has no subcircuits", block));
    const Names names(known.begin(), known.end());
    return bad_input(fmt::format("there is no block '{}'; subcircuits are {}", block, abbreviated_list(names)));
}

/// Finds a block by its name, else by that of its subcircuit if only one block has it, else a subcircuit without blocks.
Result<BlockChoice> find_block(const Netlist& netlist, const HierarchicalCircuit& circuit, std::string_view block) {
    if (block.empty()) return BlockChoice();
    Names paths, matching;
    for (const auto& instance : circuit.instances) paths.push_back(instance.path);
    for (const auto k : find_matching_names(paths, block, LastPiece::element)) matching.push_back(paths[k]);
    const auto subcircuit = lower(block);
    if (matching.empty())
        for (const auto& instance : circuit.instances)
            if (instance.subcircuit == subcircuit) matching.push_back(instance.path);
    if (matching.size() > 1) return several_blocks(block, matching);
    if (!matching.empty()) return BlockChoice{std::string(matching.front()), ""};
    const auto definitions = netlist.subcircuits();
    for (const auto& definition : definitions)
        if (definition.name == subcircuit) return BlockChoice{definition.name, definition.name};
    return no_block(block, paths, definitions);
}

/// An empty top level has no picture; its error names the subcircuits that could be meant.
Result<void> check_not_empty(const Netlist& netlist, const HierarchicalCircuit& circuit) {
    if (!circuit.circuit.elements.empty() || !circuit.instances.empty()) return {};
    const auto definitions = netlist.subcircuits();
    if (definitions.empty()) return error_at({circuit.circuit.file}, "the circuit has no elements");
    Names names;
    for (const auto& definition : definitions) names.push_back(definition.name);
    const auto& first = definitions.front();
    return error_at({circuit.circuit.file}, "{} {} defined, but no X line uses {}; add one, such as 'x1 {} {}', or draw {} with --block {}",
                    abbreviated_list(names), names.size() == 1 ? "is" : "are", names.size() == 1 ? "it" : "them",
                    fmt::join(first.ports, " "), first.name, names.size() == 1 ? "it" : "one of them", first.name);
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
    auto circuit = TRY(netlist.elaborate_hierarchy());
    const auto choice = TRY(find_block(netlist, circuit, block));
    if (block.empty()) TRY(check_not_empty(netlist, circuit));
    if (!choice.definition.empty()) circuit = TRY(netlist.elaborate_definition(choice.definition));
    schematic::LevelReader levels(circuit);
    TRY(check_size(levels, choice.path));
    return draw_block(levels, choice.path);
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
