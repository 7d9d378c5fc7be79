#include "circuit/export/start_text.hpp"

#include "circuit/afferent/force_waveform.hpp"
#include "circuit/analysis/transient_setup.hpp"

namespace corpuscle::circuit {
namespace {

/// The operating point from which the transient of a netlist starts, or that of a netlist without one.
Result<OperatingPoint> starting_point(AnalysisContext& context) {
    const auto& c = *context.circuit;
    const auto force = TRY(force_directive(c));
    for (const auto& tran : c.directives_named("tran")) {
        const auto times = TRY(read_transient_times(tran));
        context.system.start_transient(times.step, times.stop);
        if (force) context.system.set_force_input(&*force);
    }
    auto found = c.ic.empty() ? context.operating_point() : context.initial_operating_point();
    context.system.start_transient(0, 0), context.system.set_force_input(nullptr);
    return found;
}

}  // namespace

std::string node_voltages(std::string_view directive, const std::vector<std::pair<int, double>>& voltages, const ExportNames& names) {
    std::string out;
    for (const auto& [node, volts] : voltages) out += fmt::format("{} v({})={}\n", directive, names.node(node), volts);
    return out;
}

std::string start_text(AnalysisContext& context, const ExportNames& names) {
    const auto& c = *context.circuit;
    const auto found = c.has_directive("dc") ? Result<OperatingPoint>(bad_input("")) : starting_point(context);
    if (!found) return node_voltages(".nodeset", c.nodesets, names);
    std::vector<std::pair<int, double>> voltages;
    for (int node = 1; node < static_cast<int>(c.nodes.size()); ++node) {
        const bool has_ic = std::ranges::any_of(c.ic, [&](const auto& entry) { return entry.first == node; });
        const int unknown = context.system.unknown(fmt::format("v({})", c.nodes[static_cast<std::size_t>(node)]));
        if (unknown >= 0 && !has_ic) voltages.emplace_back(node, found->x[static_cast<std::size_t>(unknown)]);
    }
    return node_voltages(".nodeset", voltages, names);
}

}  // namespace corpuscle::circuit
