// Arbitrary bytes as a netlist and its included files (separated by lines "=== name"). Expected: a consistent circuit and its
// schematics, or an error with a message and a location.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>

#include "circuit/netlist/netlist.hpp"
#include "circuit/schematic/schematic.hpp"

using namespace corpuscle;
using namespace corpuscle::circuit;

namespace {

using Files = std::map<std::string, std::string>;

/// Returns the text before the first "=== name"; `files` receives the file after each name.
std::string split_files(std::string_view text, Files& files) {
    constexpr std::string_view mark = "\n=== ";
    const auto first = std::min(text.find(mark), text.size());
    for (std::size_t at = first; at < text.size() && files.size() < 8;) {
        const auto end = std::min(text.find('\n', at + mark.size()), text.size());
        const std::string name(text.substr(at + mark.size(), end - at - mark.size()));
        at = std::min(text.find(mark, end), text.size());
        files[name] = text.substr(end, at - end);
    }
    return std::string(text.substr(0, first));
}

void check(const Error& e) {
    if (e.message.empty() || e.location.file.empty()) std::abort();
}

void check(const Circuit& c) {
    const auto must = [](bool ok) { return ok ? void() : std::abort(); };
    for (const auto& e : c.elements) {
        must(c.find_element(e.name) >= 0 && std::isfinite(e.value) && e.location.line > 0);
        must(e.model >= -1 && e.model < static_cast<int>(c.models.size()));
        for (const int k : e.nodes) must(k >= 0 && k < static_cast<int>(c.nodes.size()));
        for (const auto& [name, value] : e.values) must(std::isfinite(value));
        for (const double x : e.waveform.numbers) must(std::isfinite(x));
        if (!e.control_source.empty()) must(c.find_element(e.control_source) >= 0);
        if (e.expression)
            for (const auto& input : e.expression->inputs()) {
                if (input.kind == ExpressionInput::Kind::voltage)
                    must(c.find_node(input.name) > 0 && (input.minus.empty() || c.find_node(input.minus) > 0));
                if (input.kind == ExpressionInput::Kind::current) must(c.find_element(input.name) >= 0);
            }
    }
    for (std::size_t k = 0; k < c.nodes.size(); ++k) must(c.find_node(c.nodes[k]) == static_cast<int>(k));
    for (const auto& command : c.directives) must(command.columns.empty() || command.words.size() == command.columns.size());
    for (const auto& warning : c.warnings) check(warning);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Files files;
    const std::string text = split_files({reinterpret_cast<const char*>(data), size}, files);
    const auto open = [&](const std::string& path) -> Result<std::string> {
        const auto at = files.find(path);
        return at == files.end() ? Result<std::string>(bad_input("no such file")) : Result<std::string>(at->second);
    };
    const auto netlist = Netlist::parse(text, "fuzz.cir", open);
    if (!netlist) return check(netlist.error()), 0;
    // Other values of the parameters select other branches of .if.
    Values zeros, ones;
    for (const auto& [name, parameter] : netlist->parameters()) zeros[name] = 0, ones[name] = 1;
    for (const auto& values : {Values{}, zeros, ones}) {
        const auto circuit = netlist->elaborate(values);
        circuit ? check(*circuit) : check(circuit.error());
    }
    // Drawings of many devices take long, and those of few find the same faults.
    if (const auto circuit = netlist->elaborate_hierarchy();
        circuit && circuit->circuit.elements.size() < 60 && circuit->instances.size() < 20) {
        const auto drawn = draw_schematics(*netlist);
        if (!drawn) return check(drawn.error()), 0;
        for (const auto& one : *drawn)
            if (one.svg.substr(0, 4) != "<svg" || one.svg.substr(one.svg.size() - 7) != "</svg>\n") std::abort();
    }
    return 0;
}
