#include "circuit/output/saved_quantities.hpp"

#include <algorithm>
#include <unordered_set>

#include "circuit/analyses.hpp"
#include "circuit/variant/hierarchical_names.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

bool is_save_directive(const Directive& c) { return c.name == "save" || c.name == "probe"; }

/// True if the word selects all quantities: "all", and in .probe also "alli" and "allv".
bool means_all(const Directive& c, const std::string& word) {
    return word == "all" || (c.name == "probe" && (word == "alli" || word == "allv"));
}

/// The index of the element in "i(x1.m1)"; -1 if the word is not the current of an element.
int element_of_current(const Circuit& circuit, std::string_view word) {
    return word.starts_with("i(") && word.ends_with(')') ? circuit.find_element(word.substr(2, word.size() - 3)) : -1;
}

/// The same for an element whose current is not an unknown but follows from its terminal voltages.
int device_of_current(const System& system, std::string_view word) {
    const int k = system.unknown(word) >= 0 ? -1 : element_of_current(system.circuit(), word);
    return k >= 0 && has_device_current(system.circuit().elements[static_cast<std::size_t>(k)]) ? k : -1;
}

/// The currents in some words: "i(r1)" in "i(r1)=1m" and in "par('v(a)*i(r1)')".
std::vector<std::string> currents_in(std::span<const std::string> words) {
    std::vector<std::string> out;
    for (const auto& word : words)
        for (auto at = word.find("i("); at != std::string::npos; at = word.find("i(", at + 1)) {
            const bool is_part_of_name = at > 0 && ((word[at - 1] >= 'a' && word[at - 1] <= 'z') || word[at - 1] == '_');
            const auto close = word.find(')', at);
            if (is_part_of_name || close == std::string::npos) continue;
            out.push_back(word.substr(at, close + 1 - at));
            std::ranges::replace(out.back(), ':', '.');
        }
    return out;
}

struct ProbeText {
    bool is_current = false;
    std::string_view first, second;  // a and b of v(a,b); `second` is "" if there is only one name
};

Result<ProbeText> parse_probe(std::string_view probe_text) {
    const auto text = trimmed(probe_text);
    const auto open = text.find('(');
    if (open == std::string_view::npos && !text.empty() && text.find_first_of(") \t") == std::string_view::npos)
        return ProbeText{false, text, ""};
    const bool is_call = open == 1 && text.ends_with(')') && (lower(text[0]) == 'v' || lower(text[0]) == 'i');
    ProbeText out;
    if (is_call) {
        const auto inside = text.substr(2, text.size() - 3);
        const auto comma = inside.find(',');
        out = {lower(text[0]) == 'i', trimmed(inside.substr(0, comma)), comma == inside.npos ? "" : trimmed(inside.substr(comma + 1))};
    }
    if (out.first.empty() || (out.is_current && !out.second.empty()) || out.first.find_first_of("() \t") != std::string_view::npos)
        return bad_usage(fmt::format("--probe '{}': write a node, v(NODE), v(NODE,NODE), i(SOURCE) or i(DEVICE)", probe_text));
    return out;
}

Error ambiguous_probe(std::string_view probe_text, const Circuit& c, std::span<const std::string_view> names,
                      const std::vector<std::size_t>& found) {
    std::vector<std::string_view> matches;
    for (const auto k : found) matches.push_back(names[k]);
    return bad_input(
        fmt::format("--probe {}: ambiguous in {} ({}); write more of its path", probe_text, c.file, abbreviated_list(matches)));
}

/// The names of all nodes but ground.
std::vector<std::string_view> nodes_of(const Circuit& c) { return {c.nodes.begin() + 1, c.nodes.end()}; }
std::vector<std::string_view> elements_of(const Circuit& c) {
    std::vector<std::string_view> names;
    for (const auto& e : c.elements) names.push_back(e.name);
    return names;
}

Result<std::optional<std::string>> resolve_node(const Circuit& c, std::string_view probe_text, std::string_view name) {
    if (is_ground(lower(name))) return std::optional<std::string>("0");
    const auto names = nodes_of(c);
    const auto found = find_matching_names(names, name, LastPiece::node);
    if (found.size() > 1) return ambiguous_probe(probe_text, c, names, found);
    return found.empty() ? std::optional<std::string>() : std::string(names[found[0]]);
}

/// "M, D, R ": the devices whose current follows from their voltages.
std::string recordable_letters() {
    std::string out;
    for (const auto* kind : device_kinds)
        if (kind->saves_terminal_current && find_device_kind(kind->letter) == kind)
            out = fmt::format("{}{}{}", static_cast<char>(kind->letter - 'a' + 'A'), out.empty() ? " " : ", ", out);
    return out;
}

Result<std::optional<std::string>> resolve_current(const Circuit& c, std::string_view probe_text, std::string_view name) {
    const auto names = elements_of(c);
    const auto found = find_matching_names(names, name, LastPiece::element);
    if (found.size() > 1) return ambiguous_probe(probe_text, c, names, found);
    if (found.empty()) return std::optional<std::string>();
    const auto& e = c.elements[found[0]];
    if (!has_branch_current(e) && !has_device_current(e))
        return bad_input(fmt::format("--probe {}: the current of {} cannot be recorded; record that of an {}or voltage source", probe_text,
                                     e.name, recordable_letters()));
    return std::optional(fmt::format("i({})", e.name));
}

}  // namespace

bool is_unsupported_probe(const Circuit& circuit, const Directive& c, std::string_view word) {
    if (c.name != "probe" || means_all(c, std::string(word))) return false;
    const auto open = word.find('(');
    if (open != std::string_view::npos && open != 1) return true;  // vd(r2), p(x1)
    const int k = element_of_current(circuit, word);
    return k >= 0 && !has_branch_current(circuit.elements[static_cast<std::size_t>(k)]) &&
           !has_device_current(circuit.elements[static_cast<std::size_t>(k)]);
}

double SavedQuantity::current_into(const Device& d, std::span<const double> v) {
    EvalContext context;
    context.with_charges = false;
    return StampBuffer().eval(d, v, context).f[0];
}

Result<std::vector<SavedQuantity>> resolve_saved_quantities(const System& system) {
    std::vector<SavedQuantity> out;
    const auto& commands = system.circuit().directives;
    if (std::none_of(commands.begin(), commands.end(), is_save_directive)) return out;
    std::unordered_set<std::string> seen;
    bool all = false;
    for (const auto& c : commands) {
        if (!is_save_directive(c)) continue;
        all = all || c.words.empty();
        for (std::size_t k = 0; k < c.words.size(); ++k) {
            const auto& word = c.words[k];
            if (means_all(c, word)) {
                all = true;
                continue;
            }
            if (is_unsupported_probe(system.circuit(), c, word)) continue;
            if (k == 0 && c.words.size() > 1 && c.name == "probe" && find_analysis(word) != nullptr) continue;  // gnucap: .probe op v(a)
            const auto name = word.find('(') == std::string::npos ? fmt::format("v({})", word) : word;
            if (!seen.insert(name).second) continue;
            if (const int device = device_of_current(system, name); device >= 0) {
                out.push_back({name, {}, device});
                continue;
            }
            Directive single_word{c.name, {name}, {}, c.location};  // the parser takes a directive
            if (k < c.columns.size()) single_word.columns = {c.columns[k]};
            const auto unknowns = TRY(read_output_variable(system, single_word, 0));
            out.push_back({name, unknowns});
        }
    }
    return all ? std::vector<SavedQuantity>{} : out;
}

std::vector<SavedQuantity> mentioned_device_currents(const System& system, std::span<const SavedQuantity> saved) {
    constexpr std::string_view directives[] = {"print", "plot", "meas", "measure", "four"};
    std::unordered_set<std::string> seen;
    for (const auto& quantity : saved) seen.insert(quantity.name);
    std::vector<SavedQuantity> out;
    for (const auto& c : system.circuit().directives) {
        if (std::ranges::find(directives, c.name) == std::end(directives)) continue;
        for (const auto& name : currents_in(c.words)) {
            if (const int device = device_of_current(system, name); device >= 0 && seen.insert(name).second)
                out.push_back({name, {}, device});
        }
    }
    return out;
}

DeviceCurrents::DeviceCurrents(const System& system, std::span<const SavedQuantity> all) : system_(system) {
    for (const auto& s : all)
        if (s.device_index >= 0) currents_.push_back(s);
}

void DeviceCurrents::begin(Plot& head) {
    has_sweep_ = head.has_sweep;
    const auto unknowns = std::span(head.curves).subspan(std::min<std::size_t>(has_sweep_, head.curves.size()));
    extends_ = !currents_.empty() && !head.is_complex && !(has_sweep_ && head.curves[0].name == "temp-sweep") &&
               std::equal(unknowns.begin(), unknowns.end(), system_.names().begin(), system_.names().end(),
                          [](const Curve& c, const std::string& name) { return c.name == name; });
    if (!extends_) return;
    for (const auto& s : currents_) head.curves.push_back({s.name, "current", {}});
}

PlotRow DeviceCurrents::extend(const PlotRow& row) {
    if (!extends_) return row;
    row_.assign(row.real.begin(), row.real.end());
    for (const auto& s : currents_)
        row_.push_back(s.value(system_, [&](int u) { return u < 0 ? 0 : row.real[static_cast<std::size_t>(u) + has_sweep_]; }));
    return PlotRow(row_);
}

std::vector<std::string> split_probes(std::string_view text) {
    std::vector<std::string> out(1);
    int depth = 0;
    for (const char letter : text) {
        depth += letter == '(' ? 1 : letter == ')' ? -1 : 0;
        if (letter == ',' && depth == 0)
            out.emplace_back();
        else
            out.back() += letter;
    }
    return out;
}

Result<std::optional<std::string>> resolve_probe(const Circuit& c, std::string_view probe_text) {
    const auto probe = TRY(parse_probe(probe_text));
    if (probe.is_current) return resolve_current(c, probe_text, probe.first);
    const auto first = resolve_node(c, probe_text, probe.first);
    if (!first || !*first || probe.second.empty())
        return !first || !*first ? first : Result<std::optional<std::string>>(fmt::format("v({})", **first));
    const auto second = resolve_node(c, probe_text, probe.second);
    if (!second || !*second) return second;
    return std::optional(fmt::format("v({},{})", **first, **second));
}

std::string suggest_probe(const Circuit& c, std::string_view probe_text) {
    const auto probe = parse_probe(probe_text);
    if (!probe) return "";
    const auto kind = probe->is_current ? LastPiece::element : LastPiece::node;
    if (!probe->is_current && find_matching_names(elements_of(c), probe->first, LastPiece::element).size() == 1)
        return fmt::format("; a device's current is i({})", probe->first);
    const auto names = probe->is_current ? elements_of(c) : nodes_of(c);
    std::vector<std::string> known;
    for (const auto name : names) known.push_back(short_name(name, piece_count(probe->first), kind));
    const auto similar = did_you_mean(lower(probe->first), known);
    return !similar.empty() || names.empty()
               ? similar
               : fmt::format("; there are the {} {}", probe->is_current ? "devices" : "nodes", abbreviated_list(names));
}

}  // namespace corpuscle::circuit
