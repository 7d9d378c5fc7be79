// A sweep's results as a JSON document: `corpuscle sweep show --json`.

#include <nlohmann/json.hpp>

#include "run/summary/json_number.hpp"
#include "sweep/stats/sweep_summary.hpp"

namespace corpuscle {
namespace {

using SummaryJson = nlohmann::ordered_json;

SummaryJson optional_json(const std::optional<double>& x) { return x ? json_number(*x) : SummaryJson(nullptr); }

/// The value and its confidence interval; NaN becomes null.
SummaryJson estimate_json(const Estimate& e) {
    return {{"value", json_number(e.value)}, {"low", json_number(e.low)}, {"high", json_number(e.high)}};
}

SummaryJson column_json(const SweepColumn& c) {
    SummaryJson out = {{"name", c.name}, {"unit", c.unit}, {"description", c.description}};
    if (!c.labels.empty()) out["words"] = c.labels;
    if (c.min || c.max) out["at_least"] = optional_json(c.min), out["at_most"] = optional_json(c.max);
    return out;
}

SummaryJson measure_json(const SweepColumn& c, const MeasureSummary& m) {
    SummaryJson out = {{"name", c.name}, {"items", m.count}, {"missing", m.missing}};
    if (m.yield) out["yield"] = estimate_json(*m.yield);
    out["mean"] = estimate_json(m.mean), out["sigma"] = estimate_json(m.sigma);
    out["min"] = json_number(m.min), out["max"] = json_number(m.max);
    out["quantiles"] = SummaryJson::array();
    for (const auto& q : m.quantiles) out["quantiles"].push_back(estimate_json(q));
    out["normal_plot"] = {{"correlation", json_number(m.normality)}, {"min_of_normal_samples", json_number(m.normality_floor)}};
    return out;
}

SummaryJson point_json(const SweepTable& table, const PointSummary& p) {
    SummaryJson measures = SummaryJson::array();
    for (std::size_t m = 0; m < p.measures.size(); ++m) measures.push_back(measure_json(table.measures[m], p.measures[m]));
    return {{"point", p.label},
            {"items", p.items},
            {"done", p.done},
            {"truncated", p.iteration_limit},
            {"diverged", p.diverged},
            {"passed", p.passed},
            {"yield", estimate_json(p.yield)},
            {"measures", std::move(measures)}};
}

SummaryJson influence_json(const NamedInfluence& i) {
    SummaryJson out = {{i.device >= 0 ? "device" : "axis", i.name}};
    if (i.device >= 0) out["quantity"] = i.quantity;
    out["fraction"] = estimate_json(i.influence.fraction), out["slope_per_sigma"] = json_number(i.influence.slope),
    out["p_value"] = json_number(i.influence.p_value);
    return out;
}

SummaryJson device_json(const MismatchSamples& samples, const DeviceContribution& c) {
    const auto& d = samples.subjects[static_cast<std::size_t>(c.subject)].devices[static_cast<std::size_t>(c.device)];
    return {{"device", d.name},
            {"type", d.pmos ? "pmos" : "nmos"},
            {"m", d.m},
            {"stack", d.stack},
            {"W_m", d.W},
            {"L_m", d.L},
            {"area_m2", d.area()},
            {"fraction_V_T", json_number(c.V_T)},
            {"fraction_I_S", json_number(c.I_S)},
            {"fraction", json_number(c.fraction())},
            {"relative_sigma_at_4x_area", json_number(relative_sigma_at_four_times_area(c.fraction()))}};
}

SummaryJson dependence_json(const SweepTable& table, const SweepSummary& summary, const Dependence& d) {
    SummaryJson points = SummaryJson::array(), influences = SummaryJson::array(), devices = SummaryJson::array();
    for (const auto& [axis, between] : d.points)
        points.push_back(
            {{"axis", table.axes[axis].name}, {"fraction", json_number(between.fraction)}, {"p_value", json_number(between.p_value)}});
    SummaryJson effects = SummaryJson::array();
    for (const auto& e : d.effects) {
        SummaryJson values = SummaryJson::array(), means = SummaryJson::array();
        for (const double x : table.points[e.axis]) values.push_back(json_number(x));
        for (const double x : e.means) means.push_back(json_number(x));
        effects.push_back({{"axis", table.axes[e.axis].name}, {"fraction", json_number(e.fraction)}, {"values", values}, {"means", means}});
    }
    for (const auto& i : d.influences) influences.push_back(influence_json(i));
    for (const auto& c : d.devices) devices.push_back(device_json(*summary.mismatch, c));
    SummaryJson out = {{"measure", d.measure},
                       {"between_points", points},
                       {"chips", d.sensitivity.items},
                       {"factors", d.sensitivity.factors},
                       {"explained_fraction", d.sensitivity.explained},
                       {"influences", influences},
                       {"devices", devices}};
    if (table.is_grid) out["effects"] = effects;
    return out;
}

}  // namespace

SummaryJson document_of(const SweepTable& table, const SweepSummary& summary, const std::string& title) {
    SummaryJson out = {{"title", title}, {"items", table.item_count}, {"finished", table.rows()}};
    if (table.is_grid)
        out["grid"] = true;
    else
        out["confidence"] = confidence;
    out["axes"] = SummaryJson::array(), out["measures"] = SummaryJson::array(), out["grouped_by"] = SummaryJson::array();
    for (std::size_t a = 0; a < table.axes.size(); ++a) {
        out["axes"].push_back(column_json(table.axes[a]));
        out["axes"].back()["is_listed"] = static_cast<bool>(table.is_listed[a]);
    }
    for (const auto& m : table.measures) out["measures"].push_back(column_json(m));
    for (const auto a : summary.axes) out["grouped_by"].push_back(table.axes[a].name);
    out["quantiles"] = summary.options.quantiles;
    out["all"] = point_json(table, summary.all);
    out["points"] = SummaryJson::array();
    for (const auto& p : summary.points) out["points"].push_back(point_json(table, p));
    out["depends_on"] = SummaryJson::array();
    for (const auto& d : summary.dependences) out["depends_on"].push_back(dependence_json(table, summary, d));
    return out;
}

}  // namespace corpuscle
