#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "signal/parameter.hpp"
#include "signal/quantity.hpp"
#include "study/sweep/grid.hpp"
#include "study/sweep/sweep_summary.hpp"

namespace corpuscle {
namespace {

/// For each row the index of its part of an axis, and the labels of the parts.
struct AxisParts {
    std::vector<std::size_t> part;
    std::vector<std::string> labels;
};

std::string value_label(const SweepColumn& axis, double value) {
    const bool word = !axis.labels.empty() && value >= 0 && value < static_cast<double>(axis.labels.size());
    return word ? axis.labels[static_cast<std::size_t>(value)] : format_quantity(value, axis.unit);
}

AxisParts points_of(const SweepColumn& axis, const std::vector<double>& all, const std::vector<double>& values) {
    AxisParts out;
    out.part.reserve(all.size());
    for (const double x : all)
        out.part.push_back(!out.part.empty() && out.part.back() < values.size() && values[out.part.back()] == x ? out.part.back()
                           : std::isnan(x)                                                                      ? values.size()
                                           : static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), x) - values.begin()));
    for (const double x : values) out.labels.push_back(fmt::format("{} = {}", axis.name, value_label(axis, x)));
    out.labels.push_back(axis.name + " = none");
    return out;
}

AxisParts bands_of(const SweepColumn& axis, const std::vector<double>& all) {
    auto sorted = all;
    std::erase_if(sorted, [](double x) { return std::isnan(x); });
    if (sorted.empty()) return {std::vector<std::size_t>(all.size()), {axis.name + " = none"}};
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> edges;  // the first value of each band except the first
    for (std::size_t b = 1; b < SweepGroups::bands; ++b) edges.push_back(sorted[b * sorted.size() / SweepGroups::bands]);
    AxisParts out;
    for (const double x : all)
        out.part.push_back(static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), x) - edges.begin()));
    for (std::size_t b = 0; b < SweepGroups::bands; ++b)
        out.labels.push_back(fmt::format("{} {} ... {}", axis.name, format_quantity(b == 0 ? sorted.front() : edges[b - 1], axis.unit),
                                         format_quantity(b + 1 == SweepGroups::bands ? sorted.back() : edges[b], axis.unit)));
    return out;
}

AxisParts parts_of_axis(const SweepTable& table, std::size_t axis) {
    const auto& all = table.axis_values[axis];
    return table.has_points(axis) ? points_of(table.axes[axis], all, table.points[axis]) : bands_of(table.axes[axis], all);
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
    std::vector<AxisParts> parts;
    for (const auto a : axes) parts.push_back(parts_of_axis(table, a));
    std::vector<std::size_t> key(table.rows());
    for (const auto& p : parts)
        for (std::size_t r = 0; r < key.size(); ++r) key[r] = key[r] * p.labels.size() + p.part[r];
    std::map<std::size_t, std::size_t> number;  // index of each combination that occurs
    for (std::size_t r = 0; r < key.size(); ++r)
        if (r == 0 || key[r] != key[r - 1]) number[key[r]] = 0;
    for (auto& [k, n] : number) {
        n = out.groups.size();
        std::string label;
        auto rest = k;
        for (auto p = parts.rbegin(); p != parts.rend(); ++p) {
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
            return bad_usage(known.empty() ? fmt::format("--by {}: this sweep has no axis with values", name)
                                           : fmt::format("--by {}: unknown axis{} (known: {})", name, did_you_mean(name, known),
                                                         fmt::join(known, ", ")));
        axes.push_back(static_cast<std::size_t>(at - known.begin()));
    }
    if (!by.empty()) return group_rows_by_axes(table, axes);
    for (std::size_t a = 0; a < known.size(); ++a)
        if (table.points[a].size() > 1) axes.push_back(a);
    auto out = group_rows_by_axes(table, axes);
    return out.groups.size() <= SweepGroups::max_groups ? out : group_rows_by_axes(table, {});
}

}  // namespace corpuscle
