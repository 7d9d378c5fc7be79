#include "circuit/cost/cost.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "circuit/device/named_values.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_reported_leak = 0.1;  // smallest leakage current in Cost::leaks, as a fraction of the smallest bias current

bool is_afferent(const Circuit& circuit) {
    const auto& elements = circuit.elements;
    return std::any_of(elements.begin(), elements.end(), [](const auto& e) { return e.waveform.shape == Waveform::Shape::force; }) &&
           std::any_of(circuit.directives.begin(), circuit.directives.end(), [](const auto& c) { return c.name == "spike"; });
}

bool has_unknown_area(const Element& e) {
    return e.letter == 'r' || e.letter == 'l' || e.letter == 'd' || (e.letter == 'c' && e.expression);
}

void add_areas(const Circuit& circuit, const Blocks& blocks, Cost& out) {
    for (const auto& name : blocks.names) out.blocks.emplace_back().name = name;
    for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
        const auto& e = circuit.elements[k];
        auto& block = out.blocks[blocks.block_of_element[k]];
        block.area += area_of(e);
        out.unknown_areas += has_unknown_area(e);
        if (e.letter != 'm') continue;
        ++block.transistors;
        block.unit_transistors += static_cast<std::size_t>(std::ceil(value_or(e.values, "m", 1) * value_or(e.values, "stack", 1)));
    }
}

void add_leakage(const AnalysisContext& context, std::span<const double> x, const Blocks& blocks, Cost& out) {
    const auto& circuit = *context.circuit;
    out.smallest_bias = smallest_bias(circuit);
    for (auto& leak : leakage_of(context.system, x, out.supply)) {
        auto& block = out.blocks[blocks.block_of_element[leak.element]];
        if (block.worst_name.empty() || leak.current > block.worst_leak.current)
            block.worst_leak = leak, block.worst_name = circuit.elements[leak.element].name;
        if (leak.is_off && out.smallest_bias > 0 && leak.current > min_reported_leak * out.smallest_bias)
            out.leaks.push_back(std::move(leak));
    }
    std::sort(out.leaks.begin(), out.leaks.end(), [](const Leakage& a, const Leakage& b) {
        return std::tuple(a.capacitor_node.empty(), -a.current, a.element) < std::tuple(b.capacitor_node.empty(), -b.current, b.element);
    });
    for (const auto& leak : out.leaks) out.leaking_names.push_back(circuit.elements[leak.element].name);
}

}  // namespace

Area Cost::area() const {
    Area all;
    for (const auto& b : blocks) all += b.area;
    return all;
}

const PowerBreakdown* Cost::powers(std::string_view key) const {
    for (const auto& [name, powers] : power)
        if (name == key) return &powers;
    return nullptr;
}

Result<Cost> cost_of(AnalysisContext& context, const PowerOverTime* over) {
    const auto operating_point = TRY(context.operating_point());
    const PowerMeter meter(context.system, operating_point.x, context.tolerances.gmin);
    Cost out;
    out.supply = meter.supply(), out.sources = meter.sources(), out.has_sensor = meter.has_sensor();
    out.is_afferent = is_afferent(*context.circuit);
    add_areas(*context.circuit, meter.blocks(), out);
    add_leakage(context, operating_point.x, meter.blocks(), out);
    out.power.emplace_back("op", meter.power_at(operating_point.x));
    if (over)
        for (auto& named_power : over->averages()) out.power.push_back(std::move(named_power));
    return out;
}

}  // namespace corpuscle::circuit
