// The summary of a skin run as a JSON document and as a table.

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/version.hpp"
#include "run/summary/json_number.hpp"
#include "run/summary/run_summary.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_first_spikes = 100;  // largest number of afferents under "first_spikes"

Json sources_document(const std::vector<SourceNote>& all) {
    Json out = Json::array();
    for (const auto& s : all) out.push_back({{"quantity", s.quantity}, {"source", s.source}});
    return out;
}

/// For each region: the number of afferents of class c and, if it was given, their density.
Json density_document(const Innervation& skin, std::size_t c) {
    const auto& plan = skin.plan;
    std::vector<std::int64_t> afferents(plan.sites.regions.size());
    for (std::size_t u = skin.class_begin[c]; u < skin.class_begin[c + 1]; ++u) ++afferents[skin.afferents[u].region];
    Json out = Json::object();
    for (std::size_t r = 0; r < afferents.size(); ++r) {
        out[plan.sites.regions[r]] = {{"afferents", afferents[r]}};
        if (!plan.classes[c].density.empty())
            out[plan.sites.regions[r]]["afferents_per_cm2"] = plan.classes[c].density[r] * 1e-4;  // from 1/m^2
    }
    return out;
}

Json class_document(const Innervation& skin, std::size_t c) {
    const auto& k = skin.plan.classes[c];
    Json out = {{"name", k.name}, {"afferents", skin.class_begin[c + 1] - skin.class_begin[c]}};
    if (k.per_site > 0) out["afferents_per_site"] = k.per_site;
    out["regions"] = density_document(skin, c);
    out["receptive_field"] = {{"sigma_m", k.sigma},       {"depth_m", k.depth},         {"surround", k.surround},
                              {"hot_spots", k.hot_spots}, {"receptors", k.receptors()}, {"hot_spot_spread_m", k.hot_spot_spread}};
    out["conduction"] = {{"velocity_m_s", k.velocity}, {"standard_deviation_m_s", k.velocity_spread}};
    if (const auto& w = k.wave; w.speed > 0)
        out["wave"] = {{"speed_m_s", w.speed}, {"decay_m", w.decay}, {"radius_m", w.radius}, {"gain", w.gain}, {"corner_Hz", w.corner}};
    out["afferent"] = document_of(k.afferent);
    out["spreads"] = document_of(k.distributions);
    out["sources"] = sources_document(k.sources);
    return out;
}

Json skin_document(const Innervation& skin) {
    const auto& plan = skin.plan;
    std::vector<std::int64_t> sites(plan.sites.regions.size());
    for (const auto r : plan.sites.region) ++sites[r];
    Json regions = Json::object();
    for (std::size_t r = 0; r < sites.size(); ++r)
        regions[plan.sites.regions[r]] = {{"sites", sites[r]}, {"area_cm2", 1e4 * static_cast<double>(sites[r]) * plan.sites.area}};
    Json out = {{"name", plan.name},
                {"description", plan.description},
                {"seed", plan.seed},
                {"afferents", skin.afferents.size()},
                {"sites", plan.sites.size()}};
    out["site_area_m2"] = plan.sites.area, out["felt_area_m2"] = plan.felt_area;
    out["nerve_m"] = plan.nerve ? Json{plan.nerve->x, plan.nerve->y} : Json(nullptr);
    out["regions"] = regions;
    out["sources"] = sources_document(plan.sources);
    return out;
}

Json skin_input_document(const SkinSummary& s, const SkinRunNotes& notes) {
    Json phases = Json::array(), parameters = Json::object();
    for (const auto& p : s.input.phases) phases.push_back({{"name", p.name}, {"from_s", p.from}, {"to_s", p.to}});
    for (const auto& f : notes.metadata) parameters[f.name] = {{"value", f.value}, {"unit", f.unit}};
    return {{"name", s.input.name},       {"description", s.input.description},
            {"contact", notes.contact},   {"parameters", parameters},
            {"force_min_N", s.min_force}, {"force_max_N", s.max_force},
            {"samples", s.samples},       {"rate_Hz", s.input.clock.rate()},
            {"t0_s", s.input.clock.t0},   {"touched_from_s", json_number(s.touch_start)},
            {"phases", phases},           {"notes", notes.notes}};
}

std::string region_name(const SkinSummary& s, const SkinSummaryRow& r) {
    return r.region == SkinSummaryRow::all ? "all" : s.skin->plan.sites.regions[r.region];
}

std::string phase_name(const SkinSummary& s, const SkinSummaryRow& r) {
    return r.phase == SkinSummaryRow::all ? "all" : s.input.phases[r.phase].name;
}

Json skin_row_document(const SkinSummary& s, const SkinSummaryRow& r) {
    return {{"afferent", s.skin->plan.classes[r.class_index].name},
            {"region", region_name(s, r)},
            {"phase", phase_name(s, r)},
            {"afferents", r.afferents},
            {"touched", r.touched},
            {"active", r.active},
            {"spikes", r.spikes},
            {"rate_of_active_Hz", json_number(r.rate())},
            {"rate_while_touched_Hz", json_number(r.touched_rate)},
            {"max_rate_Hz", json_number(r.max_rate)},
            {"first_spike_s", json_number(r.first_spike)},
            {"median_first_spike_s", json_number(r.median_first_spike)}};
}

}  // namespace

Json SkinSummary::document(const RespondOptions& options, const SkinRunNotes& notes) const {
    Json out = {{"program", "corpuscle"}, {"version", version}};
    out["options"] = {{"method", options.method == Method::exact ? "exact" : "backward-euler"}, {"sampled", options.sampled}};
    out["skin"] = skin_document(*skin);
    out["input"] = skin_input_document(*this, notes);
    out["classes"] = Json::array(), out["rates"] = Json::array(), out["first_spikes"] = Json::array();
    for (std::size_t c = 0; c < skin->plan.classes.size(); ++c) out["classes"].push_back(class_document(*skin, c));
    for (const auto& r : rows) out["rates"].push_back(skin_row_document(*this, r));
    for (const auto& f : first_spikes(max_first_spikes))
        out["first_spikes"].push_back({{"afferent_index", f.afferent_index},
                                       {"afferent", skin->afferent_name(f.afferent_index)},
                                       {"region", skin->plan.sites.regions[skin->afferents[f.afferent_index].region]},
                                       {"time_s", f.time}});
    const auto& stats = notes.stats;
    out["work"] = {{"steps", stats.samples},
                   {"afferent_steps", stats.afferent_steps},
                   {"at_rest", stats.skipped_steps},
                   {"spikes", stats.spikes},
                   {"truncated_steps", stats.truncated_steps}};
    out["warnings"] = notes.warnings;
    return out;
}

std::vector<std::vector<std::string>> SkinSummary::table() const {
    const bool phases = !input.phases.empty(), regions = skin->plan.sites.regions.size() > 1;
    std::vector<std::vector<std::string>> out = {{"afferent"}};
    if (regions) out[0].push_back("region");
    if (phases) out[0].push_back("phase");
    for (const auto* heading : {"afferents", "touched", "active", "spikes", "while touched (Hz)", "busiest (Hz)", "first (ms)", "median first (ms)"})
        out[0].push_back(heading);
    const auto put = [&](const SkinSummaryRow& r) {
        std::vector<std::string> cells = {skin->plan.classes[r.class_index].name};
        if (regions) cells.push_back(region_name(*this, r));
        if (phases) cells.push_back(phase_name(*this, r));
        for (const auto n : {r.afferents, r.touched, r.active, r.spikes}) cells.push_back(fmt::format("{}", n));
        for (const auto x : {r.touched_rate, r.max_rate}) cells.push_back(std::isfinite(x) ? fmt::format("{:.1f}", x) : "-");
        for (const auto x : {r.first_spike, r.median_first_spike}) cells.push_back(std::isfinite(x) ? fmt::format("{:.2f}", 1e3 * x) : "-");
        out.push_back(std::move(cells));
    };
    // The rows of all regions first, without and then with phases; then those of single regions over all phases, if afferents were active.
    const auto put_if = [&](auto wanted) {
        for (const auto& r : rows)
            if (wanted(r)) put(r);
    };
    put_if([](const SkinSummaryRow& r) { return r.region == SkinSummaryRow::all && r.phase == SkinSummaryRow::all; });
    put_if([](const SkinSummaryRow& r) { return r.region == SkinSummaryRow::all && r.phase != SkinSummaryRow::all; });
    put_if([](const SkinSummaryRow& r) { return r.region != SkinSummaryRow::all && r.phase == SkinSummaryRow::all && r.active > 0; });
    return out;
}

}  // namespace corpuscle
