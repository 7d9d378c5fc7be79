#include "circuit/export/ngspice_deck.hpp"

#include <algorithm>

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/devices.hpp"
#include "circuit/export/element_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The text with spaces instead of newlines.
std::string one_line(std::string text) {
    std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

/// True if the circuit has transistors of this polarity.
bool has_transistors(const Circuit& c, std::string_view type) {
    return std::any_of(c.elements.begin(), c.elements.end(),
                       [&](const Element& e) { return has_role(e, Role::transistor) && c.model_of(e) && c.model_of(e)->type == type; });
}

std::string header(const Circuit& c, bool transistors) {
    std::string out = c.title.empty() ? "exported by corpuscle\n" : one_line(c.title) + '\n';
    out +=
        fmt::format("* Written by 'corpuscle export {} --for ngspice' for ngspice 39: flat, all parameters evaluated.\n", one_line(c.file));
    out += "* Run it with: ngspice -b DECK -r DECK.raw (without -r it prints and measures)\n";
    out += "* Inside subcircuits x1.m3 is renamed xm_x1_m3, and x1.r1 r_x1_r1; nodes keep their names.\n";
    if (transistors)
        out +=
            "* Transistors are expressions, so their noise and the table of the operating point are missing. Nodes such as xm1.zs\n"
            "* belong to the transistors; they solve their equations. The parameters of a transistor are valid at one temperature only.\n";
    return out;
}

/// .options and .temp. Tolerances are tighter than in Corpuscle, because ngspice stops iterating one step earlier and its defaults are far
/// too loose for picoamperes. itl2 limits the iterations for each point of a sweep after the first. In transients, ngspice's trapezoidal
/// rule fails at picoamperes ("timestep too small"); Gear's method does not.
std::string options_text(const Tolerances& t, const Circuit& c) {
    std::string out = fmt::format(".options reltol={} abstol={} vntol={} gmin={} itl1={} itl2={}", std::min(t.reltol, 1e-7), t.abstol,
                                  std::min(t.vntol, 1e-10), t.gmin, std::max(t.itl1, 500), std::max(t.itl1, 500));
    for (const std::string_view name : {"chgtol", "trtol", "itl4", "maxord", "tnom"})
        if (const auto option = c.options.find(name); option != c.options.end()) out += fmt::format(" {}={}", name, option->second);
    if (const auto method = c.option_words.find("method"); method != c.option_words.end())
        out += " method=" + method->second;
    else if (c.has_directive("tran"))
        out += " method=gear";
    return fmt::format("{}\n.temp {}\n", out, c.temperature);
}

/// Lines of .ic or .nodeset, one for each node.
std::string node_voltages(std::string_view directive, const std::vector<std::pair<int, double>>& voltages, const ExportNames& names) {
    std::string out;
    for (const auto& [node, volts] : voltages) out += fmt::format("{} v({})={}\n", directive, names.node(node), volts);
    return out;
}

}  // namespace

Result<NgspiceDeck> ngspice_deck(std::shared_ptr<const Circuit> circuit) {
    const auto context = TRY(AnalysisContext::make(circuit));
    const Circuit& c = *circuit;
    const ExportNames names(c);
    const bool n = has_transistors(c, "nmos"), p = has_transistors(c, "pmos");
    NgspiceDeck deck{header(c, n || p) + options_text(context->tolerances, c), {}};
    for (std::size_t k = 0; k < c.elements.size(); ++k) deck.text += TRY(element_text(c, k, names));
    for (std::size_t k = 0; k < c.models.size(); ++k) deck.text += model_text(c, k, names);
    if (n || p) deck.text += uicm_functions();
    if (n) deck.text += uicm_subcircuit(false);
    if (p) deck.text += uicm_subcircuit(true);
    deck.text += node_voltages(".nodeset", c.nodesets, names) + node_voltages(".ic", c.ic, names);
    deck.text += directives_text(c, names, deck.warnings) + ".end\n";
    return deck;
}

}  // namespace corpuscle::circuit
