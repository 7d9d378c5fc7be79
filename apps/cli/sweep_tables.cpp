#include "sweep_tables.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "signal/quantity.hpp"
#include "terminal.hpp"

namespace corpuscle {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t most_devices = 5;
constexpr double least_told = 0.0005;  // of shares: less reads 0.0 %

/// How the numbers of one measure are written: all with the same prefix, as finely as its deviation asks for.
class Writing {
    double factor_ = 1;
    int decimals_ = 4;
    bool far_ = false;    // from 1, without a unit that could take a prefix
    bool whole_ = false;  // whole numbers stand without decimals
    std::string unit_;

public:
    Writing(const std::string& unit, const MeasureSummary& m, bool counts = false)
        : whole_(counts && unit.empty() && m.least == std::round(m.least) && m.greatest == std::round(m.greatest)), unit_(unit) {
        const double size = std::max(std::abs(m.least), std::abs(m.greatest)),
                     typical = std::abs(m.mean.value) > 0.01 * size ? std::abs(m.mean.value) : size;
        if (!(typical > 0)) return;
        const auto text = unit.empty() ? "" : format_quantity(typical, unit);
        if (const auto blank = text.find(' '); blank != text.npos) {
            const auto with = parse_unit(text.substr(blank + 1)), without = parse_unit(unit);
            if (with && without) unit_ = text.substr(blank + 1), factor_ = without->factor / with->factor;
        }
        const double fine = m.sigma.value > 0 ? m.sigma.value : typical;
        decimals_ = std::clamp(2 - static_cast<int>(std::floor(std::log10(fine * factor_))), 0, 12);
        far_ = typical * factor_ >= 1e7 || typical * factor_ < 1e-4;
    }
    const std::string& unit() const { return unit_; }
    std::string operator()(double x) const {
        if (std::isnan(x)) return "-";
        if (whole_ && !far_ && x == std::round(x)) return fmt::format("{:.0f}", x);
        return far_ ? fmt::format("{:.4g}", x * factor_) : fmt::format("{:.{}f}", x * factor_, decimals_);
    }
    std::string interval(const Estimate& e) const {
        return std::isnan(e.low) && std::isnan(e.high) ? "-" : fmt::format("{} ... {}", (*this)(e.low), (*this)(e.high));
    }
};

std::string percent(double share) { return std::isnan(share) ? "-" : fmt::format("{:.1f}", 100 * share); }
std::string percent_interval(const Estimate& e) {
    return std::isnan(e.low) ? "-" : fmt::format("{:.1f} ... {:.1f}", 100 * e.low, 100 * e.high);
}

std::string named(const SweepColumn& c, const std::string& unit) { return unit.empty() ? c.name : fmt::format("{} ({})", c.name, unit); }

std::string limits_of(const SweepColumn& c) {
    const auto shown = [&](double x) { return format_quantity(x, c.unit); };
    return c.at_least && c.at_most ? fmt::format("{} ... {}", shown(*c.at_least), shown(*c.at_most))
           : c.at_least            ? "at least " + shown(*c.at_least)
                                   : "at most " + shown(*c.at_most);
}

std::string opening(const SweepTable& from, const SweepSummary& s, const std::string& title) {
    const auto finished = static_cast<std::int64_t>(from.rows());
    std::string text = finished == from.units
                           ? fmt::format("{}: {} units, all finished", title, from.units)
                           : fmt::format("{}: {} of {} units are finished, of which this is", title, finished, from.units);
    if (s.all.capped > 0) text += fmt::format("; {} stopped, too costly", s.all.capped);
    if (s.all.lost > 0) text += fmt::format("; {} lost, not converged", s.all.lost);
    return text + ".\n";
}

std::string yields(const SweepTable& from, const SweepSummary& s) {
    Rows rows = {{"yield", "limits", "passed", "of", "%", "95 % confidence"}};
    const auto line = [&](const std::string& name, const std::string& limits, std::int64_t passed, const Estimate& share) {
        rows.push_back(
            {name, limits, fmt::format("{}", passed), fmt::format("{}", s.all.units), percent(share.value), percent_interval(share)});
    };
    line(from.has_limits() ? "all limits" : "ended", "", s.all.passed, s.all.yield);
    for (std::size_t m = 0; m < from.measures.size(); ++m)
        if (const auto& own = s.all.measures[m].yield)
            line(from.measures[m].name, limits_of(from.measures[m]), std::llround(own->value * static_cast<double>(s.all.units)), *own);
    return "\n" + table(rows);
}

std::string measures_text(const SweepTable& from, const SweepSummary& s) {
    Rows rows = {{"measure", "units", "mean", "95 %", "sigma", "95 %", "least"}};
    for (const double q : s.question.quantiles) rows[0].push_back(q == 0.5 ? "median" : fmt::format("{:g} %", 100 * q));
    for (const char* last : {"most", "normal plot"}) rows[0].emplace_back(last);
    for (std::size_t m = 0; m < from.measures.size(); ++m) {
        const auto& one = s.all.measures[m];
        const Writing shown(from.measures[m].unit, one);
        rows.push_back({named(from.measures[m], shown.unit()), fmt::format("{}", one.count), shown(one.mean.value),
                        shown.interval(one.mean), shown(one.sigma.value), shown.interval(one.sigma), shown(one.least)});
        for (std::size_t q = 0; q < s.question.quantiles.size(); ++q)
            rows.back().push_back(q < one.quantiles.size() ? shown(one.quantiles[q].value) : "-");
        rows.back().push_back(shown(one.greatest));
        rows.back().push_back(std::isnan(one.normality)              ? "-"
                              : one.normality >= one.normality_floor ? fmt::format("{:.4f}, normal", one.normality)
                                                                     : fmt::format("{:.4f}, not normal", one.normality));
    }
    return "\n" + table(rows);
}

std::string points_text(const SweepTable& from, const SweepSummary& s) {
    if (s.points.size() < 2) return "";
    Rows rows = {{"point", "units", "yield %", "95 %"}};
    std::vector<Writing> shown;
    for (std::size_t m = 0; m < from.measures.size(); ++m) {
        shown.emplace_back(from.measures[m].unit, s.all.measures[m]);
        rows[0].push_back(named(from.measures[m], shown.back().unit()));
    }
    for (const auto& p : s.points) {
        rows.push_back({p.label, fmt::format("{}", p.units), percent(p.yield.value), percent_interval(p.yield)});
        for (std::size_t m = 0; m < from.measures.size(); ++m) {
            const auto& one = p.measures[m];
            rows.back().push_back(one.count == 0 ? "-"
                                  : std::isnan(one.sigma.value)
                                      ? shown[m](one.mean.value)
                                      : fmt::format("{} +- {}", shown[m](one.mean.value), shown[m](one.sigma.value)));
        }
    }
    return fmt::format("\nPoint by point, mean and deviation:\n{}", table(rows));
}

/// "4x2 of 2 x 0.5 um".
std::string array_of(const DrawnDevice& d) {
    const auto size = fmt::format("{:.4g} x {:.4g} um", 1e6 * d.W, 1e6 * d.L);
    return d.m == 1 && d.stack == 1 ? size : fmt::format("{:g}x{:g} of {}", d.m, d.stack, size);
}

void put_dependence(Rows& rows, const SweepTable& from, const SweepSummary& s, const Dependence& d) {
    auto name = d.measure;
    const auto line = [&](std::vector<std::string> cells) {
        rows.push_back({name}), name.clear();
        for (auto& c : cells) rows.back().push_back(std::move(c));
    };
    for (const auto& [axis, between] : d.points) line({from.axes[axis].name, "point of the grid", "", percent(between.share), "", "", ""});
    for (const auto& i : d.influences)
        if (i.device < 0 && i.found.share.value >= least_told) line({i.name, "drawn", "", percent(i.found.share.value), "", "", ""});
    for (std::size_t k = 0; k < std::min(d.devices.size(), most_devices); ++k) {
        const auto& share = d.devices[k];
        const auto& device = s.drawn->subjects[static_cast<std::size_t>(share.subject)].devices[static_cast<std::size_t>(share.device)];
        line({device.name, array_of(device), fmt::format("{:.4g}", 1e12 * device.area()), percent(share.share()), percent(share.V_T),
              percent(share.I_S),
              d.measure == "yield" ? "" : fmt::format("{:.1f}", 100 * (sigma_with_four_times_the_area(share.share()) - 1))});
    }
    if (d.devices.size() > most_devices)
        line({fmt::format("and {} devices more", d.devices.size() - most_devices), "", "", "", "", "", ""});
}

std::string dependences_text(const SweepTable& from, const SweepSummary& s) {
    Rows rows = {{"measure", "depends on", "size", "area (um^2)", "share (%)", "of V_T", "of I_S", "sigma with 4x the area (%)"}};
    std::vector<std::string> nothing;
    std::string bent;
    for (const auto& d : s.dependences) {
        const auto before = rows.size();
        put_dependence(rows, from, s, d);
        if (rows.size() == before) nothing.push_back(d.measure);
        if (!d.influences.empty()) bent += fmt::format("{}{} {}", bent.empty() ? "" : ", ", d.measure, percent(d.all.explained));
    }
    std::string text;
    if (rows.size() > 1)
        text = fmt::format(
            "\nWhat matters, as a share of the variance (of the grid: of all; of what is drawn: between the chips of a point, "
            "of {} chips):\n{}",
            s.chips, table(rows));
    if (!bent.empty())
        text += fmt::format("Straight lines explain (%): {}; the rest is bent, joint, or too small to tell from chance.\n", bent);
    if (!nothing.empty() && (s.drawn || !from.axes.empty()))
        text += fmt::format("Nothing that was varied stands out of chance for: {}.\n", fmt::join(nothing, ", "));
    return text;
}

/// "a grid of press.F_max (8) by sa1.f_B (4); nothing is drawn".
std::string grid_opening(const SweepTable& from) {
    std::string axes;
    for (std::size_t a = 0; a < from.axes.size(); ++a)
        axes += fmt::format("{}{} ({} value{})", a == 0 ? "" : " by ", from.axes[a].name, from.points[a].size(),
                            from.points[a].size() == 1 ? "" : "s");
    return fmt::format("A grid of {}; nothing is drawn by chance, so these are all there is.\n", axes);
}

std::string grid_yields(const SweepTable& from, const SweepSummary& s) {
    if (s.all.passed == s.all.units) return "";
    Rows rows = {{"yield", "limits", "passed", "of", "%"}};
    const auto line = [&](const std::string& name, const std::string& limits, std::int64_t passed, double share) {
        rows.push_back({name, limits, fmt::format("{}", passed), fmt::format("{}", s.all.units), percent(share)});
    };
    line(from.has_limits() ? "all limits" : "ended", "", s.all.passed, s.all.yield.value);
    for (std::size_t m = 0; m < from.measures.size(); ++m)
        if (const auto& own = s.all.measures[m].yield)
            line(from.measures[m].name, limits_of(from.measures[m]), std::llround(own->value * static_cast<double>(s.all.units)),
                 own->value);
    return "\n" + table(rows);
}

/// The row at which a measure is this; of several the first.
std::string where_it_is(const SweepTable& from, std::size_t measure, double value) {
    const auto& values = from.measure_values[measure];
    const auto at = std::find(values.begin(), values.end(), value);
    return at == values.end() ? "-" : point_label(from, static_cast<std::size_t>(at - values.begin()));
}

std::string grid_measures(const SweepTable& from, const SweepSummary& s) {
    Rows rows = {{"measure", "units", "least", "at", "most", "at", "mean"}};
    for (std::size_t m = 0; m < from.measures.size(); ++m) {
        const auto& one = s.all.measures[m];
        const Writing shown(from.measures[m].unit, one, true);
        const bool varies = one.least < one.greatest;
        rows.push_back({named(from.measures[m], shown.unit()), fmt::format("{}", one.count), shown(one.least),
                        varies ? where_it_is(from, m, one.least) : "all", shown(one.greatest),
                        varies ? where_it_is(from, m, one.greatest) : "all", shown(one.mean.value)});
    }
    return "\n" + table(rows);
}

/// The effect of every axis on each measure.
std::string effects_text(const SweepTable& from, const SweepSummary& s) {
    Rows rows = {{"measure", "axis", "share (%)", "from", "mean there", "to", "mean there"}};
    for (std::size_t d = 0; d < s.dependences.size(); ++d) {
        const auto& one = s.dependences[d];
        const bool is_yield = d >= from.measures.size();
        const Writing shown(is_yield ? "" : from.measures[d].unit, is_yield ? MeasureSummary{} : s.all.measures[d], true);
        const auto mean = [&](double x) { return is_yield ? percent(x) + " %" : shown(x); };
        const auto name = is_yield ? one.measure : named(from.measures[d], shown.unit());
        double rest = 1;
        for (const auto& e : one.effects) {
            const auto& axis = from.axes[e.axis];
            const auto value = [&](double x) {
                return axis.words.empty() ? format_quantity(x, axis.unit)
                                          : axis.words[std::min(static_cast<std::size_t>(x), axis.words.size() - 1)];
            };
            rows.push_back({&e == &one.effects[0] ? name : "", axis.name, percent(e.share), value(from.points[e.axis].front()),
                            mean(e.means.front()), value(from.points[e.axis].back()), mean(e.means.back())});
            rest -= e.share;
        }
        if (one.effects.size() > 1 && rest >= least_told) rows.push_back({"", "jointly", percent(rest)});
        if (one.effects.empty()) rows.push_back({name, "none: it is the same everywhere"});
    }
    return rows.size() == 1
               ? ""
               : "\nWhat each axis does: the share of the variance over the grid that lies between the means at its values\n" + table(rows);
}

std::string grid_points(const SweepTable& from, const SweepSummary& s) {
    if (s.points.size() < 2) return "";
    Rows rows = {{"point"}};
    const bool limits = from.has_limits();
    if (limits) rows[0].emplace_back("passed");
    std::vector<Writing> shown;
    for (std::size_t m = 0; m < from.measures.size(); ++m) {
        shown.emplace_back(from.measures[m].unit, s.all.measures[m], true);
        rows[0].push_back(named(from.measures[m], shown.back().unit()));
    }
    for (const auto& p : s.points) {
        rows.push_back({p.label});
        if (limits) rows.back().push_back(p.units == 1 ? (p.passed ? "yes" : "no") : fmt::format("{} of {}", p.passed, p.units));
        for (std::size_t m = 0; m < from.measures.size(); ++m)
            rows.back().push_back(p.measures[m].count == 0 ? "-" : shown[m](p.measures[m].mean.value));
    }
    const bool means = std::any_of(s.points.begin(), s.points.end(), [](const PointSummary& p) { return p.units > 1; });
    return fmt::format("\nPoint by point{}:\n{}", means ? ", means" : "", table(rows));
}

/// The quantiles that were asked for, with their intervals; a grid's have none.
std::string quantiles_text(const SweepTable& from, const SweepSummary& s) {
    Rows rows = {{"quantile"}};
    for (std::size_t m = 0; m < from.measures.size(); ++m) {
        const Writing shown(from.measures[m].unit, s.all.measures[m]);
        rows[0].push_back(named(from.measures[m], shown.unit()));
        if (!from.is_grid) rows[0].push_back("95 %");
        for (std::size_t q = 0; q < s.question.quantiles.size(); ++q) {
            if (m == 0) rows.push_back({fmt::format("{:g} %", 100 * s.question.quantiles[q])});
            const auto& all = s.all.measures[m].quantiles;
            rows[q + 1].push_back(q < all.size() ? shown(all[q].value) : "-");
            if (!from.is_grid) rows[q + 1].push_back(q < all.size() ? shown.interval(all[q]) : "-");
        }
    }
    return "\n" + table(rows);
}

}  // namespace

std::string sweep_tables(const SweepTable& from, const SweepSummary& s, const std::string& title, bool quantiles) {
    if (from.rows() == 0) return fmt::format("{}: none of {} units is finished yet.\n", title, from.units);
    if (from.is_grid) {
        auto text = opening(from, s, title) + grid_opening(from) + grid_yields(from, s);
        if (!from.measures.empty()) text += grid_measures(from, s) + (quantiles ? quantiles_text(from, s) : "");
        return text + effects_text(from, s) + grid_points(from, s);
    }
    auto text = opening(from, s, title) + yields(from, s);
    if (!from.measures.empty()) text += measures_text(from, s) + (quantiles ? quantiles_text(from, s) : "");
    return text + points_text(from, s) + dependences_text(from, s);
}

}  // namespace corpuscle
