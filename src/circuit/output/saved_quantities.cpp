#include "circuit/output/saved_quantities.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <unordered_set>

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

}  // namespace corpuscle::circuit
