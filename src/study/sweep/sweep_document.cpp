#include "study/sweep/sweep_document.hpp"

#include <nlohmann/json.hpp>

#include "study/json_number.hpp"

namespace corpuscle {
namespace {

using SummaryJson = nlohmann::ordered_json;

SummaryJson optional_json(const std::optional<double>& x) { return x ? json_number(*x) : SummaryJson(nullptr); }

/// The value and its confidence interval.
SummaryJson estimate_json(const Estimate& e) {
    return {{"value", json_number(e.value)}, {"low", json_number(e.low)}, {"high", json_number(e.high)}};
}

SummaryJson column_json(const SweepColumn& c) {
    SummaryJson out = {{"name", c.name}, {"unit", c.unit}, {"sentence", c.description}};
    if (!c.labels.empty()) out["words"] = c.labels;
    if (c.min || c.max) out["at_least"] = optional_json(c.min), out["at_most"] = optional_json(c.max);
    return out;
}

SummaryJson measure_json(const SweepColumn& c, const MeasureSummary& m) {
    SummaryJson out = {{"name", c.name}, {"units", m.count}, {"without", m.missing}};
    if (m.yield) out["yield"] = estimate_json(*m.yield);
    out["mean"] = estimate_json(m.mean), out["sigma"] = estimate_json(m.sigma);
    out["least"] = json_number(m.min), out["greatest"] = json_number(m.max);
    out["quantiles"] = SummaryJson::array();
    for (const auto& q : m.quantiles) out["quantiles"].push_back(estimate_json(q));
    out["normal_plot"] = {{"correlation", json_number(m.normality)}, {"of_normal_samples_at_least", json_number(m.normality_floor)}};
    return out;
}

SummaryJson point_json(const SweepTable& table, const PointSummary& p) {
    SummaryJson measures = SummaryJson::array();
    for (std::size_t m = 0; m < p.measures.size(); ++m) measures.push_back(measure_json(table.measures[m], p.measures[m]));
    return {{"point", p.label},
            {"units", p.items},
            {"done", p.done},
            {"capped", p.iteration_limit},
            {"lost", p.diverged},
            {"passed", p.passed},
            {"yield", estimate_json(p.yield)},
            {"measures", std::move(measures)}};
}

SummaryJson influence_json(const NamedInfluence& i) {
    SummaryJson out = {{i.device >= 0 ? "device" : "axis", i.name}};
    if (i.device >= 0) out["part"] = i.quantity;
    out["share"] = estimate_json(i.influence.fraction), out["slope_for_one_sigma"] = json_number(i.influence.slope),
    out["chance"] = json_number(i.influence.p_value);
    return out;
}

SummaryJson device_json(const MismatchSamples& drawn, const DeviceContribution& s) {
    const auto& d = drawn.subjects[static_cast<std::size_t>(s.subject)].devices[static_cast<std::size_t>(s.device)];
    return {{"device", d.name},
            {"type", d.pmos ? "pmos" : "nmos"},
            {"m", d.m},
            {"stack", d.stack},
            {"W_m", d.W},
            {"L_m", d.L},
            {"area_m2", d.area()},
            {"share_V_T", json_number(s.V_T)},
            {"share_I_S", json_number(s.I_S)},
            {"share", json_number(s.fraction())},
            {"sigma_with_four_times_the_area", json_number(relative_sigma_at_four_times_area(s.fraction()))}};
}

SummaryJson dependence_json(const SweepTable& table, const SweepSummary& summary, const Dependence& d) {
    SummaryJson points = SummaryJson::array(), influences = SummaryJson::array(), devices = SummaryJson::array();
    for (const auto& [axis, between] : d.points)
        points.push_back(
            {{"axis", table.axes[axis].name}, {"share", json_number(between.fraction)}, {"chance", json_number(between.p_value)}});
    SummaryJson effects = SummaryJson::array();
    for (const auto& e : d.effects) {
        SummaryJson values = SummaryJson::array(), means = SummaryJson::array();
        for (const double x : table.points[e.axis]) values.push_back(json_number(x));
        for (const double x : e.means) means.push_back(json_number(x));
        effects.push_back({{"axis", table.axes[e.axis].name}, {"share", json_number(e.fraction)}, {"values", values}, {"means", means}});
    }
    for (const auto& i : d.influences) influences.push_back(influence_json(i));
    for (const auto& s : d.devices) devices.push_back(device_json(*summary.mismatch, s));
    SummaryJson out = {{"measure", d.measure},
                       {"between_points", points},
                       {"chips", d.sensitivity.items},
                       {"factors", d.sensitivity.factors},
                       {"explained", d.sensitivity.explained},
                       {"influences", influences},
                       {"devices", devices}};
    if (table.is_grid) out["effects"] = effects;
    return out;
}

}  // namespace

SummaryJson document_of(const SweepTable& table, const SweepSummary& summary, const std::string& title) {
    SummaryJson out = {{"title", title}, {"units", table.item_count}, {"finished", table.rows()}};
    if (table.is_grid)
        out["grid"] = true;
    else
        out["confidence"] = confidence;
    out["axes"] = SummaryJson::array(), out["measures"] = SummaryJson::array(), out["by"] = SummaryJson::array();
    for (const auto& a : table.axes) out["axes"].push_back(column_json(a));
    for (const auto& m : table.measures) out["measures"].push_back(column_json(m));
    for (const auto a : summary.axes) out["by"].push_back(table.axes[a].name);
    out["quantiles"] = summary.options.quantiles;
    out["all"] = point_json(table, summary.all);
    out["points"] = SummaryJson::array();
    for (const auto& p : summary.points) out["points"].push_back(point_json(table, p));
    out["depends_on"] = SummaryJson::array();
    for (const auto& d : summary.dependences) out["depends_on"].push_back(dependence_json(table, summary, d));
    return out;
}

}  // namespace corpuscle
