// The report page of a skin.

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page_template.hpp"
#include "report/skin/skin_report.hpp"
#include "skin/plan/skin_outline.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_named = 500;  // if there are more sites, the page does not contain their names

/// Positions as an array x, y, x, y ... in m.
Json places_document(std::span<const Position> positions) {
    std::vector<float> xy;
    for (const auto& p : positions)
        for (const double v : {p.x, p.y}) xy.push_back(static_cast<float>(v));
    return array_document(xy);
}

/// The outlines of the skin and of its regions as polygons; none if the sites are separate sensors.
Json outline_document(const Sites& sites) {
    const auto outline = skin_outline(sites);
    Json skin = Json::array(), regions = Json::array();
    for (const auto& polygon : outline.skin) skin.push_back(places_document(polygon));
    for (const auto& region : outline.regions)
        for (const auto& polygon : region) regions.push_back(places_document(polygon));
    return {{"skin", skin}, {"regions", regions}};
}

Json sites_document(const Sites& sites) {
    const std::vector<std::uint16_t> region(sites.region.begin(), sites.region.end());
    return {{"places", places_document(sites.positions)},
            {"side", std::sqrt(sites.area)},
            {"outline", outline_document(sites)},
            {"region", array_document(region)},
            {"names", sites.size() <= max_named ? Json(sites.names) : Json(nullptr)}};
}

/// The properties of each mark that do not change over time. Mark m stands for the afferents begin[m] ... begin[m + 1] - 1; it has their
/// mean position, the earliest of their first spikes (s; NaN if none fired), and the region and number of the first of them.
Json marks_document(const SkinSummary& summary, std::span<const std::uint32_t> begin) {
    const auto& afferents = summary.skin->afferents;
    std::vector<std::uint16_t> region;
    std::vector<std::uint32_t> copy;  // number of the first afferent within its class, from 1
    std::vector<float> first_spikes;
    std::vector<Position> positions;
    for (std::size_t m = 0; m + 1 < begin.size(); ++m) {
        Position mean;
        double earliest = no_value;
        for (auto u = begin[m]; u < begin[m + 1]; ++u) {
            mean.x += afferents[u].position.x / (begin[m + 1] - begin[m]), mean.y += afferents[u].position.y / (begin[m + 1] - begin[m]);
            earliest = std::fmin(earliest, summary.first_times[u]);  // fmin ignores NaN
        }
        positions.push_back(mean), first_spikes.push_back(static_cast<float>(earliest));
        region.push_back(static_cast<std::uint16_t>(afferents[begin[m]].region)), copy.push_back(afferents[begin[m]].number);
    }
    return {{"begin", array_document(begin)},
            {"places", places_document(positions)},
            {"region", array_document(region)},
            {"copy", array_document(copy)},
            {"first", array_document(first_spikes)}};
}

Json classes_document(const Innervation& skin) {
    Json out = Json::array();
    for (std::size_t c = 0; c < skin.plan.classes.size(); ++c) {
        const auto& k = skin.plan.classes[c];
        out.push_back({{"name", k.name},
                       {"composition", k.afferent.composition()},
                       {"description", k.afferent.description},
                       {"source", k.afferent.source},
                       {"first", skin.class_begin[c]},
                       {"afferents", skin.class_begin[c + 1] - skin.class_begin[c]},
                       {"parameters", parameters_document(k.afferent, k.distributions)}});
    }
    return out;
}

}  // namespace

std::string skin_page(const SkinSummary& summary, const SkinReport& report, const RespondOptions& options, const SkinRunNotes& run_info,
                      const std::string& command, const Json& trials) {
    const auto title = fmt::format("{} on {}", summary.input.name, summary.skin->plan.name);
    Json notes = run_info.warnings;
    for (const auto& r : run_info.notes) notes.push_back(r);
    return report_page("skin", title, command,
                       {{"notes", notes},
                        {"summary", summary.document(options, run_info)},
                        {"regions", summary.skin->plan.sites.regions},
                        {"sites", sites_document(summary.skin->plan.sites)},
                        {"marks", marks_document(summary, report.marks())},
                        {"classes", classes_document(*summary.skin)},
                        {"over", report.document()},
                        {"trials", trials},
                        {"versions", versions_document()}});
}

}  // namespace corpuscle
