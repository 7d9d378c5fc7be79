#include <algorithm>
#include <cmath>

#include "report/envelope.hpp"
#include "report/sweep/sweep_page.hpp"
#include "run/summary/json_number.hpp"
#include "sweep/spec/probability.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_bins = 60;             // of a histogram
constexpr std::size_t max_in_normal_plot = 200;  // points of a group
constexpr std::size_t max_times = 500;           // of an envelope
constexpr std::size_t max_spikes = 200000;       // of a raster

/// The quantile q (0 to 1) of the values, without interpolation. Reorders the values, which must not be empty.
double quantile_of(std::vector<double>& values, double q) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The bins of a histogram: start of the first bin, width of each, and their number.
struct Bins {
    double from = 0, width = 1;
    std::size_t count = 1;
};
Bins bins_for(std::vector<double> values) {
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    double low = *min, high = *max;
    const bool are_integers = high - low < 1000 && std::all_of(values.begin(), values.end(), [](double x) { return x == std::round(x); });
    if (are_integers) {
        const double width = std::ceil((high - low + 1) / max_bins);
        return {low - 0.5, width, static_cast<std::size_t>(std::ceil((high - low + 1) / width))};
    }
    if (low == high) return {low - 0.5, 1, 1};
    const double a = quantile_of(values, 0.005), b = quantile_of(values, 0.995), margin = 0.5 * (b - a);
    if (b > a)
        low = std::max(low, a - margin),
        high = std::min(high, b + margin);  // otherwise one outlier would put all other values into few bins
    return {low, (high - low) / max_bins, max_bins};
}

/// The ranks (from 0) of the plotted values among `count` sorted values. They are evenly spaced in the normal score: all ranks in the
/// tails, fewer in the middle.
std::vector<std::size_t> ranks_in_normal_plot(std::size_t count) {
    if (count <= max_in_normal_plot) return thinned_rows(count, count);
    // The score of rank k is normal_quantile((k + 1 - 0.375) / (n + 0.25)); `far` is that of the last rank.
    const double n = static_cast<double>(count), far = normal_quantile((n - 0.375) / (n + 0.25));
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < max_in_normal_plot; ++k) {
        const double score = far * (2 * static_cast<double>(k) / (max_in_normal_plot - 1) - 1),
                     probability = 0.5 * std::erfc(-score / std::sqrt(2.0));
        const auto rank = static_cast<std::size_t>(std::clamp(std::round(probability * (n + 0.25) - 0.625), 0.0, n - 1));
        if (out.empty() || rank > out.back()) out.push_back(rank);
    }
    return out;
}

/// Minimum, 5 % quantile, median, 95 % quantile and maximum over the rows, each with one value for each time.
struct EnvelopeStats {
    std::vector<double> min, low, median, high, max;
    /// Adds one time. `values`: those of the rows; reordered, and set to NaN if empty.
    void add(std::vector<double>& values) {
        if (values.empty()) values.push_back(std::nan(""));
        low.push_back(quantile_of(values, 0.05)), median.push_back(quantile_of(values, 0.5)), high.push_back(quantile_of(values, 0.95));
        min.push_back(*std::min_element(values.begin(), values.end())), max.push_back(*std::max_element(values.begin(), values.end()));
    }
};

}  // namespace

PlotJson plot_numbers(const std::vector<double>& values) { return array_document(std::vector<float>(values.begin(), values.end())); }

std::vector<Grouping> groupings_of(const SweepTable& table) {
    std::vector<Grouping> out = {{"all together", group_rows_by_axes(table, {})}};
    for (std::size_t a = 0; a < table.axes.size() && out.size() < 12; ++a) {
        auto groups = group_rows_by_axes(table, {a});
        if (groups.groups.size() > 1 && groups.groups.size() <= max_groups) out.push_back({table.axes[a].name, std::move(groups)});
    }
    return out;
}

std::vector<std::size_t> thinned_rows(std::size_t rows, std::size_t max_rows) {
    std::vector<std::size_t> out;
    const auto count = std::min(rows, max_rows);
    for (std::size_t k = 0; k < count; ++k) out.push_back(count == 1 ? 0 : k * (rows - 1) / (count - 1));
    return out;
}

PlotJson histograms(const std::vector<double>& values, const SweepGroups& groups) {
    auto known = values;
    std::erase_if(known, [](double x) { return !std::isfinite(x); });
    if (known.empty()) return nullptr;
    const Bins bins = bins_for(std::move(known));
    PlotJson counts = PlotJson::array();
    std::size_t below = 0, above = 0;
    for (const auto& g : groups.groups) {
        std::vector<std::size_t> bin_counts(bins.count);
        for (const auto r : g.rows) {
            if (!std::isfinite(values[r])) continue;
            const double at = std::floor((values[r] - bins.from) / bins.width);
            const bool in_last = values[r] <= bins.from + bins.width * static_cast<double>(bins.count) * (1 + 1e-12);
            if (at < 0) ++below;  // outliers are counted here and in the outer bins
            if (at >= static_cast<double>(bins.count) && !in_last) ++above;
            ++bin_counts[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bins.count - 1)))];
        }
        counts.push_back(bin_counts);
    }
    return {{"from", bins.from}, {"width", bins.width}, {"counts", counts}, {"below", below}, {"above", above}};
}

PlotJson normal_plots(const std::vector<double>& values, const SweepGroups& groups) {
    PlotJson out = PlotJson::array();
    for (const auto& g : groups.groups) {
        std::vector<double> group_values, scores, points;
        for (const auto r : g.rows) group_values.push_back(values[r]);
        const SortedSample sorted(std::move(group_values));
        const auto n = static_cast<double>(sorted.count());
        for (const auto k : ranks_in_normal_plot(sorted.count())) {
            scores.push_back(normal_quantile((static_cast<double>(k) + 1 - 0.375) / (n + 0.25)));
            points.push_back(sorted.values()[k]);
        }
        out.push_back(
            {{"scores", plot_numbers(scores)}, {"values", plot_numbers(points)}, {"correlation", json_number(sorted.normality())}});
    }
    return out;
}

Result<PlotJson> envelopes(const SweepResults& results, std::size_t probe, const SweepTable& table, const std::vector<std::size_t>& rows,
                           const std::vector<Grouping>& groupings) {
    const auto shown = thinned_rows(results.probe_times.size(), max_times);
    std::vector<std::vector<float>> all;  // [row][time]
    for (const auto r : rows) {
        const auto samples = TRY(results.probe_samples(table.items[r], probe));
        all.emplace_back();
        for (const auto k : shown) all.back().push_back(k < samples.size() ? samples[k] : std::nanf(""));
    }
    const auto stats_over = [&](auto&& is_included) {
        EnvelopeStats stats;
        std::vector<double> at;
        for (std::size_t k = 0; k < shown.size(); ++k) {
            at.clear();
            for (std::size_t i = 0; i < rows.size(); ++i)
                if (is_included(rows[i]) && std::isfinite(all[i][k])) at.push_back(all[i][k]);
            stats.add(at);
        }
        return stats;
    };
    std::vector<double> times;
    for (const auto k : shown) times.push_back(results.probe_times[k]);
    const auto overall = stats_over([](std::size_t) { return true; });
    PlotJson medians = PlotJson::array();
    for (const auto& g : groupings) {
        medians.push_back(PlotJson::array());
        for (std::size_t k = 0; k < g.row_groups.groups.size() && g.row_groups.groups.size() > 1; ++k)
            medians.back().push_back(plot_numbers(stats_over([&](std::size_t r) { return g.row_groups.group_of[r] == k; }).median));
    }
    return PlotJson{{"name", results.probe_names[probe]},
                    {"unit", results.probe_units[probe]},
                    {"times", plot_numbers(times)},
                    {"every", results.probe_times.size() > max_times},
                    {"items", rows.size()},
                    {"min", plot_numbers(overall.min)},
                    {"low", plot_numbers(overall.low)},
                    {"median", plot_numbers(overall.median)},
                    {"high", plot_numbers(overall.high)},
                    {"max", plot_numbers(overall.max)},
                    {"medians", medians}};
}

Result<PlotJson> rasters(const SweepResults& results, std::size_t train, const SweepTable& table, const std::vector<std::size_t>& rows) {
    PlotJson shown = PlotJson::array(), counts = PlotJson::array();
    std::vector<float> times;
    for (const auto r : rows) {
        const auto spikes = TRY(results.spikes(table.items[r], train));
        if (times.size() + spikes.size() > max_spikes) break;  // the raster then shows the rows before this one
        shown.push_back(r), counts.push_back(spikes.size());
        for (const double t : spikes) times.push_back(static_cast<float>(t));
    }
    return PlotJson{{"name", results.train_names[train]}, {"rows", shown}, {"counts", counts}, {"times", array_document(times)}};
}

}  // namespace corpuscle
