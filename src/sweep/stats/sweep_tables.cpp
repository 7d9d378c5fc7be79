#include "sweep/stats/sweep_tables.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/aligned_table.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_devices = 5;  // listed for each measure
constexpr const char* interval_heading = "95 % CI";
constexpr double min_fraction = 0.0005;  // smaller fractions of variance would print as 0.0 %

/// Formats the values of one measure: all with the same unit prefix, and with a number of decimals that follows from the standard
/// deviation.
class NumberFormat {
    double factor_ = 1;  // from the unit of the measure to unit_
    int decimals_ = 4;
    bool scientific_ = false;  // true for very large or small values whose unit takes no prefix
    bool integers_ = false;    // true: integers are printed without decimals
    std::string name_, unit_;  // of the measure; with prefix

public:
    /// `counts`: values without a unit are printed as integers if the smallest and the largest are.
    NumberFormat(const SweepColumn& column, const MeasureSummary& m, bool counts)
        : integers_(counts && column.unit.empty() && m.min == std::round(m.min) && m.max == std::round(m.max)), name_(column.name),
          unit_(column.unit) {
        const auto& unit = column.unit;
        const double size = std::max(std::abs(m.min), std::abs(m.max)),
                     typical = std::abs(m.mean.value) > 0.01 * size ? std::abs(m.mean.value) : size;
        if (!(typical > 0)) return;
        const auto text = unit.empty() ? "" : format_quantity(typical, unit);
        if (const auto blank = text.find(' '); blank != text.npos) {
            const auto prefixed = parse_unit(text.substr(blank + 1)), unprefixed = parse_unit(unit);
            if (prefixed && unprefixed) unit_ = text.substr(blank + 1), factor_ = unprefixed->factor / prefixed->factor;
        }
        const double resolution = m.sigma.value > 0 ? m.sigma.value : typical;
        decimals_ = std::clamp(2 - static_cast<int>(std::floor(std::log10(resolution * factor_))), 0, 12);
        scientific_ = typical * factor_ >= 1e7 || typical * factor_ < 1e-4;
    }
    /// The name of the measure with the unit, as a heading.
    std::string heading() const { return unit_.empty() ? name_ : fmt::format("{} ({})", name_, unit_); }
    std::string operator()(double x) const {
        if (std::isnan(x)) return "-";
        if (integers_ && !scientific_ && x == std::round(x)) return fmt::format("{:.0f}", x);
        return scientific_ ? fmt::format("{:.4g}", x * factor_) : fmt::format("{:.{}f}", x * factor_, decimals_);
    }
    std::string interval(const Estimate& e) const {
        return std::isnan(e.low) && std::isnan(e.high) ? "-" : fmt::format("{} ... {}", (*this)(e.low), (*this)(e.high));
    }
};

/// A fraction as a number in percent.
std::string percent(double fraction) { return std::isnan(fraction) ? "-" : fmt::format("{:.1f}", 100 * fraction); }
std::string percent_interval(const Estimate& e) {
    return std::isnan(e.low) ? "-" : fmt::format("{:.1f} ... {:.1f}", 100 * e.low, 100 * e.high);
}

/// The formats of all measures.
std::vector<NumberFormat> formats_of(const SweepTable& table, const SweepSummary& s, bool counts) {
    std::vector<NumberFormat> out;
    for (std::size_t m = 0; m < table.measures.size(); ++m) out.emplace_back(table.measures[m], s.all.measures[m], counts);
    return out;
}

/// Formats a table. Without values that are random, such as those of a grid, it has no columns for confidence intervals.
std::string table_text(const SweepTable& table, TableRows rows) {
    for (auto c = static_cast<std::ptrdiff_t>(rows[0].size()); c-- > 0;) {
        if (rows[0].begin()[c] != interval_heading) continue;
        const bool is_empty = std::all_of(rows.begin() + 1, rows.end(), [&](const auto& row) { return row.begin()[c] == "-"; });
        if (table.is_grid || is_empty)
            for (auto& row : rows) row.erase(row.begin() + c);
    }
    return "\n" + format_table(rows);
}

/// The pass limits of a measure, of which there is at least one.
std::string limits_of(const SweepColumn& c) {
    const auto formatted = [&](double x) { return format_quantity(x, c.unit); };
    return c.min && c.max ? fmt::format("{} ... {}", formatted(*c.min), formatted(*c.max))
           : c.min        ? "min " + formatted(*c.min)
                          : "max " + formatted(*c.max);
}

/// The first line: "chips: 1000 items, all finished; 3 diverged."
std::string opening(const SweepTable& table, const SweepSummary& s, const std::string& title) {
    const auto finished = static_cast<std::int64_t>(table.rows());
    std::string text = finished == table.item_count
                           ? fmt::format("{}: {} items, all finished", title, table.item_count)
                           : fmt::format("{}: {} of {} items are finished and analysed here", title, finished, table.item_count);
    if (s.all.iteration_limit > 0) text += fmt::format("; {} truncated (too many steps or iterations)", s.all.iteration_limit);
    if (s.all.diverged > 0) text += fmt::format("; {} diverged", s.all.diverged);
    return text + ".\n";
}

/// A table of the yield and of the yield of each measure with limits; "" for a grid of which all items passed.
std::string yields(const SweepTable& table, const SweepSummary& s) {
    if (table.is_grid && s.all.passed == s.all.items) return "";
    TableRows rows = {{"yield", "limits", "passed", "of", "%", interval_heading}};
    const auto line = [&](const std::string& name, const std::string& limits, std::int64_t passed, const Estimate& fraction) {
        rows.push_back(
            {name, limits, std::to_string(passed), std::to_string(s.all.items), percent(fraction.value), percent_interval(fraction)});
    };
    line(table.has_limits() ? "all limits" : "completed", "", s.all.passed, s.all.yield);
    for (std::size_t m = 0; m < table.measures.size(); ++m)
        if (const auto& measure_yield = s.all.measures[m].yield)
            line(table.measures[m].name, limits_of(table.measures[m]),
                 std::llround(measure_yield->value * static_cast<double>(s.all.items)), *measure_yield);
    return table_text(table, rows);
}

/// A table of the statistics of each measure over all items.
std::string measures_text(const SweepTable& table, const SweepSummary& s) {
    TableRows rows = {{"measure", "items", "mean", interval_heading, "sigma", interval_heading, "min"}};
    for (const double q : s.options.quantiles) rows[0].push_back(q == 0.5 ? "median" : fmt::format("{:g} %", 100 * q));
    for (const char* heading : {"max", "normality (r)"}) rows[0].emplace_back(heading);
    const auto formats = formats_of(table, s, false);
    for (std::size_t m = 0; m < table.measures.size(); ++m) {
        const auto& one = s.all.measures[m];
        const auto& format = formats[m];
        rows.push_back({format.heading(), std::to_string(one.count), format(one.mean.value), format.interval(one.mean),
                        format(one.sigma.value), format.interval(one.sigma), format(one.min)});
        for (std::size_t q = 0; q < s.options.quantiles.size(); ++q)
            rows.back().push_back(q < one.quantiles.size() ? format(one.quantiles[q].value) : "-");
        rows.back().push_back(format(one.max));
        rows.back().push_back(std::isnan(one.normality)
                                  ? "-"
                                  : fmt::format("{:.4f}, {}normal", one.normality, one.normality >= one.normality_floor ? "" : "not "));
    }
    return table_text(table, rows);
}

/// The mean of a measure at a point; in a sampled sweep with its standard deviation.
std::string mean_text(const MeasureSummary& m, const NumberFormat& format, bool is_grid) {
    if (m.count == 0) return "-";
    return format(m.mean.value) + (is_grid || std::isnan(m.sigma.value) ? "" : " +- " + format(m.sigma.value));
}

/// A table of the yield and the measures at each grid point.
std::string points_text(const SweepTable& table, const SweepSummary& s) {
    if (s.points.size() < 2) return "";
    const bool shows_passed = table.is_grid && table.has_limits();
    const auto formats = formats_of(table, s, table.is_grid);
    TableRows rows = {{"point"}};
    if (shows_passed) rows[0].emplace_back("passed");
    if (!table.is_grid) rows[0].insert(rows[0].end(), {"items", "yield %", interval_heading});
    for (const auto& format : formats) rows[0].push_back(format.heading());
    for (const auto& p : s.points) {
        auto& row = rows.emplace_back(1, p.label);
        if (shows_passed) row.push_back(p.items == 1 ? (p.passed ? "yes" : "no") : fmt::format("{} of {}", p.passed, p.items));
        if (!table.is_grid) row.insert(row.end(), {std::to_string(p.items), percent(p.yield.value), percent_interval(p.yield)});
        for (std::size_t m = 0; m < formats.size(); ++m) row.push_back(mean_text(p.measures[m], formats[m], table.is_grid));
    }
    const bool means = std::any_of(s.points.begin(), s.points.end(), [](const PointSummary& p) { return p.items > 1; });
    return fmt::format("\nBy grid point{}:{}",
                       !table.is_grid ? ", mean and standard deviation"
                       : means        ? ", means"
                                      : "",
                       table_text(table, rows));
}

/// The array and transistor size of a device: "4x2 of 2 x 0.5 um".
std::string array_of(const MismatchDevice& d) {
    const auto size = fmt::format("{:.4g} x {:.4g} um", 1e6 * d.W, 1e6 * d.L);
    return d.m == 1 && d.stack == 1 ? size : fmt::format("{:g}x{:g} of {}", d.m, d.stack, size);
}

/// Adds the parameters and devices on which a measure depends. Only the first line has the name of the measure.
void add_dependence(TableRows& rows, const SweepTable& table, const SweepSummary& s, const Dependence& d) {
    auto name = d.measure;
    const auto line = [&](std::vector<std::string> cells) {
        rows.push_back({name}), name.clear();
        for (auto& c : cells) rows.back().push_back(std::move(c));
    };
    for (const auto& [axis, between] : d.points) line({table.axes[axis].name, "grid axis", "", percent(between.fraction), "", "", ""});
    for (const auto& i : d.influences)
        // Devices are listed below, one line for both V_T and I_S of a device.
        if (i.device < 0 && i.influence.fraction.value >= min_fraction)
            line({i.name, "random", "", percent(i.influence.fraction.value), "", "", ""});
    for (std::size_t k = 0; k < std::min(d.devices.size(), max_devices); ++k) {
        const auto& contribution = d.devices[k];
        const auto& device =
            s.mismatch->subjects[static_cast<std::size_t>(contribution.subject)].devices[static_cast<std::size_t>(contribution.device)];
        line({device.name, array_of(device), fmt::format("{:.4g}", 1e12 * device.area()), percent(contribution.fraction()),
              percent(contribution.V_T), percent(contribution.I_S),
              d.measure == "yield" ? "" : fmt::format("{:.1f}", 100 * (relative_sigma_at_four_times_area(contribution.fraction()) - 1))});
    }
    if (d.devices.size() > max_devices) line({fmt::format("and {} more devices", d.devices.size() - max_devices), "", "", "", "", "", ""});
}

/// A table of the parameters and devices on which each measure and the yield depend.
std::string dependences_text(const SweepTable& table, const SweepSummary& s) {
    TableRows rows = {{"measure", "depends on", "size", "area (um^2)", "variance (%)", "by V_T", "by I_S", "sigma at 4x area (%)"}};
    std::vector<std::string> independent;
    std::string explained;
    for (const auto& d : s.dependences) {
        const auto before = rows.size();
        add_dependence(rows, table, s, d);
        if (rows.size() == before) independent.push_back(d.measure);
        if (!d.influences.empty())
            explained += fmt::format("{}{} {}", explained.empty() ? "" : ", ", d.measure, percent(d.sensitivity.explained));
    }
    std::string text;
    if (rows.size() > 1)
        text = fmt::format(
            "\nInfluences, in percent of a variance: for a grid axis, the total variance; for a random parameter, the variance within\n"
            "a grid point ({} chips):\n{}",
            s.analysed_chips, format_table(rows));
    if (!explained.empty())
        text += fmt::format("A linear model explains (%): {}. The rest is nonlinear, an interaction, or not significant.\n", explained);
    if (!independent.empty() && (s.mismatch || !table.axes.empty()))
        text += fmt::format("No significant influence on: {}.\n", joined(independent));
    return text;
}

/// A line that describes a sweep without random axes: "Grid of press.F_max (8 values) by sa1.f_B (4 values) ..."
std::string grid_opening(const SweepTable& table) {
    std::string axes;
    for (std::size_t a = 0; a < table.axes.size(); ++a)
        axes += fmt::format("{}{} ({} value{})", a == 0 ? "" : " by ", table.axes[a].name, table.points[a].size(),
                            table.points[a].size() == 1 ? "" : "s");
    return fmt::format("Grid of {}, without random parameters: the values are exact, not estimates.\n", axes);
}

/// The label of the grid point of the first row in which a measure (by index) has this value.
std::string point_of(const SweepTable& table, std::size_t measure, double value) {
    const auto& values = table.measure_values[measure];
    const auto at = std::find(values.begin(), values.end(), value);
    return at == values.end() ? "-" : point_label(table, static_cast<std::size_t>(at - values.begin()));
}

/// A table of the smallest and largest value of each measure, and the grid points at which they occur.
std::string grid_measures(const SweepTable& table, const SweepSummary& s) {
    TableRows rows = {{"measure", "items", "min", "at", "max", "at", "mean"}};
    const auto formats = formats_of(table, s, true);
    for (std::size_t m = 0; m < table.measures.size(); ++m) {
        const auto& one = s.all.measures[m];
        const auto at = [&](double value) { return one.min < one.max ? point_of(table, m, value) : "all"; };
        rows.push_back({formats[m].heading(), std::to_string(one.count), formats[m](one.min), at(one.min), formats[m](one.max), at(one.max),
                        formats[m](one.mean.value)});
    }
    return table_text(table, rows);
}

/// A table with the effect of every axis on each measure and on the yield.
std::string effects_text(const SweepTable& table, const SweepSummary& s) {
    TableRows rows = {{"measure", "axis", "variance (%)", "from", "mean there", "to", "mean there"}};
    const auto formats = formats_of(table, s, true);
    for (std::size_t d = 0; d < s.dependences.size(); ++d) {  // in the order of the measures; then the yield
        const auto& one = s.dependences[d];
        const bool is_yield = d >= formats.size();
        const auto mean = [&](double x) { return is_yield ? percent(x) + " %" : formats[d](x); };
        const auto name = is_yield ? one.measure : formats[d].heading();
        double rest = 1;  // fraction of the variance that no single axis explains
        for (const auto& e : one.effects) {
            const auto& axis = table.axes[e.axis];
            const auto value = [&](double x) {
                return axis.labels.empty() ? format_quantity(x, axis.unit)
                                           : axis.labels[std::min(static_cast<std::size_t>(x), axis.labels.size() - 1)];
            };
            rows.push_back({&e == &one.effects[0] ? name : "", axis.name, percent(e.fraction), value(table.points[e.axis].front()),
                            mean(e.means.front()), value(table.points[e.axis].back()), mean(e.means.back())});
            rest -= e.fraction;
        }
        if (one.effects.size() > 1 && rest >= min_fraction) rows.push_back({"", "interactions", percent(rest)});
        if (one.effects.empty()) rows.push_back({name, "none (constant)"});
    }
    return rows.size() == 1
               ? ""
               : "\nEffect of each axis: percent of the variance over the grid that is explained by the means at its values\n" +
                     format_table(rows);
}

/// A table of the requested quantiles, with confidence intervals unless the sweep is a grid.
std::string quantiles_text(const SweepTable& table, const SweepSummary& s) {
    TableRows rows = {{"quantile"}};
    for (const double q : s.options.quantiles) rows.push_back({fmt::format("{:g} %", 100 * q)});
    const auto formats = formats_of(table, s, false);
    for (std::size_t m = 0; m < formats.size(); ++m) {
        const auto& quantiles = s.all.measures[m].quantiles;
        rows[0].insert(rows[0].end(), {formats[m].heading(), interval_heading});
        for (std::size_t q = 0; q + 1 < rows.size(); ++q) {
            const auto quantile = q < quantiles.size() ? quantiles[q] : Estimate();
            rows[q + 1].insert(rows[q + 1].end(), {formats[m](quantile.value), formats[m].interval(quantile)});
        }
    }
    return table_text(table, rows);
}

}  // namespace

std::string sweep_tables(const SweepTable& table, const SweepSummary& s, const std::string& title, bool quantiles) {
    if (table.rows() == 0) return fmt::format("{}: none of {} items is finished yet.\n", title, table.item_count);
    auto text = opening(table, s, title) + (table.is_grid ? grid_opening(table) : "") + yields(table, s);
    if (!table.measures.empty()) text += table.is_grid ? grid_measures(table, s) : measures_text(table, s);
    if (!table.measures.empty() && quantiles) text += quantiles_text(table, s);
    return text + (table.is_grid ? effects_text(table, s) + points_text(table, s) : points_text(table, s) + dependences_text(table, s));
}

}  // namespace corpuscle
