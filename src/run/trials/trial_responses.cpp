#include "run/trials/trial_responses.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

constexpr double edge_tolerance = 1e-9;  // of a bin: a spike so close to an edge counts as at the edge

/// The value of every measure over a window. The next spike after the window belongs to the last interval.
std::vector<double> values_in(std::span<const double> train, const TimeWindow& window) {
    MeasureAccumulator accumulator({window}, 1);
    const auto first = std::lower_bound(train.begin(), train.end(), window.from);
    for (auto t = first; t != train.end(); ++t) {
        accumulator.spike(0, *t);
        if (*t >= window.to) break;
    }
    return accumulator.values(0, 0);
}

/// The largest number of the form 1, 2 or 5 times a power of ten that divides `length` into at least `parts` parts.
double round_part(double length, int parts) {
    const double max = length / parts * (1 + 1e-9), decade = std::pow(10, std::floor(std::log10(max)));
    return decade * (max >= 5 * decade ? 5 : max >= 2 * decade ? 2 : 1);
}

/// The edges of the bins.
Result<std::vector<double>> edges_of(std::span<const AlignedTrial> trials, double width,
                                     const std::optional<std::pair<double, double>>& window) {
    double from = 0, to = 0;
    for (const auto& t : trials)
        if (t.has_zero()) from = std::min(from, t.from), to = std::max(to, t.to);
    if (window)
        std::tie(from, to) = *window;
    else
        from = std::floor(from / width + edge_tolerance) * width;
    const double count = std::max(std::ceil((to - from) / width - edge_tolerance), 1.0);
    if (count > static_cast<double>(max_histogram_bins))
        return bad_usage(fmt::format("bins of {:g} s divide {:g} s into {:.0f}, more than {}; use longer bins", width, to - from, count,
                                     max_histogram_bins));
    std::vector<double> edges;
    for (double k = 0; k < count; ++k) edges.push_back(from + k * width);
    edges.push_back(to);
    return edges;
}

/// Adds the spikes of one trial to the bins that it covers. `counts`: for each bin; `afferents`: their number in the group.
void add_trial_to(std::vector<HistogramBin>& bins, const AlignedTrial& trial, std::span<const std::int64_t> counts, double afferents) {
    for (std::size_t b = 0; b < bins.size(); ++b) {
        auto& bin = bins[b];
        const double slack = edge_tolerance * (bin.to - bin.from);
        if (trial.from > bin.from + slack || trial.to < bin.to - slack) continue;
        bin.spikes += counts[b];
        bin.rate.add(static_cast<double>(counts[b]) / (bin.to - bin.from) / afferents);
    }
}

}  // namespace

double HistogramBin::standard_error() const { return rate.standard_deviation() / std::sqrt(static_cast<double>(rate.copies)); }

std::vector<double> trial_values(std::span<const double> train, const AlignedTrial& trial) {
    if (!trial.has_zero()) return std::vector<double>(std::size(measures), no_value);
    auto values = values_in(train, {trial.begin, trial.end});
    const auto latency = measure_index<Latency>();
    if (trial.from != 0) values[latency] = trial.to > 0 ? values_in(train, {trial.zero, trial.end})[latency] : no_value;
    return values;
}

std::size_t TrialResponses::add_afferent(const std::string& name, const std::string& channel, const std::string& group_name) {
    const auto [at, is_new] = afferent_indexes_.try_emplace({name, channel}, afferents.size());
    if (!is_new) return at->second;
    const auto [group, is_new_group] = group_indexes_.try_emplace({group_name, channel}, groups.size());
    if (is_new_group) groups.push_back({group_name, channel});
    ++groups[group->second].afferents;
    afferents.push_back({name, channel, group->second});
    return at->second;
}

void TrialResponses::add_trial(const AlignedTrial& trial, std::span<const std::vector<double>> trains,
                               std::span<const std::size_t> indexes) {
    std::vector<std::vector<CopyStatistics>> of_groups(groups.size(), std::vector<CopyStatistics>(std::size(measures)));
    const auto silent = trial_values({}, trial);
    for (std::size_t k = 0; k < trains.size(); ++k) {
        const auto spikes = trial.spikes_of(trains[k]);
        auto values = spikes.empty() ? silent : trial_values(trains[k], trial);
        auto& group = of_groups[afferents[indexes[k]].group];
        for (std::size_t m = 0; m < values.size(); ++m) group[m].add(values[m]);
        if (spikes.empty() && !keeps_silent) continue;
        responses.push_back({trials.size(), indexes[k], {spikes.begin(), spikes.end()}, std::move(values)});
        for (double& t : responses.back().spikes) t -= trial.zero;
    }
    group_values_.emplace_back();
    for (const auto& group : of_groups) {
        std::vector<double> means;
        for (const auto& m : group) means.push_back(m.mean());
        group_values_.back().push_back(std::move(means));
    }
    trials.push_back(trial);
}

void TrialResponses::add(std::span<const AlignedTrial> added, std::span<const std::vector<double>> trains,
                         std::span<const std::size_t> indexes) {
    for (const auto& trial : added) add_trial(trial, trains, indexes);
}

double TrialResponses::default_bin(const std::optional<std::pair<double, double>>& window) const {
    double length = window ? window->second - window->first : 0;
    for (const auto& t : trials)
        if (t.has_zero() && !window) length = std::max(length, t.to - t.from);
    return length > 0 ? round_part(length, 25) : 10e-3;
}

std::vector<std::string> TrialResponses::labels() const {
    std::vector<std::string> out;
    for (const auto& t : trials)
        if (std::find(out.begin(), out.end(), t.label) == out.end()) out.push_back(t.label);
    return out;
}

std::vector<LabelRow> TrialResponses::label_rows() const {
    std::vector<LabelRow> out;
    for (const auto& label : labels())
        for (std::size_t g = 0; g < groups.size(); ++g) {
            LabelRow row{label, g, std::vector<CopyStatistics>(std::size(measures))};
            for (std::size_t t = 0; t < trials.size(); ++t)
                if (trials[t].label == label && g < group_values_[t].size())
                    for (std::size_t m = 0; m < row.statistics.size(); ++m) row.statistics[m].add(group_values_[t][g][m]);
            out.push_back(std::move(row));
        }
    return out;
}

TrialGrouping TrialResponses::groups_by_name() const {
    TrialGrouping out;
    for (const auto& a : afferents) {
        const auto& name = groups[a.group].name;
        const auto at = std::find_if(out.groups.begin(), out.groups.end(), [&](const TrialGroup& g) { return g.name == name; });
        out.group_of.push_back(static_cast<std::size_t>(at - out.groups.begin()));
        if (at == out.groups.end()) out.groups.push_back({name, ""});
        ++out.groups[out.group_of.back()].afferents;
    }
    return out;
}

Result<std::vector<Histogram>> TrialResponses::histograms(double width, const std::optional<std::pair<double, double>>& window) const {
    TrialGrouping own{groups, {}};
    for (const auto& a : afferents) own.group_of.push_back(a.group);
    return histograms(width, window, own);
}

Result<std::vector<Histogram>> TrialResponses::histograms(double width, const std::optional<std::pair<double, double>>& window,
                                                          const TrialGrouping& grouping) const {
    const auto edges = TRY(edges_of(trials, width, window));
    const std::size_t bins = edges.size() - 1, group_count = grouping.groups.size();
    const auto names = labels();
    std::vector<Histogram> out;
    for (const auto& label : names)
        for (std::size_t g = 0; g < group_count; ++g) {
            out.push_back({label, g, {}});
            for (std::size_t b = 0; b < bins; ++b) out.back().bins.push_back({edges[b], edges[b + 1]});
        }
    std::vector<std::vector<const TrialResponse*>> of_group(group_count);
    for (const auto& r : responses) of_group[grouping.group_of[r.afferent]].push_back(&r);
    // The first of our groups in each group. A trial of an input without it does not count.
    std::vector<std::size_t> first_group(group_count, groups.size());
    for (std::size_t a = 0; a < afferents.size(); ++a)
        first_group[grouping.group_of[a]] = std::min(first_group[grouping.group_of[a]], afferents[a].group);
    std::vector<std::int64_t> counts(bins);
    for (std::size_t g = 0; g < group_count; ++g) {
        auto next = of_group[g].begin();
        for (std::size_t t = 0; t < trials.size(); ++t) {
            std::fill(counts.begin(), counts.end(), 0);
            for (; next != of_group[g].end() && (*next)->trial == t; ++next)
                for (const double time : (*next)->spikes) {
                    const double bin = std::floor((time - edges[0]) / width + edge_tolerance);
                    if (bin >= 0 && bin < static_cast<double>(bins)) ++counts[static_cast<std::size_t>(bin)];
                }
            const auto label = static_cast<std::size_t>(std::find(names.begin(), names.end(), trials[t].label) - names.begin());
            if (trials[t].has_zero() && first_group[g] < group_values_[t].size())
                add_trial_to(out[label * group_count + g].bins, trials[t], counts, static_cast<double>(grouping.groups[g].afferents));
        }
    }
    return out;
}

}  // namespace corpuscle
