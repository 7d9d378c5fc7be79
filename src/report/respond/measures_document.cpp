#include <fmt/format.h>
#include <algorithm>

#include "report/respond/respond_report.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

/// The cell of measure m: its value, or the array [mean, standard deviation] over the copies if at least two of them have a value.
Json cell_document(const MeasureRow& row, std::size_t m) {
    if (row.copy_statistics.empty() || row.copy_statistics[m].copies < 2) return json_number(row.values[m]);
    return {json_number(row.copy_statistics[m].mean()), json_number(row.copy_statistics[m].standard_deviation())};
}

}  // namespace

Json rates_document(const RunSummary& summary) {
    Json columns = {"afferent", "channel", "phase"}, decimals = {nullptr, nullptr, nullptr}, rows = Json::array();
    const auto shown = summary.columns();
    const bool means = !summary.rows.empty() && !summary.rows[0].copy_statistics.empty();  // of copies; the mean of a count needs a decimal
    for (const auto m : shown)
        columns.push_back(column_heading(measures[m])), decimals.push_back(std::max(measures[m].decimals, means ? 1 : 0));
    for (const auto& r : summary.rows) {
        Json row = {r.afferent, r.channel, r.phase};
        for (const auto m : shown) row.push_back(cell_document(r, m));
        rows.push_back(std::move(row));
    }
    return {{"columns", columns}, {"decimals", decimals}, {"rows", rows}};
}

Json quality_document(const RunSummary& summary) {
    Json messages = Json::array(), columns = {"channel"}, rows = Json::array();
    const bool several = summary.inputs.size() > 1;
    for (const auto& i : summary.inputs) {
        const auto add = [&](const std::vector<std::string>& texts, bool is_warning) {
            for (const auto& s : texts) messages.push_back({{"text", several ? i.name + ": " + s : s}, {"grave", is_warning}});
        };
        add(i.quality.warnings, true);
        add(i.quality.descriptions, false);
        for (const auto& f : i.quality.metrics) {
            if (rows.empty() || rows.back()[0] != i.channels[f.channel]) rows.push_back(Json::array({i.channels[f.channel]}));
            if (rows.size() == 1) columns.push_back(f.unit.empty() ? std::string(f.name) : fmt::format("{} ({})", f.name, f.unit));
            rows.back().push_back(json_number(f.value));
        }
    }
    return {{"notes", messages}, {"columns", columns}, {"rows", rows}};
}

}  // namespace corpuscle
