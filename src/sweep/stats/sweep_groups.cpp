// The rows of a sweep, grouped by the values of axes, and the effects of these values on a measure.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "sweep/stats/sweep_summary.hpp"

namespace corpuscle {
namespace {

/// The rows of a table, grouped by one axis.
struct AxisGroups {
    std::vector<std::size_t> group_of;  // for each row, the index of its group
    std::vector<std::string> labels;    // of the groups
};

/// The label of a value, or the value with its unit.
std::string value_label(const SweepColumn& axis, double value) {
    const bool is_label = !axis.labels.empty() && value >= 0 && value < static_cast<double>(axis.labels.size());
    return is_label ? axis.labels[static_cast<std::size_t>(value)] : format_quantity(value, axis.unit);
}

/// One group for each point of an axis, and one for rows without a value.
AxisGroups points_of(const SweepTable& table, std::size_t index) {
    const auto& axis = table.axes[index];
    const auto &all = table.axis_values[index], &values = table.points[index];
    AxisGroups out;
    out.group_of.reserve(all.size());
    for (const double x : all)
        out.group_of.push_back(
            !out.group_of.empty() && out.group_of.back() < values.size() && values[out.group_of.back()] == x ? out.group_of.back()
            : std::isnan(x)                                                                                  ? values.size()
                            : static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), x) - values.begin()));
    for (const double x : values) out.labels.push_back(fmt::format("{} = {}", axis.name, value_label(axis, x)));
    out.labels.push_back(axis.name + " = none");
    return out;
}

/// Bands with about equal numbers of rows. Rows without a value are in the last band.
AxisGroups bands_of(const SweepTable& table, std::size_t index) {
    const auto& axis = table.axes[index];
    const auto& all = table.axis_values[index];
    auto sorted = all;
    std::erase_if(sorted, [](double x) { return std::isnan(x); });
    if (sorted.empty()) return {std::vector<std::size_t>(all.size()), {axis.name + " = none"}};
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> edges;  // the first value of each band except the first
    for (std::size_t b = 1; b < SweepGroups::bands; ++b) edges.push_back(sorted[b * sorted.size() / SweepGroups::bands]);
    AxisGroups out;
    for (const double x : all)
        out.group_of.push_back(static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), x) - edges.begin()));
    for (std::size_t b = 0; b < SweepGroups::bands; ++b)
        out.labels.push_back(fmt::format("{} {} ... {}", axis.name, format_quantity(b == 0 ? sorted.front() : edges[b - 1], axis.unit),
                                         format_quantity(b + 1 == SweepGroups::bands ? sorted.back() : edges[b], axis.unit)));
    return out;
}

}  // namespace

std::string point_label(const SweepTable& table, std::size_t row) {
    std::string out;
    for (std::size_t a = 0; a < table.axes.size(); ++a) {
        const double x = table.axis_values[a][row];
        out += fmt::format("{}{} = {}", a == 0 ? "" : ", ", table.axes[a].name, std::isnan(x) ? "none" : value_label(table.axes[a], x));
    }
    return out;
}

SweepGroups group_rows_by_axes(const SweepTable& table, const std::vector<std::size_t>& axes) {
    SweepGroups out;
    out.axes = axes;
    if (table.rows() == 0) return out;
    std::vector<AxisGroups> axis_groups;
    for (const auto a : axes) axis_groups.push_back(table.has_points(a) ? points_of(table, a) : bands_of(table, a));
    std::vector<std::size_t> key(table.rows());  // of each row: its combination of groups, as one number
    for (const auto& p : axis_groups)
        for (std::size_t r = 0; r < key.size(); ++r) key[r] = key[r] * p.labels.size() + p.group_of[r];
    std::map<std::size_t, std::size_t> number;  // by key: index in out.groups, for each combination that occurs
    for (std::size_t r = 0; r < key.size(); ++r)
        if (r == 0 || key[r] != key[r - 1]) number[key[r]] = 0;
    for (auto& [k, n] : number) {
        n = out.groups.size();
        std::string label;
        auto rest = k;
        for (auto p = axis_groups.rbegin(); p != axis_groups.rend(); ++p) {
            label = p->labels[rest % p->labels.size()] + (label.empty() ? "" : ", ") + label;
            rest /= p->labels.size();
        }
        out.groups.push_back({label, {}});
    }
    for (std::size_t r = 0; r < key.size(); ++r)
        out.group_of.push_back(r > 0 && key[r] == key[r - 1] ? out.group_of.back() : number[key[r]]);
    for (std::size_t r = 0; r < out.group_of.size(); ++r) out.groups[out.group_of[r]].rows.push_back(r);
    return out;
}

Result<SweepGroups> group_rows(const SweepTable& table, const std::vector<std::string>& by) {
    std::vector<std::size_t> axes;
    std::vector<std::string_view> known;
    for (const auto& a : table.axes) known.push_back(a.name);
    for (const auto& name : by) {
        const auto at = std::find(known.begin(), known.end(), name);
        if (at == known.end())
            return bad_usage(known.empty()
                                 ? fmt::format("--by {}: this sweep has no axis with values", name)
                                 : fmt::format("--by {}: unknown axis{} (known: {})", name, did_you_mean(name, known), joined(known)));
        axes.push_back(static_cast<std::size_t>(at - known.begin()));
    }
    if (!by.empty()) return group_rows_by_axes(table, axes);
    for (std::size_t a = 0; a < known.size(); ++a)
        if (table.points[a].size() > 1) axes.push_back(a);
    auto out = group_rows_by_axes(table, axes);
    return out.groups.size() <= SweepGroups::max_groups ? out : group_rows_by_axes(table, {});
}

std::vector<AxisEffect> axis_effects(const SweepTable& table, const std::vector<double>& measure) {
    double sum = 0, count = 0, squares = 0;
    for (const double x : measure)
        if (std::isfinite(x)) sum += x, ++count;
    for (const double x : measure)
        if (std::isfinite(x)) squares += (x - sum / count) * (x - sum / count);
    std::vector<AxisEffect> out;
    if (!(squares > 0)) return out;
    for (std::size_t a = 0; a < table.axes.size(); ++a) {
        if (table.points[a].size() < 2) continue;
        const auto points = group_means(measure, points_of(table, a).group_of, table.points[a].size());
        AxisEffect effect{a, 0, points.means};
        for (std::size_t k = 0; k < points.means.size(); ++k) {
            const double deviation = points.counts[k] > 0 ? points.means[k] - sum / count : 0;
            effect.fraction += points.counts[k] * deviation * deviation / squares;
        }
        out.push_back(std::move(effect));
    }
    std::sort(out.begin(), out.end(),
              [](const AxisEffect& x, const AxisEffect& y) { return std::pair(-x.fraction, x.axis) < std::pair(-y.fraction, y.axis); });
    return out;
}

std::vector<std::vector<double>> means_over(const SweepTable& table, const std::vector<double>& measure, std::size_t a, std::size_t b) {
    const auto rows = table.points[a].size(), columns = table.points[b].size();
    auto cells = points_of(table, a).group_of;  // of each row of the table: row * columns + column
    const auto column_of = points_of(table, b).group_of;
    for (std::size_t r = 0; r < cells.size(); ++r) cells[r] = column_of[r] < columns ? cells[r] * columns + column_of[r] : rows * columns;
    const auto means = group_means(measure, cells, rows * columns).means;
    std::vector<std::vector<double>> out;
    for (auto row = means.begin(); row != means.end(); row += static_cast<std::ptrdiff_t>(columns))
        out.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
    return out;
}

}  // namespace corpuscle
