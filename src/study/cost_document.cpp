#include "study/cost_document.hpp"

#include <nlohmann/json.hpp>

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json document_of(const circuit::Area& a) {
    return {
        {"gates_m2", a.gates}, {"arrays_m2", a.arrays}, {"apart_m2", a.apart}, {"capacitors_m2", a.capacitors}, {"total_m2", a.total()}};
}

Json document_of(const circuit::Cost& cost, const circuit::Powers& p) {
    Json sources = Json::object(), blocks = Json::object();
    for (std::size_t k = 0; k < p.sources.size(); ++k) sources[cost.sources[k]] = p.sources[k];
    for (std::size_t k = 0; k < p.blocks.size(); ++k) blocks[cost.blocks[k].name] = p.blocks[k];
    return {{"delivered_W", p.supplies}, {"sensor_W", p.sensor}, {"own_W", p.own}, {"sources_W", sources}, {"blocks_W", blocks}};
}

}  // namespace

Json document_of(const circuit::Cost& cost) {
    Json power = Json::object(), blocks = Json::array(), leaks = Json::array();
    for (const auto& [when, p] : cost.power) power[when] = document_of(cost, p);
    for (const auto& b : cost.blocks) {
        blocks.push_back({{"block", b.name}, {"arrays", b.transistors}, {"units", b.units}, {"area", document_of(b.area)}});
        if (!b.worst_name.empty()) blocks.back()["worst_leak"] = {{"transistor", b.worst_name}, {"current_A", b.worst.current}};
    }
    for (std::size_t k = 0; k < cost.leaks.size(); ++k) {
        leaks.push_back({{"transistor", cost.leaking[k]}, {"current_A", cost.leaks[k].current}});
        if (!cost.leaks[k].onto.empty()) leaks.back()["onto"] = cost.leaks[k].onto;
    }
    Json out = {{"supply_V", cost.supply}, {"power", power}, {"area", document_of(cost.area())}, {"blocks", blocks}};
    out["unsized_elements"] = cost.unsized;
    out["smallest_bias_A"] = cost.smallest_bias, out["off_leaks"] = leaks;
    if (cost.is_receptor) {
        Json per_mW = Json::object();
        for (const auto& [when, p] : cost.power)
            per_mW[when] = {{"own", p.own > 0 ? Json(1e-3 / p.own) : Json()},
                            {"delivered", p.supplies > 0 ? Json(1e-3 / p.supplies) : Json()}};
        out["receptors"] = {{"per_mm2", cost.area().total() > 0 ? Json(cost.per_mm2()) : Json()}, {"per_mW", per_mW}};
    }
    return out;
}

}  // namespace corpuscle
