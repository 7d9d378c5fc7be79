#include "circuit/cost/cost.hpp"

#include <nlohmann/json.hpp>
#include <tuple>

#include "circuit/afferent/force_waveform.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/devices.hpp"
#include "circuit/netlist/node_sets.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_reported_leak = 0.1;  // smallest leakage current in Cost::leaks, as a fraction of the smallest bias current

bool is_afferent(const Circuit& circuit) {
    const auto& elements = circuit.elements;
    return circuit.has_directive("spike") &&
           std::any_of(elements.begin(), elements.end(), [](const auto& e) { return e.waveform.shape == Waveform::Shape::force; });
}

void add_areas(const Circuit& circuit, const Blocks& blocks, Cost& out) {
    for (const auto& name : blocks.names) out.blocks.emplace_back().name = name;
    for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
        const auto& e = circuit.elements[k];
        auto& block = out.blocks[blocks.block_of_element[k]];
        if (const auto area = kind_of(e).area(e))
            block.area += *area;
        else
            ++out.unknown_areas;
        if (e.letter != 'm') continue;
        ++block.transistors;
        block.unit_transistors += static_cast<std::size_t>(std::ceil(value_or(e.values, "m", 1) * value_or(e.values, "stack", 1)));
    }
}

enum Terminal { D, G, S, B };

/// True for a 0 V source, which only measures a current.
bool is_wire(const Element& e) {
    return has_role(e, Role::voltage_source) && e.waveform.dc == 0 && e.waveform.shape == Waveform::Shape::none &&
           e.waveform.ac_magnitude == 0;
}

/// Nodes whose voltage is held by a capacitor and not by a voltage source. Maps the root of the merged nodes to the node of the capacitor.
std::map<int, int> capacitor_nodes(const Circuit& circuit, NodeSets& merged) {
    std::map<int, int> out;
    for (const auto& e : circuit.elements)
        if (has_role(e, Role::capacitor))
            for (int k = 0; k < 2; ++k)
                out.emplace(merged.root(e.nodes[static_cast<std::size_t>(k)]), e.nodes[static_cast<std::size_t>(k)]);
    out.erase(merged.root(0));  // ground
    for (const auto& e : circuit.elements)
        if (has_role(e, Role::voltage_source) && !is_wire(e))
            for (const int node : e.nodes) out.erase(merged.root(node));
    return out;
}

/// The magnitude of the drain current, A, with the gate at the source voltage and `supply` (V) between drain and source. `forward` (V) is
/// the voltage of the bulk above the source, with the signs of an NMOS. `polarity`: 1 for NMOS, -1 for PMOS.
double drain_current(const Device& d, double polarity, double supply, double forward) {
    const double v[4] = {polarity * supply, 0, 0, polarity * forward};
    EvalContext context;
    context.with_charges = false;
    return std::abs(StampBuffer().eval(d, v, context).f[D]);
}

/// The leakage of every transistor at the operating point x. supply: V.
std::vector<Leakage> leakage_of(const System& system, std::span<const double> x, double supply) {
    std::vector<Leakage> out;
    const auto& circuit = system.circuit();
    NodeSets merged(circuit.nodes.size());  // by wires
    for (const auto& e : circuit.elements)
        if (is_wire(e)) merged.join(e.nodes[0], e.nodes[1]);
    const auto capacitor_node_of = capacitor_nodes(circuit, merged);
    for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
        const auto& e = circuit.elements[k];
        if (!has_role(e, Role::transistor)) continue;
        const auto& d = *system.devices()[k];
        const double polarity = circuit.model_of(e)->type == "pmos" ? -1 : 1;
        const auto v = system.terminal_values(d, x);
        const double source = std::min(polarity * v[D], polarity * v[S]);
        Leakage leak{k,     e.name, drain_current(d, polarity, supply, std::max(polarity * v[B] - source, 0.0)), polarity * v[G] - source,
                     false, ""};
        leak.is_off = leak.V_GS < thermal_voltage(circuit.temperature + zero_celsius);
        for (const auto end : {D, S})
            if (const auto node = capacitor_node_of.find(merged.root(e.nodes[end]));
                leak.capacitor_node.empty() && node != capacitor_node_of.end())
                leak.capacitor_node = circuit.nodes[static_cast<std::size_t>(node->second)];
        out.push_back(std::move(leak));
    }
    return out;
}

/// The smallest DC current above 0 of the ideal current sources, A, FORCE sources excluded; 0 if there is none.
double smallest_bias(const Circuit& circuit) {
    double smallest = 0;
    for (const auto& e : circuit.elements) {
        if (!has_role(e, Role::current_source) || e.waveform.shape == Waveform::Shape::force) continue;
        const double i = std::abs(e.waveform.dc * value_or(e.values, "m", 1));
        if (i > 0 && (smallest == 0 || i < smallest)) smallest = i;
    }
    return smallest;
}

void add_leakage(const AnalysisContext& context, std::span<const double> x, const Blocks& blocks, Cost& out) {
    out.smallest_bias = smallest_bias(*context.circuit);
    for (auto& leak : leakage_of(context.system, x, out.supply)) {
        auto& block = out.blocks[blocks.block_of_element[leak.element]];
        if (block.worst_leak.name.empty() || leak.current > block.worst_leak.current) block.worst_leak = leak;
        if (leak.is_off && out.smallest_bias > 0 && leak.current > min_reported_leak * out.smallest_bias)
            out.leaks.push_back(std::move(leak));
    }
    std::sort(out.leaks.begin(), out.leaks.end(), [](const Leakage& a, const Leakage& b) {
        return std::tuple(a.capacitor_node.empty(), -a.current, a.element) < std::tuple(b.capacitor_node.empty(), -b.current, b.element);
    });
}

using Json = nlohmann::ordered_json;

Json document_of(const Area& a) {
    return {{"gates_m2", a.gates},
            {"arrays_m2", a.arrays},
            {"islands_m2", a.islands},
            {"capacitors_m2", a.capacitors},
            {"total_m2", a.total()}};
}

Json document_of(const Cost& cost, const PowerBreakdown& p) {
    Json out = {{"delivered_W", p.supplies}, {"sensor_W", p.sensor}, {"without_sensor_W", p.without_sensor}};
    if (p.blocks.empty()) return out;  // a mean over a run is not divided by block
    Json sources = Json::object(), blocks = Json::object();
    for (std::size_t k = 0; k < p.sources.size(); ++k) sources[cost.sources[k]] = p.sources[k];
    for (std::size_t k = 0; k < p.blocks.size(); ++k) blocks[cost.blocks[k].name] = p.blocks[k];
    out["sources_W"] = sources, out["blocks_W"] = blocks;
    return out;
}

}  // namespace

Area area_of(const Circuit& circuit) {
    Area all;
    for (const auto& e : circuit.elements)
        if (const auto area = kind_of(e).area(e)) all += *area;
    return all;
}

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

Result<void> CostMeter::attach(RunOptions& options) {
    const auto operating_point = TRY(context_.operating_point());
    auto phases = TRY(force_phases(*context_.circuit));
    meter_.emplace(context_.system, operating_point.x, context_.tolerances.gmin);
    options.unknowns_sink = &power_over_time_.emplace(*meter_, std::move(phases));
    return {};
}

Json document_of(const Cost& cost) {
    Json power = Json::object(), blocks = Json::array(), leaks = Json::array();
    for (const auto& [when, p] : cost.power) power[when] = document_of(cost, p);
    for (const auto& b : cost.blocks) {
        blocks.push_back(
            {{"block", b.name}, {"arrays", b.transistors}, {"unit_transistors", b.unit_transistors}, {"area", document_of(b.area)}});
        if (!b.worst_leak.name.empty())
            blocks.back()["worst_leak"] = {{"transistor", b.worst_leak.name}, {"current_A", b.worst_leak.current}};
    }
    for (std::size_t k = 0; k < cost.leaks.size(); ++k) {
        leaks.push_back({{"transistor", cost.leaks[k].name}, {"current_A", cost.leaks[k].current}});
        if (!cost.leaks[k].capacitor_node.empty()) leaks.back()["capacitor_node"] = cost.leaks[k].capacitor_node;
    }
    Json out = {{"supply_V", cost.supply}, {"power", power}, {"area", document_of(cost.area())}, {"blocks", blocks}};
    out["unsized_elements"] = cost.unknown_areas;
    out["smallest_bias_A"] = cost.smallest_bias, out["off_leaks"] = leaks;
    if (cost.is_afferent) {
        Json per_mW = Json::object();
        for (const auto& [when, p] : cost.power)
            per_mW[when] = {{"without_sensor", p.without_sensor > 0 ? Json(1e-3 / p.without_sensor) : Json()},
                            {"delivered", p.supplies > 0 ? Json(1e-3 / p.supplies) : Json()}};
        out["afferents"] = {{"per_mm2", cost.area().total() > 0 ? Json(cost.per_mm2()) : Json()}, {"per_mW", per_mW}};
    }
    return out;
}

}  // namespace corpuscle::circuit
