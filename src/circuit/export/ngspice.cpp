#include "circuit/export/ngspice.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/analysis/bench.hpp"
#include "circuit/export/elements.hpp"
#include "circuit/export/orders.hpp"
#include "circuit/export/transistor_text.hpp"

namespace corpuscle::circuit {
namespace {

std::string one_line(std::string text) {
    std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

/// Transistors of one polarity, if there are any.
bool has_transistors(const Circuit& c, std::string_view type) {
    return std::any_of(c.elements.begin(), c.elements.end(), [&](const Element& e) {
        return e.letter == 'm' && e.model >= 0 && c.models[static_cast<std::size_t>(e.model)].type == type;
    });
}

std::string header(const Circuit& c, bool transistors) {
    std::string out = c.title.empty() ? "exported by corpuscle\n" : one_line(c.title) + '\n';
    out += fmt::format("* Written by 'corpuscle export {} --for ngspice' for ngspice 39: flat, every parameter worked out.\n",
                       one_line(c.file));
    out += "* Run it with: ngspice -b DECK -r DECK.raw (without -r it prints, and measures)\n";
    out += "* Inside subcircuits x1.m3 is called xm_x1_m3, x1.r1 r_x1_r1; nodes are called as before.\n";
    if (transistors)
        out +=
            "* Transistors are formulas: their noise is missing, and so is the table of an operating point. Nodes such as xm1.zs are "
            "theirs\n"
            "* (ln q at an end, or near it); a transistor's numbers hold at one temperature alone.\n";
    return out;
}

/// Tighter than ours, for ngspice stops a step sooner; what it starts from is far too loose for picoamperes. itl2: steps to a sweep's
/// next point. In time its trapezoidal rule stops at picoamperes ("timestep too small"); Gear's does not.
std::string options(const Tolerances& t, const Circuit& c) {
    std::string out = fmt::format(".options reltol={} abstol={} vntol={} gmin={} itl1={} itl2={}", std::min(t.reltol, 1e-7), t.abstol,
                                  std::min(t.vntol, 1e-10), t.gmin, std::max(t.itl1, 500), std::max(t.itl1, 500));
    for (const std::string_view name : {"chgtol", "trtol", "itl4", "maxord", "tnom"})
        if (const auto said = c.options.find(name); said != c.options.end()) out += fmt::format(" {}={}", name, said->second);
    if (const auto method = c.option_words.find("method"); method != c.option_words.end())
        out += " method=" + method->second;
    else if (std::any_of(c.commands.begin(), c.commands.end(), [](const Command& order) { return order.name == "tran"; }))
        out += " method=gear";
    return fmt::format("{}\n.temp {}\n", out, c.temperature);
}

std::string starts(std::string_view word, const std::vector<std::pair<int, double>>& at, const ExportNames& names) {
    std::string out;
    for (const auto& [node, volts] : at) out += fmt::format("{} v({})={}\n", word, names.node(node), volts);
    return out;
}

}  // namespace

Result<NgspiceDeck> ngspice_deck(std::shared_ptr<const Circuit> circuit) {
    const auto bench = TestBench::make(circuit);
    if (!bench) return bench.error();
    const Circuit& c = *circuit;
    const ExportNames names(c);
    const bool n = has_transistors(c, "nmos"), p = has_transistors(c, "pmos");
    NgspiceDeck deck{header(c, n || p) + options((*bench)->tolerances, c), {}};
    for (std::size_t k = 0; k < c.elements.size(); ++k) {
        auto text = element_text(c, k, names);
        if (!text) return text.error();
        deck.text += *text;
    }
    for (std::size_t k = 0; k < c.models.size(); ++k) deck.text += model_text(c, k, names);
    if (n || p) deck.text += uicm_functions();
    if (n) deck.text += uicm_subcircuit(false);
    if (p) deck.text += uicm_subcircuit(true);
    deck.text += starts(".nodeset", c.nodesets, names) + starts(".ic", c.ic, names);
    deck.text += orders_text(c, names, deck.left_out) + ".end\n";
    return deck;
}

}  // namespace corpuscle::circuit
