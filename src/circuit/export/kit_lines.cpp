#include "circuit/export/kit_arrays.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The kit's section of the corner of the netlist; "tt" if the map has no corners and the netlist chooses none.
Result<std::string> section_of(const Kit& kit) {
    const auto& corners = kit.map.corners;
    const auto at = corners.find(kit.corner.empty() ? "tt" : kit.corner);
    if (at != corners.end()) return at->second;
    if (kit.corner.empty()) return std::string("tt");
    std::vector<std::string> names;
    for (const auto& [name, section] : corners) names.push_back(name);
    return bad_input(fmt::format("corner={}: the map '{}' has {}; leave the corner out, or name it in [corners] of a map", kit.corner,
                                 kit.map.name, names.empty() ? "no corners" : "only " + joined(names)));
}

/// The line with the kit's paths and section.
Result<std::string> filled(const std::string& line, const KitPlaceholders& values) {
    const bool has_space = line.starts_with(".lib") && (values.card + values.folder).find_first_of(" \t") != std::string::npos;
    if (!has_space) return TRY(fill_kit_line(line, values)) + '\n';
    return bad_input(fmt::format("--card '{}': ngspice reads no .lib whose path has a space; name a link to it without one", values.card));
}

/// ngspice takes a seed from 1 to 2^31 - 1.
std::uint64_t ngspice_seed(std::uint64_t seed, std::uint64_t chip) { return 1 + (seed * 65537 + chip) % 2147483646; }

}  // namespace

Result<KitLines> kit_lines(const Circuit& circuit, const Kit& kit) {
    const auto& map = kit.map;
    const bool has_mismatch = circuit.mismatch_seed.has_value();
    if (has_mismatch && map.mismatch_lines.empty())
        return bad_input(
            fmt::format("mismatch: the map '{}' has no mismatch_lines, which switch the kit's mismatch on; leave mismatch out, or "
                        "write them in a map",
                        map.name));
    const KitPlaceholders values{kit.card, kit.folder, TRY(section_of(kit))};
    KitLines out;
    if (has_mismatch) out.before = fmt::format(".options seed={}\n", ngspice_seed(*circuit.mismatch_seed, circuit.chip));
    for (const auto& line : has_mismatch ? map.mismatch_lines : map.lines) out.before += TRY(filled(line, values));
    for (const auto& line : map.last_lines) out.after += TRY(filled(line, values));
    return out;
}

}  // namespace corpuscle::circuit
