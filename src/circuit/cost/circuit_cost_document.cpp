// The cost of a circuit (power, area, leakage) as a JSON document.

#include <nlohmann/json.hpp>

#include "circuit/cost/cost.hpp"

namespace corpuscle::circuit {
namespace {

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
