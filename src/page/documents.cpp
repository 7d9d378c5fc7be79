#include "page/documents.hpp"

#include <cmath>

#include "run/catalogue/catalogue_document.hpp"
#include "run/compare/implementation_comparison.hpp"

namespace corpuscle::page {

Json document_of(const AfferentPlan& plan) {
    return {{"name", plan.name},
            {"class", afferent_type_of(plan.name)},
            {"composition", plan.composition()},
            {"is_circuit", plan.traits().is_implementation},
            {"description", plan.description}};
}

Json document_of(std::span<const Probe> probes) {
    auto out = Json::array();
    for (const auto& p : probes) out.push_back({{"name", p.name}, {"unit", p.unit}});
    return out;
}

Json document_of(std::span<const ValidRange> ranges) {
    auto out = Json::array();
    for (const auto& r : ranges)
        out.push_back({{"quantity", r.quantity}, {"unit", r.unit}, {"low", r.low}, {"high", r.high}, {"meaning", r.meaning}});
    return out;
}

Json document_of(std::span<const Phase> phases) {
    auto out = Json::array();
    for (const auto& p : phases) out.push_back({{"name", p.name}, {"from", p.from}, {"to", p.to}});
    return out;
}

Json document_of(std::span<const SettableValue> values) {
    constexpr const char* kinds[] = {"number", "choice", "array"};  // in the order of the enumerators
    auto out = Json::array();
    for (const auto& v : values) {
        const bool is_number = v.kind == SettableValue::Kind::number;
        Json row = {{"name", v.name}, {"kind", kinds[static_cast<int>(v.kind)]}, {"unit", v.unit}};
        row["value"] = !is_number ? Json(v.text) : std::isnan(v.value) ? Json() : Json(v.value);
        if (!v.choices.empty()) row["choices"] = v.choices;
        row["block"] = v.block, row["description"] = v.description;
        out.push_back(std::move(row));
    }
    return out;
}

Json parameters_document(const AfferentPlan& plan) {
    auto out = Json::array();
    for (std::size_t k = 0; k < plan.parameters->size(); ++k) {
        auto row = corpuscle::document_of((*plan.parameters)[k]);
        row["value"] = plan.values[k];
        out.push_back(std::move(row));
    }
    return out;
}

void add_spikes(MessageWriter& answer, std::span<const Spike> spikes, const Clock& clock) {
    std::vector<std::uint32_t> units;
    units.reserve(spikes.size());
    for (const auto& s : spikes) units.push_back(s.afferent_index);
    answer.add("unit", units);
    answer.add("time", spike_times(spikes, clock));
}

}  // namespace corpuscle::page
