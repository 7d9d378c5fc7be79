#include "reproduction/claims/study_netlist.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

#include "circuit/analyses.hpp"
#include "circuit/output/curve_view.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "core/text/embedded_files.hpp"
#include "run/netlist/netlist_directives.hpp"

namespace corpuscle {
namespace {

using circuit::AnalysisContext;
using circuit::apply_overrides;
using circuit::Circuit;
using circuit::find_analysis;
using circuit::find_curve_values;
using circuit::Netlist;
using circuit::NetlistVariants;
using circuit::parse_embedded;
using circuit::parse_netlist_override;
using circuit::RunOptions;
using circuit::Values;

/// Parses the netlist, with its directives replaced, and applies the settings.
Result<Netlist> netlist_of(const StudyNetlist& deck) {
    const bool is_text = deck.circuit.find('\n') != std::string::npos;
    const auto file = is_text ? std::string("circuits/study.cir") : fmt::format("circuits/{}.cir", deck.circuit);
    std::string text = deck.circuit;
    if (!is_text) text = TRY(embedded_text(file));
    if (!deck.directives.empty()) text = with_directives(text, deck.directives);
    std::vector<ParameterOverride> overrides;
    for (const auto& setting : deck.settings) overrides.push_back(TRY(parse_netlist_override(file, setting)));
    auto applied = apply_overrides([&](const std::string& corner) { return parse_embedded(text, file, corner); }, file, overrides);
    if (!applied) return applied.error();
    return std::move(applied->result);
}

/// A copy of the circuit with these parameters set in the card of every model.
std::shared_ptr<const Circuit> with_model_parameters(const Circuit& circuit, const Values& numbers) {
    auto out = std::make_shared<Circuit>(circuit);
    for (auto& model : out->models)
        for (const auto& [name, value] : numbers) model.values[name] = value;
    return out;
}

}  // namespace

StudyCurve NetlistResult::curve(std::string_view analysis, const std::string& y) const { return curve(analysis, y, ""); }

StudyCurve NetlistResult::curve(std::string_view analysis, const std::string& y, const std::string& over) const {
    for (const auto& a : outcome.analyses) {
        if (a.directive->name != analysis || a.result.plots.empty()) continue;
        const auto& plot = a.result.plots[0];
        const auto values = find_curve_values(plot, y);
        // The first curve of a plot is the swept quantity.
        const auto along = over.empty() ? std::optional(plot.curves[0].values) : find_curve_values(plot, over);
        if (!values || !along) return {};
        StudyCurve out;
        for (const auto& x : *along) out.x.push_back(x.real());
        for (const auto& v : *values) out.y.push_back(v.real());
        return out;
    }
    return {};
}

double NetlistResult::number(std::string_view name) const {
    for (const auto& [known, value] : outcome.numbers)
        if (known == name) return value;
    for (const auto& a : outcome.analyses)
        for (const auto& [known, value] : a.result.numbers)
            if (known == name) return value;
    return std::numeric_limits<double>::quiet_NaN();
}

double NetlistResult::operating_point(const std::string& name) const {
    for (const auto& a : outcome.analyses)
        if (a.directive->name == "op" && !a.result.plots.empty())
            if (const auto values = find_curve_values(a.result.plots[0], name); values && !values->empty()) return (*values)[0].real();
    return std::numeric_limits<double>::quiet_NaN();
}

double NetlistResult::derivative(std::string_view output, std::string_view source) const {
    for (const auto& a : outcome.analyses)
        if (const auto& words = a.directive->words;
            a.directive->name == "tf" && words.size() == 2 && words[0] == output && words[1] == source)
            return a.result.numbers.front().second;
    return std::numeric_limits<double>::quiet_NaN();
}

double NetlistResult::operating_info(std::string_view device, std::string_view name) const {
    constexpr double absent = std::numeric_limits<double>::quiet_NaN();
    const auto context = AnalysisContext::make(circuit);
    const auto* found = context ? (*context)->system.device(device) : nullptr;
    if (found == nullptr) return absent;
    std::vector<double> x;
    for (const auto& unknown : (*context)->system.names()) x.push_back(operating_point(unknown));
    for (const auto& r : found->operating_info((*context)->system.terminal_values(*found, x)))
        if (r.name == name) return r.value;
    return absent;
}

Result<std::vector<NetlistResult>> run_study_variants(const StudyNetlist& deck) {
    const auto netlist = TRY(netlist_of(deck));
    auto variants = TRY(NetlistVariants::create(netlist));
    std::vector<NetlistResult> out;
    std::unique_ptr<AnalysisContext> context;
    RunOptions run_options;
    run_options.print_tables = false;
    for (std::size_t k = 0; k < variants.count(); ++k) {
        auto variant = TRY(variants.at(k));
        if (!deck.model_parameters.empty()) variant.circuit = with_model_parameters(*variant.circuit, deck.model_parameters);
        // The chips of .mc share one circuit, and therefore one context.
        if (!context || context->circuit != variant.circuit) context = TRY(AnalysisContext::make(variant.circuit));
        context->is_brief = true;  // no tables and no warnings
        if (variant.sample) context->apply_variation(*variant.sample);
        auto outcome = circuit::run_directives(*context, run_options);
        if (!outcome) {
            auto error = outcome.error();
            if (!variant.label.empty()) error.message = fmt::format("{}: {}", variant.label, error.message);
            return error;
        }
        out.push_back({variant.label, variant.circuit, std::move(*outcome)});
    }
    return out;
}

Result<NetlistResult> run_study_netlist(const StudyNetlist& deck) {
    auto all = TRY(run_study_variants(deck));
    return std::move(all.front());
}

Result<std::string> substitute_in_embedded_text(const std::string& file, const std::vector<std::pair<std::string, std::string>>& changes) {
    auto text = TRY(embedded_text(file));
    for (const auto& [from, to] : changes) {
        auto at = text.find(from);
        if (at == std::string::npos) return bad_input(fmt::format("{}: does not contain '{}'", file, from));
        for (; at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
    }
    return text;
}

Result<std::shared_ptr<const Circuit>> elaborate_study_netlist(const StudyNetlist& deck) {
    const auto netlist = TRY(netlist_of(deck));
    auto circuit = TRY(netlist.elaborate());
    return std::make_shared<const Circuit>(std::move(circuit));
}

}  // namespace corpuscle
