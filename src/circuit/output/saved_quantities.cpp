#include "circuit/output/saved_quantities.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <unordered_set>

#include "circuit/devices.hpp"

namespace corpuscle::circuit {
namespace {

bool is_save_directive(const Directive& c) { return c.name == "save" || c.name == "probe"; }

/// True if the word selects all quantities: "all", and in .probe also "alli" and "allv".
bool means_all(const Directive& c, const std::string& word) {
    return word == "all" || (c.name == "probe" && (word == "alli" || word == "allv"));
}

/// The index of the element in "i(x1.m1)"; -1 if the word is not the current of a device.
int device_of_current(const UnknownNames& names, const Circuit& circuit, std::string_view word) {
    if (!word.starts_with("i(") || !word.ends_with(')') || names.index_of(word) >= 0) return -1;
    const int k = circuit.find_element(word.substr(2, word.size() - 3));
    return k >= 0 && has_device_current(circuit.elements[static_cast<std::size_t>(k)]) ? k : -1;
}

}  // namespace

bool is_unsupported_probe(const Circuit& circuit, const Directive& c, std::string_view word) {
    if (c.name != "probe" || means_all(c, std::string(word))) return false;
    const auto open = word.find('(');
    if (open != std::string_view::npos && open != 1) return true;  // vd(r2), p(x1)
    if (!word.starts_with("i(") || !word.ends_with(')')) return false;
    const int k = circuit.find_element(word.substr(2, word.size() - 3));
    return k >= 0 && !has_branch_current(circuit.elements[static_cast<std::size_t>(k)]) &&
           !has_device_current(circuit.elements[static_cast<std::size_t>(k)]);
}

double SavedQuantity::current_into(const Device& d, std::span<const double> v) {
    const auto n = v.size();
    std::vector<double> stamp(2 * n + 2 * n * n);
    const auto all = std::span(stamp);
    EvalContext context;
    context.with_charges = false;
    d.eval(v, context, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
    return stamp[0];  // the current f of the first terminal; see Stamp
}

Result<std::vector<SavedQuantity>> resolve_saved_quantities(const System& system) {
    std::vector<SavedQuantity> out;
    const auto& commands = system.circuit().directives;
    if (std::none_of(commands.begin(), commands.end(), is_save_directive)) return out;
    const UnknownNames names(system);
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
            const auto name = word.find('(') == std::string::npos ? fmt::format("v({})", word) : word;
            if (!seen.insert(name).second) continue;
            if (const int device = device_of_current(names, system.circuit(), name); device >= 0) {
                out.push_back({name, {}, device});
                continue;
            }
            Directive single_word{c.name, {name}, {}, c.location};  // the parser takes a directive
            if (k < c.columns.size()) single_word.columns = {c.columns[k]};
            const auto unknowns = TRY(read_output_variable(names, single_word, 0));
            out.push_back({name, unknowns});
        }
    }
    return all ? std::vector<SavedQuantity>{} : out;
}

}  // namespace corpuscle::circuit
