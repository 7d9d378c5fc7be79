#include "report/report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "report/template.hpp"
#include "signal/version.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json trace_document(std::uint32_t channel, const Json& afferent, std::string_view part, std::string_view unit, const Envelope& e) {
    return {{"channel", channel},
            {"afferent", afferent},
            {"part", part},
            {"unit", unit},
            {"bucket", e.bucket()},
            {"count", e.count()},
            {"data", base64(e.values().data(), e.values().size() * sizeof(float))}};
}

Json parameter_document(const Parameter& p, double value) {
    return {{"name", p.row.name},         {"value", value},         {"unit", p.row.unit}, {"default", p.row.initial}, {"set", p.set},
            {"sentence", p.row.sentence}, {"source", p.row.source}, {"of", p.of}};
}

Json level(const AfferentPlan& plan, std::string_view name) {
    const auto value = plan.value(name);
    return value ? Json(*value) : Json(nullptr);
}

Json table_document(const Summary& summary) {
    Json columns = {"afferent", "channel", "phase"}, decimals = {nullptr, nullptr, nullptr}, rows = Json::array();
    const auto told = summary.columns();
    for (const auto m : told) columns.push_back(heading(measures[m])), decimals.push_back(measures[m].decimals);
    for (const auto& r : summary.rows()) {
        Json row = {r.afferent, r.channel, r.phase};
        for (const auto m : told) row.push_back(std::isfinite(r.values[m]) ? Json(r.values[m]) : Json(nullptr));
        rows.push_back(std::move(row));
    }
    return {{"columns", columns}, {"decimals", decimals}, {"rows", rows}};
}

/// What was found of the recordings, in words, and a row a channel in numbers; no rows for stimuli.
Json quality_document(const Summary& summary) {
    Json sentences = Json::array(), columns = {"channel"}, rows = Json::array();
    const bool several = summary.inputs().size() > 1;
    for (const auto& i : summary.inputs()) {
        const auto tell = [&](const std::vector<std::string>& told, bool grave) {
            for (const auto& s : told) sentences.push_back({{"text", several ? i.name + ": " + s : s}, {"grave", grave}});
        };
        tell(i.quality.warnings, true);
        tell(i.quality.sentences, false);
        for (const auto& f : i.quality.findings) {
            if (rows.empty() || rows.back()[0] != i.channels[f.channel]) rows.push_back(Json::array({i.channels[f.channel]}));
            if (rows.size() == 1) columns.push_back(f.unit.empty() ? std::string(f.name) : fmt::format("{} ({})", f.name, f.unit));
            rows.back().push_back(std::isfinite(f.value) ? Json(f.value) : Json(nullptr));
        }
    }
    return {{"sentences", sentences}, {"columns", columns}, {"rows", rows}};
}

}  // namespace

Result<void> Report::begin(const Input& input) {
    const std::size_t traces = input.source.channels().size() * (1 + [&] {
                                   std::size_t n = 0;
                                   for (const auto& p : input.probes) n += p.size();
                                   return n;
                               }());
    // A trace over its share keeps pairs: two points each.
    const std::size_t most = std::clamp<std::size_t>(most_points_ / (2 * traces * input.of), 16, std::size_t{1} << 20);
    forces_.assign(input.source.channels().size(), Envelope(most));
    probes_.clear();
    for (std::size_t u = 0; u < input.units(); ++u) probes_.emplace_back(input.probes[u % input.afferents.size()].size(), Envelope(most));
    trains_.assign(input.units(), {});
    if (parts_.empty())
        for (const auto& probes : input.probes) {
            Json parts = Json::array();
            for (const auto& p : probes) parts.push_back({{"name", p.name}, {"unit", p.unit}});
            parts_.push_back(std::move(parts));
        }
    return {};
}

Result<void> Report::block(const Input& input, const Answered& answered) {
    for (std::size_t c = 0; c < forces_.size(); ++c)
        for (std::size_t k = 0; k < answered.force.count; ++k) forces_[c].add(answered.force.force[c][k]);
    for (std::size_t u = 0; u < probes_.size(); ++u)
        for (std::size_t p = 0; p < probes_[u].size(); ++p)
            for (std::size_t k = 0; k < answered.force.count; ++k) probes_[u][p].add(answered.probes[u][p][k]);
    for (const auto& s : answered.spikes) trains_[s.unit - input.first_unit].push_back(input.source.clock().time(s.step, s.offset));
    return {};
}

Result<void> Report::end(const Input& input, std::int64_t samples) {
    Json channels = Json::array(), phases = Json::array();
    for (std::size_t c = 0; c < forces_.size(); ++c) {
        channels.push_back({{"id", first_channel_ + c}, {"name", input.channel_name(c)}, {"unit", "N"}});
        traces_.push_back(trace_document(first_channel_ + static_cast<std::uint32_t>(c), nullptr, "force", "N", forces_[c]));
    }
    for (const auto& p : input.source.phases()) phases.push_back({{"name", p.name}, {"from", p.from}, {"to", p.to}});
    for (std::size_t u = 0; u < input.units(); ++u) {
        const auto channel = first_channel_ + static_cast<std::uint32_t>(input.channel_of(u));
        const auto& name = input.afferent_of(u).name;
        const auto& probes = input.probes[u % input.afferents.size()];
        for (std::size_t p = 0; p < probes.size(); ++p)
            traces_.push_back(trace_document(channel, name, probes[p].name, probes[p].unit, probes_[u][p]));
        spikes_.push_back({{"afferent", name},
                           {"channel", channel},
                           {"count", trains_[u].size()},
                           {"times", base64(trains_[u].data(), trains_[u].size() * sizeof(double))}});
    }
    inputs_.push_back({{"name", input.name},
                       {"sentence", input.source.sentence()},
                       {"t0", input.source.clock().t0},
                       {"T", input.source.clock().T()},
                       {"samples", samples},
                       {"phases", phases},
                       {"channels", channels}});
    first_channel_ += static_cast<std::uint32_t>(forces_.size());
    return {};
}

std::string Report::page(const Summary& summary, std::span<const AfferentPlan> plans, const std::string& command,
                         const std::vector<std::string>& warnings) const {
    std::string title;
    for (const auto& i : summary.inputs()) title += (title.empty() ? "" : ", ") + i.name;
    Json afferents = Json::array(), remarks = Json::array();
    for (std::size_t a = 0; a < plans.size(); ++a) {
        const auto& plan = plans[a];
        Json parameters = Json::array();
        for (std::size_t k = 0; k < plan.values.size(); ++k) parameters.push_back(parameter_document((*plan.parameters)[k], plan.values[k]));
        afferents.push_back({{"name", plan.name},
                             {"made_of", plan.made_of()},
                             {"sentence", plan.sentence},
                             {"V_th", level(plan, "V_th")},
                             {"V_reset", level(plan, "V_reset")},
                             {"parameters", parameters},
                             {"parts", parts_[a]}});
    }
    for (const auto& w : warnings) remarks.push_back(w);
    for (const auto& i : summary.inputs())
        for (const auto& r : i.remarks) remarks.push_back(i.name + ": " + r);
    const Json document = {{"title", title},
                           {"program", fmt::format("corpuscle {}", version)},
                           {"command", command},
                           {"inputs", inputs_},
                           {"afferents", afferents},
                           {"traces", traces_},
                           {"spikes", spikes_},
                           {"table", table_document(summary)},
                           {"quality", quality_document(summary)},
                           {"remarks", remarks},
                           {"versions", {{"corpuscle", version}, {"compiler", compiler()}}}};
    return filled(asset("page.html"), escaped(title), safe_json(document));
}

}  // namespace corpuscle
