#include "run/summary/run_summary.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/version.hpp"
#include "run/channels/channel_population.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

/// Appends a key that the object does not have yet, without a search for it, which would be slow with 100,000 channels.
void append_key(Json& object, std::string key, Json value) {
    object.get_ref<Json::object_t&>().push_back({std::move(key), std::move(value)});
}

/// The positions of the sensors by channel name, for the sensors whose position is known.
Json position_document(const RunSummary::InputSummary& input) {
    Json out = Json::object();
    for (std::size_t c = 0; c < input.sensors.size(); ++c)
        if (const auto& p = input.sensors[c].position) append_key(out, input.channels[c], {p->x, p->y, p->z});
    return out;
}

Json quality_document(const RunSummary::InputSummary& input) {
    Json channels = Json::object();
    const auto& metrics = input.quality.metrics;  // in order of channels
    for (std::size_t k = 0; k < metrics.size();) {
        Json one = Json::object();
        const auto channel = metrics[k].channel;
        for (; k < metrics.size() && metrics[k].channel == channel; ++k)
            append_key(one, metrics[k].unit.empty() ? std::string(metrics[k].name) : fmt::format("{}_{}", metrics[k].name, metrics[k].unit),
                       json_number(metrics[k].value));
        append_key(channels, input.channels[channel], std::move(one));
    }
    return {{"warnings", input.quality.warnings}, {"notes", input.quality.descriptions}, {"channels", channels}};
}

Json input_document(const RunSummary::InputSummary& input) {
    Json phases = Json::array();
    for (const auto& p : input.phases) phases.push_back({{"name", p.name}, {"from_s", p.from}, {"to_s", p.to}});
    Json parameters = Json::object();
    for (const auto& f : input.metadata) append_key(parameters, f.name, {{"value", f.value}, {"unit", f.unit}});
    return {{"name", input.name},
            {"parameters", parameters},
            {"force_min_N", input.min_force},
            {"force_max_N", input.max_force},
            {"samples", input.samples},
            {"rate_Hz", input.clock.rate()},
            {"t0_s", input.clock.t0},
            {"channels", input.channels},
            {"phases", phases},
            {"notes", input.notes},
            {"positions", position_document(input)},
            {"quality", quality_document(input)}};
}

Json copies_document(const CopyStatistics& o) {
    return {{"mean", json_number(o.mean())},
            {"standard_deviation", json_number(o.standard_deviation())},
            {"min", json_number(o.min)},
            {"max", json_number(o.max)},
            {"copies", o.copies}};
}

Json row_document(const MeasureRow& row) {
    Json out = {{"afferent", row.afferent}, {"channel", row.channel}, {"phase", row.phase}};
    for (std::size_t m = 0; m < std::size(measures); ++m)
        // A measure without decimals is a count, which is never NaN.
        out[measure_key(measures[m])] = !row.copy_statistics.empty() ? copies_document(row.copy_statistics[m])
                                        : measures[m].decimals == 0  ? Json(static_cast<std::int64_t>(row.values[m]))
                                                                     : json_number(row.values[m]);
    return out;
}

/// For each afferent whose cost is known, in a list without copies: the cost (power, area, leakage) of one afferent at rest under `force`
/// (N), and its mean power during the run, over all its copies and channels. An empty array if no afferent has a known cost.
Json cost_documents_of(std::span<const AfferentPlan> afferents, const RunStats& stats, double force) {
    Json out = Json::array();
    for (std::size_t a = 0; a < afferents.size(); ++a) {
        const std::size_t copies = stats.energy_use.size() / afferents.size();  // which are adjacent; every afferent has the same number
        EnergyUse energy;                                                       // of all copies
        for (std::size_t k = 0; k < copies; ++k) energy += stats.energy_use[a * copies + k];
        const auto cost = afferents[a].factory->cost(force, energy);
        if (cost.is_null()) continue;
        out.push_back({{"afferent", afferents[a].name}, {"rest_force_N", force}});
        out.back().update(cost);
    }
    return out;
}

}  // namespace

void CopyStatistics::add(double x) {
    if (std::isnan(x)) return;
    if (copies++ == 0) min = max = x;
    min = std::min(min, x), max = std::max(max, x);
    sum_ += x;
    const double distance = x - mean_;
    mean_ += distance / static_cast<double>(copies);
    squares_ += distance * (x - mean_);
}

std::string measure_key(const MeasureInfo& m) { return m.unit.empty() ? std::string(m.name) : fmt::format("{}_{}", m.name, m.unit); }

Json document_of(const AfferentPlan& plan) {
    Json parameters = Json::object();
    for (std::size_t k = 0; k < plan.values.size(); ++k) {
        const auto& p = (*plan.parameters)[k];
        parameters[std::string(p.info.name)] = {
            {"value", plan.values[k]}, {"unit", p.info.unit}, {"component", p.component}, {"set", p.set_by_user}};
    }
    Json out = {{"name", plan.name}, {"composition", plan.composition()}};
    for (const auto& [name, label] : plan.factory->labels(plan)) out[name] = label;
    out["parameters"] = std::move(parameters);
    return out;
}

Json document_of(std::span<const ParameterDistribution> all) {
    Json spreads = Json::array();
    for (const auto& s : all)
        spreads.push_back({{"afferent", s.afferent},
                           {"parameter", s.parameter},
                           {"standard_deviation", s.factor ? Json(nullptr) : Json(s.deviation)},
                           {"unit", s.unit},
                           {"fraction", s.fraction ? Json(*s.fraction) : Json(nullptr)},
                           {"factor", s.factor ? Json(*s.factor) : Json(nullptr)}});
    return spreads;
}

Json document_of(const CopySpec& copies) { return {{"per_afferent", copies.count}, {"spreads", document_of(copies.distributions)}}; }

std::string column_heading(const MeasureInfo& m) { return std::string(m.title) + (m.unit.empty() ? "" : " (" + std::string(m.unit) + ")"); }

Result<void> RunSummary::begin(const Input& input) {
    const auto& afferents = input.on_channels();
    inputs.push_back({input, afferents.force_names(), afferents.sensors()});
    std::vector<TimeWindow> windows;  // one for each phase; without phases one for the whole input, whose end is set in end()
    for (const auto& p : input.phases) windows.push_back({p.from, p.to, input.cycle_frequency});
    if (windows.empty()) windows.push_back({.stimulus_frequency = input.cycle_frequency});
    tally_ = MeasureAccumulator(std::move(windows), afferents.size());
    return comparisons.begin(input);
}

Result<void> RunSummary::block(const Input& input, const RunBlock& block) {
    auto& summary = inputs.back();
    for (const auto& channel : block.force)
        for (const double f : channel)
            summary.min_force = std::min(summary.min_force, f), summary.max_force = std::max(summary.max_force, f);
    for (const auto& s : block.spikes) tally_.spike(input.afferent_of(s), input.since_start(s));
    return comparisons.block(input, block);
}

Result<void> RunSummary::end(const Input& input, std::int64_t samples, std::span<const Spike> last) {
    auto& summary = inputs.back();
    summary.samples = samples;
    summary.quality = input.quality;
    tally_.set_end(input.since_start(samples));
    const auto groups =
        copy_group_starts(input.on_channels().plans());  // groups[g] is the first plan of afferent g, groups.back() the number of plans
    for (std::size_t c = 0; c < summary.channels.size(); ++c)
        for (std::size_t g = 0; g + 1 < groups.size(); ++g)
            for (std::size_t p = 0; p < std::max<std::size_t>(summary.phases.size(), 1); ++p)
                rows.push_back(row(input, c, groups[g], groups[g + 1], p));
    return comparisons.end(input, samples, last);
}

MeasureRow RunSummary::row(const Input& input, std::size_t channel, std::size_t from, std::size_t to, std::size_t phase) const {
    const auto& summary = inputs.back();
    const auto plans = input.on_channels().plans();
    const std::size_t first = channel * plans.size();
    MeasureRow row{base_name(plans[from]), summary.channels[channel], summary.phases.empty() ? "all" : summary.phases[phase].name,
                   tally_.values(first + from, phase)};
    const double T = input.clock.T();
    if (plans[from].copy_number == 0) {  // not a copy
        row.has_unresolved_rate = remove_unresolved_rates(row.values, T);
        if (row.values[measure_index<SpikeCount>()] == 1)
            row.values[measure_index<MeanRate>()] = no_value;  // one spike does not define a rate
        return row;
    }
    row.copy_statistics.resize(std::size(measures));
    for (std::size_t a = from; a < to; ++a) {
        auto values = tally_.values(first + a, phase);
        row.has_unresolved_rate |= remove_unresolved_rates(values, T);
        for (std::size_t m = 0; m < values.size(); ++m) row.copy_statistics[m].add(values[m]);
    }
    for (std::size_t m = 0; m < row.values.size(); ++m) row.values[m] = row.copy_statistics[m].mean();
    return row;
}

std::vector<std::size_t> RunSummary::columns() const {
    std::vector<std::size_t> columns;
    for (std::size_t m = 0; m < std::size(measures); ++m)
        if (std::any_of(rows.begin(), rows.end(), [m](const MeasureRow& r) { return std::isfinite(r.values[m]); })) columns.push_back(m);
    return columns;
}

Json RunSummary::document(std::span<const AfferentPlan> afferents, const RunStats& stats, const RespondOptions& options,
                          const std::vector<std::string>& warnings) const {
    Json out = {{"program", "corpuscle"}, {"version", version}};
    out["options"] = {{"method", options.method == Method::exact ? "exact" : "backward-euler"},
                      {"sampled", options.sampled},
                      {"precision", options.precision == Precision::double_precision ? "double" : "float"},
                      {"noise_A", options.noise},
                      {"seed", options.seed}};
    out["afferents"] = Json::array();
    for (const auto& a : afferents) out["afferents"].push_back(document_of(a));
    out["inputs"] = Json::array();
    for (const auto& i : inputs) out["inputs"].push_back(input_document(i));
    out["rates"] = Json::array();
    for (const auto& r : rows) out["rates"].push_back(row_document(r));
    if (!comparisons.rows.empty()) out["comparisons"] = comparisons.document();
    out["work"] = {{"samples", stats.samples},     {"afferent_steps", stats.afferent_steps},
                   {"spikes", stats.spikes},       {"truncated_steps", stats.truncated_steps},
                   {"saturated", stats.saturated}, {"overflowed", stats.overflowed}};
    if (stats.steps > 0 || !stats.diverged.empty())
        out["work"]["circuits"] = {{"steps", stats.steps},
                                   {"rejected", stats.rejected},
                                   {"iterations", stats.iterations},
                                   {"not_converged", stats.diverged.size()}};
    double rest_force = INFINITY;  // the smallest force of the run
    for (const auto& i : inputs) rest_force = std::min(rest_force, i.min_force);
    if (auto costs = cost_documents_of(afferents, stats, rest_force); !costs.empty()) out["costs"] = std::move(costs);
    out["warnings"] = warnings;
    return out;
}

}  // namespace corpuscle
