#include "report/sweep/sweep_page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "report/page_template.hpp"
#include "sweep/spec/mismatch_samples.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_points = 1500;  // items in a scatter plot
constexpr std::size_t max_rasters = 800;  // items in a raster
constexpr std::size_t max_traces = 1000;  // items in a trace envelope
constexpr std::size_t max_grid = 20000;   // items of a grid that the page has completely, so that it can show any part of the grid
constexpr std::size_t max_failed = 200;   // items in the table of failed items
constexpr std::size_t max_extremes = 8;   // items listed with the smallest values of a measure, and with the largest
constexpr std::size_t max_scatters = 4;   // scatter plots per measure

/// The data of those rows of the sweep's table that the page's plots and tables refer to. Every array of the result has one element for
/// each of them.
Json rows_document(const SweepTable& table, const std::set<std::size_t>& rows, const std::vector<Grouping>& groupings) {
    Json out = {{"row", rows},           {"item", Json::array()},     {"end", Json::array()},   {"passes", Json::array()},
                {"axes", Json::array()}, {"measures", Json::array()}, {"groups", Json::array()}};
    const auto column = [&](const std::vector<double>& all) {
        std::vector<double> selected;
        for (const auto row : rows) selected.push_back(all[row]);
        return plot_numbers(selected);
    };
    for (const auto row : rows) {
        out["item"].push_back(table.items[row]), out["end"].push_back(static_cast<int>(table.ends[row]));
        out["passes"].push_back(table.passes(row) ? 1 : 0);
    }
    for (const auto& a : table.axis_values) out["axes"].push_back(column(a));
    for (const auto& m : table.measure_values) out["measures"].push_back(column(m));
    for (const auto& g : groupings) {
        out["groups"].push_back(Json::array());
        for (const auto row : rows) out["groups"].back().push_back(g.row_groups.group_of[row]);
    }
    return out;
}

/// The rows with the smallest values of a measure (the smallest first), then those with the largest (the largest first).
std::vector<std::size_t> extremes_of(const std::vector<double>& values) {
    std::vector<std::size_t> rows;
    for (std::size_t r = 0; r < values.size(); ++r)
        if (std::isfinite(values[r])) rows.push_back(r);
    const auto count = std::min(rows.size(), 2 * max_extremes), half = count / 2;
    const auto less = [&](std::size_t a, std::size_t b) { return std::pair(values[a], a) < std::pair(values[b], b); };
    std::partial_sort(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count - half), rows.end(), less);
    std::vector<std::size_t> out(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count - half));
    rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count - half));
    std::partial_sort(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(half), rows.end(),
                      [&](auto a, auto b) { return less(b, a); });
    out.insert(out.end(), rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(half));
    return out;
}

/// The quantity on the x axis of a scatter plot: the index of an axis of the sweep, or a device's mismatch of V_T (V) or I_S (%) for each
/// of `rows`. "fraction" is the fraction of the measure's variance that it explains.
Json factor_document(const SweepTable& table, const SweepSummary& s, const NamedInfluence& i, const std::vector<std::size_t>& rows) {
    Json out = {{"name", i.name}, {"quantity", i.quantity}, {"fraction", i.influence.fraction.value}};
    if (i.device < 0) {
        out["axis"] = i.axis, out["unit"] = table.axes[static_cast<std::size_t>(i.axis)].unit;
        return out;
    }
    const auto& device = s.mismatch->subjects[static_cast<std::size_t>(i.subject)].devices[static_cast<std::size_t>(i.device)];
    std::vector<std::uint64_t> chips;
    for (const auto r : rows) chips.push_back(s.mismatch->chip(table.items[r]));
    auto deviates = deviates_of(device, s.mismatch->seed, chips);
    auto& values = i.quantity == "V_T" ? deviates.V_T : deviates.I_S;
    for (auto& x : values) x *= i.quantity == "V_T" ? device.sigma_VT : 100 * device.sigma_IS;
    out["unit"] = i.quantity == "V_T" ? "V" : "%", out["values"] = plot_numbers(values);
    return out;
}

/// For each measure: the factors of its scatter plots. `points`: the plotted rows.
Json factors_document(const SweepTable& table, const SweepSummary& s, const std::vector<std::size_t>& points) {
    Json out = Json::array();
    for (const auto& d : s.dependences) {
        if (d.measure == "yield") break;  // the yield is not a measure; it comes last
        out.push_back(Json::array());
        for (const auto& [axis, between] : d.points)
            out.back().push_back({{"name", table.axes[axis].name},
                                  {"quantity", ""},
                                  {"fraction", between.fraction},
                                  {"axis", axis},
                                  {"unit", table.axes[axis].unit}});
        for (const auto& i : d.influences)
            if (out.back().size() < max_scatters && i.influence.fraction.value > 0)
                out.back().push_back(factor_document(table, s, i, points));
    }
    return out;
}

Json matrix_of(const std::vector<std::vector<double>>& rows) {
    Json out = Json::array();
    for (const auto& row : rows) out.push_back(plot_numbers(row));
    return out;
}

/// For each measure of a grid: the effect of each axis, and the mean at each pair of values of two of the six most influential axes. The
/// page needs these means only if it has not all items.
Json grids_document(const SweepTable& table) {
    constexpr std::size_t max_axes = 6, max_cells = 40'000;
    Json out = Json::array();
    for (const auto& values : table.measure_values) {
        const auto effects = axis_effects(table, values);
        Json one = {{"effects", Json::array()}, {"pairs", Json::array()}};
        for (const auto& e : effects)
            one["effects"].push_back({{"axis", e.axis},
                                      {"fraction", e.fraction},
                                      {"values", plot_numbers(table.points[e.axis])},
                                      {"means", plot_numbers(e.means)}});
        for (std::size_t a = 0; a < std::min(effects.size(), max_axes); ++a)
            for (std::size_t b = a + 1; b < std::min(effects.size(), max_axes); ++b) {
                const auto x = effects[a].axis, y = effects[b].axis;
                if (table.points[x].size() * table.points[y].size() > max_cells) continue;
                one["pairs"].push_back({{"x", x},
                                        {"y", y},
                                        {"xs", plot_numbers(table.points[x])},
                                        {"ys", plot_numbers(table.points[y])},
                                        {"means", matrix_of(means_over(table, values, x, y))}});
            }
        out.push_back(std::move(one));
    }
    return out;
}

/// The first rows that do not pass.
std::vector<std::size_t> failed_rows(const SweepTable& table) {
    std::vector<std::size_t> out;
    for (std::size_t r = 0; r < table.rows() && out.size() < max_failed; ++r)
        if (!table.passes(r)) out.push_back(r);
    return out;
}

/// The size of each listed device as text: columns x rows of elements, W x L.
Json sizes_document(const SweepSummary& s) {
    Json out = Json::object();
    if (!s.mismatch) return out;
    for (const auto& d : s.dependences)
        for (const auto& contribution : d.devices) {
            const auto& device =
                s.mismatch->subjects[static_cast<std::size_t>(contribution.subject)].devices[static_cast<std::size_t>(contribution.device)];
            out[device.name] = fmt::format("{:g}x{:g} of {:.4g} x {:.4g} um", device.m, device.stack, 1e6 * device.W, 1e6 * device.L);
        }
    return out;
}

}  // namespace

Result<std::string> sweep_page(const SweepResults& results, const SweepTable& table, const SweepSummary& summary, const std::string& title,
                               const std::string& command) {
    const auto groupings = groupings_of(table);
    Json page = {{"summary", document_of(table, summary, title)}, {"versions", versions_document()}};
    page["groupings"] = Json::array();
    for (const auto& g : groupings) {
        Json labels = Json::array();
        for (const auto& one : g.row_groups.groups) labels.push_back(one.label.empty() ? "all items" : one.label);
        page["groupings"].push_back({{"name", g.name}, {"groups", labels}});
    }
    if (const auto samples = parse_mismatch_samples(results.about(mismatch_metadata_name)))
        page["single_chip_hint"] = fmt::format(
            "To simulate one chip: corpuscle respond or run with the settings of the sweep and --mismatch {}/CHIP; CHIP is the number of "
            "the item{}.",
            samples->seed, samples->chips > 0 ? fmt::format(" modulo {}", samples->chips) : "");
    if (table.is_grid) page["grids"] = grids_document(table);
    page["histograms"] = Json::array(), page["normal_plots"] = Json::array(), page["extremes"] = Json::array();
    std::set<std::size_t> shown;  // rows of the sweep's table
    for (const auto& values : table.measure_values) {
        page["histograms"].push_back(Json::array()), page["normal_plots"].push_back(Json::array());
        for (const auto& g : groupings) {
            page["histograms"].back().push_back(histograms(values, g.row_groups));
            page["normal_plots"].back().push_back(normal_plots(values, g.row_groups));
        }
        const auto extremes = extremes_of(values);
        page["extremes"].push_back(extremes);
        shown.insert(extremes.begin(), extremes.end());
    }
    const auto points = thinned_rows(table.rows(), max_points), chips = thinned_rows(table.rows(), max_rasters);
    const auto traced = thinned_rows(table.rows(), max_traces), failed = failed_rows(table);
    page["rasters"] = Json::array(), page["traces"] = Json::array();
    for (std::size_t t = 0; t < std::min<std::size_t>(results.train_names.size(), 4); ++t) {
        auto raster = TRY(rasters(results, t, table, chips));
        page["rasters"].push_back(std::move(raster));
    }
    for (std::size_t t = 0; t < std::min<std::size_t>(results.probe_names.size(), 8); ++t) {
        auto one = TRY(envelopes(results, t, table, traced, groupings));
        page["traces"].push_back(std::move(one));
    }
    const auto diverged = TRY(failed_items(results, max_failed));
    page["reasons"] = Json::object();
    for (const auto& failure : diverged) page["reasons"][fmt::format("{}", failure.item)] = failure.reason;
    for (const auto* rows : {&points, &chips, &failed}) shown.insert(rows->begin(), rows->end());
    if ((table.is_grid || table.varies_by_list()) && table.rows() <= max_grid)  // for means over the listed axes
        for (std::size_t r = 0; r < table.rows(); ++r) shown.insert(r);
    page["points"] = points, page["failed"] = failed;
    page["factors"] = factors_document(table, summary, points);
    page["sizes"] = sizes_document(summary);
    page["rows"] = rows_document(table, shown, groupings);
    return report_page("sweep", title, command, page);
}

}  // namespace corpuscle
