#include "sweep/stats/sweep_summary.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "core/thread_pool.hpp"

namespace corpuscle {
namespace {

/// All but the yield. `items`: number of items with and without a value.
MeasureSummary measure_summary(const SortedSample& sorted, std::size_t items, const SweepSummaryOptions& options) {
    MeasureSummary out;
    out.count = static_cast<std::int64_t>(sorted.count());
    out.missing = static_cast<std::int64_t>(items) - out.count;
    if (out.count == 0) return out;
    out.min = sorted.values().front(), out.max = sorted.values().back();
    out.mean = sorted.mean(), out.sigma = sorted.sigma();
    for (const double q : options.quantiles) out.quantiles.push_back(sorted.quantile(q));
    out.normality = sorted.normality(), out.normality_floor = sorted.normality_floor();
    return out;
}

/// Summarises one measure at each point, and then over all points. `measure`: its index in the table.
void put_measure(SweepSummary& out, const SweepTable& table, const SweepGroups& groups, std::size_t measure) {
    std::vector<SortedSample> sorted;  // for each point
    std::int64_t total_passed = 0;
    const auto put = [&](PointSummary& point, const SortedSample& values, std::size_t items, std::int64_t passed) {
        auto& summary = point.measures[measure];
        summary = measure_summary(values, items, out.options);
        if (table.has_limits(measure)) summary.yield = estimate_proportion(passed, static_cast<std::int64_t>(items));
    };
    for (std::size_t p = 0; p < groups.groups.size(); ++p) {
        const auto& rows = groups.groups[p].rows;
        std::vector<double> values;
        std::int64_t passed = 0;
        values.reserve(rows.size());
        for (const auto r : rows) values.push_back(table.measure_values[measure][r]), passed += table.meets_limits(r, measure);
        sorted.emplace_back(std::move(values));
        put(out.points[p], sorted.back(), rows.size(), passed);
        total_passed += passed;
    }
    put(out.all, sorted.size() == 1 ? sorted[0] : SortedSample::merged(sorted), table.rows(), total_passed);
}

/// Counts the items of a group by their ends, and allocates the measures. `passed`: for each row of the table.
PointSummary point_summary(const SweepTable& table, const SweepGroup& group, const std::vector<char>& passed) {
    PointSummary out;
    out.label = group.label, out.items = static_cast<std::int64_t>(group.rows.size());
    for (const auto r : group.rows) {
        ++(table.ends[r] == ItemEnd::done ? out.done : table.ends[r] == ItemEnd::iteration_limit ? out.iteration_limit : out.diverged);
        out.passed += passed[r];
    }
    out.yield = estimate_proportion(out.passed, out.items);
    out.measures.resize(table.measures.size());
    return out;
}

/// The value in each row, minus the mean over the rows of its group.
std::vector<double> inside_groups(const std::vector<double>& values, const SweepGroups& points) {
    const auto means = group_means(values, points.group_of, points.groups.size()).means;
    std::vector<double> out(values.size());
    for (std::size_t r = 0; r < values.size(); ++r) out[r] = values[r] - means[points.group_of[r]];
    return out;
}

/// The first chips of a sweep, at most max_analysed_chips. Chip k is sample k: a chip is simulated at each point with the same mismatch and
/// the same values of the sampled axes.
struct Chips {
    std::vector<std::uint64_t> numbers;
    std::vector<std::size_t> of_row;  ///< for each row: index in `numbers`; max_analysed_chips if it is of another chip

    /// For each chip, the mean of the values in its rows; NaN if there are none.
    std::vector<double> means(const std::vector<double>& values) const { return group_means(values, of_row, numbers.size()).means; }
};

/// `samples`: number of samples of each point; 0: each item is a separate chip.
Chips chips_of(const SweepTable& table, std::int64_t samples) {
    Chips out;
    std::unordered_map<std::uint64_t, std::size_t> index;  // by the number of the chip
    for (const auto item : table.items) {
        const auto chip = static_cast<std::uint64_t>(samples > 0 ? item % samples : item);
        if (out.numbers.size() < max_analysed_chips && index.try_emplace(chip, out.numbers.size()).second) out.numbers.push_back(chip);
        const auto known = index.find(chip);
        out.of_row.push_back(known == index.end() ? max_analysed_chips : known->second);
    }
    return out;
}

/// The index of the subject of a measure: the only subject, or the one that is named in NAME.MEASURE; -1 if there is none.
std::ptrdiff_t subject_of(const std::string& measure, const MismatchSamples& mismatch) {
    if (mismatch.subjects.size() == 1) return 0;
    for (std::size_t s = 0; s < mismatch.subjects.size(); ++s)
        if (measure.starts_with(mismatch.subjects[s].name + ".")) return static_cast<std::ptrdiff_t>(s);
    return -1;
}

/// Factors that may influence a measure. Each has a value for each chip, and a NamedInfluence whose `influence` is not yet set.
struct Factors {
    std::vector<SweepFactor> values = {};
    std::vector<NamedInfluence> names = {};

    void add(SweepFactor factor, NamedInfluence name) { values.push_back(std::move(factor)), names.push_back(std::move(name)); }
};

/// The sampled axes, which may influence every measure.
Factors axis_factors(const SweepTable& table, const Chips& chips) {
    Factors out;
    for (std::size_t a = 0; a < table.axes.size(); ++a)
        if (!table.has_points(a))
            out.add(chips.means(table.axis_values[a]), {table.axes[a].name, "", -1, -1, static_cast<std::ptrdiff_t>(a), {}});
    return out;
}

/// The devices of each subject, which may influence only the measures of this subject.
std::vector<Factors> device_factors(const MismatchSamples& mismatch, const Chips& chips) {
    std::vector<Factors> out(mismatch.subjects.size());
    for (std::size_t s = 0; s < out.size(); ++s) {
        const auto& devices = mismatch.subjects[s].devices;
        for (std::size_t d = 0; d < devices.size(); ++d) {
            if (devices[d].sigma_VT == 0 && devices[d].sigma_IS == 0) continue;
            auto deviates = deviates_of(devices[d], mismatch.seed, chips.numbers);
            NamedInfluence name{devices[d].name, "V_T", static_cast<std::ptrdiff_t>(d), static_cast<std::ptrdiff_t>(s), -1, {}};
            if (devices[d].sigma_VT != 0) out[s].add(std::move(deviates.V_T), name);
            name.quantity = "I_S";
            if (devices[d].sigma_IS != 0) out[s].add(std::move(deviates.I_S), name);
        }
    }
    return out;
}

/// Sums the fractions of each device. Those of squares count as the quantity itself.
std::vector<DeviceContribution> device_contributions(const std::vector<NamedInfluence>& influences) {
    std::vector<DeviceContribution> out;
    for (const auto& i : influences) {
        if (i.device < 0 || !(i.influence.fraction.value > 0)) continue;
        auto at = std::find_if(out.begin(), out.end(), [&](const auto& d) { return d.device == i.device && d.subject == i.subject; });
        if (at == out.end()) at = out.insert(at, {i.subject, i.device});
        (i.quantity.starts_with("V_T") ? at->V_T : at->I_S) += i.influence.fraction.value;
    }
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
        return std::tuple(-a.fraction(), a.subject, a.device) < std::tuple(-b.fraction(), b.subject, b.device);
    });
    return out;
}

/// The parts of the search for dependences that all measures share.
struct DependenceSearch {
    const SweepTable& table;
    const std::optional<MismatchSamples>& mismatch;
    SweepGroups points;                                        // by all axes with points
    std::vector<std::pair<std::size_t, SweepGroups>> by_axis;  // index of an axis with two or more points, and its groups
    Chips chips;
    Factors axes;
    std::vector<Factors> devices;  // of each subject
};

/// Adds the square of each factor, for the yield. A measure can have limits on both sides, so deviations in either direction lower the
/// yield.
void add_squares(Factors& factors) {
    const auto count = factors.values.size();
    for (std::size_t f = 0; f < count; ++f) {
        auto squares = factors.values[f];
        for (double& x : squares) x *= x;
        auto name = factors.names[f];
        name.quantity += " squared";
        factors.add(std::move(squares), std::move(name));
    }
}

/// Finds what one measure depends on.
Dependence dependence_of(const std::string& name, const std::vector<double>& values, const DependenceSearch& search) {
    Dependence out{name, {}, {}, {}, {}, {}};
    for (const auto& [axis, groups] : search.by_axis) {
        const auto between = group_effect(values, groups.group_of, groups.groups.size());
        if (between.p_value <= false_discovery_rate && between.fraction > 0) out.points.emplace_back(axis, between);
    }
    std::sort(out.points.begin(), out.points.end(),
              [](const auto& a, const auto& b) { return std::pair(-a.second.fraction, a.first) < std::pair(-b.second.fraction, b.first); });
    const auto subject = search.mismatch ? subject_of(name, *search.mismatch) : -1;
    static const Factors none;
    const auto& devices = subject >= 0 ? search.devices[static_cast<std::size_t>(subject)] : none;
    const auto& axes = search.axes;
    out.sensitivity = sensitivity_of(search.chips.means(inside_groups(values, search.points)), axes.values, devices.values);
    for (const auto& i : out.sensitivity.influences) {
        out.influences.push_back(i.factor < axes.names.size() ? axes.names[i.factor] : devices.names[i.factor - axes.names.size()]);
        out.influences.back().influence = i;
    }
    out.devices = device_contributions(out.influences);
    return out;
}

/// Also sets the number of chips from which the dependences were computed.
std::vector<Dependence> dependences_of(const SweepTable& table, const std::optional<MismatchSamples>& mismatch,
                                       const std::vector<char>& passed, std::size_t& analysed_chips) {
    std::vector<std::size_t> point_axes;
    for (std::size_t a = 0; a < table.axes.size(); ++a)
        if (table.has_points(a)) point_axes.push_back(a);
    auto points = group_rows_by_axes(table, point_axes);
    const auto count = static_cast<std::int64_t>(points.groups.size());
    // Without the description of the mismatch, the number of samples follows from the numbers of items and points.
    const auto chips = chips_of(table, mismatch                                     ? mismatch->chips
                                       : count > 0 && table.item_count % count == 0 ? table.item_count / count
                                                                                    : 0);
    analysed_chips = chips.numbers.size();
    DependenceSearch search{table, mismatch, std::move(points), {}, chips, axis_factors(table, chips), {}};
    if (mismatch) search.devices = device_factors(*mismatch, chips);
    for (const auto a : point_axes)
        if (auto groups = group_rows_by_axes(table, {a}); groups.groups.size() > 1) search.by_axis.emplace_back(a, std::move(groups));
    std::vector<Dependence> out;
    for (std::size_t m = 0; m < table.measures.size(); ++m)
        out.push_back(dependence_of(table.measures[m].name, table.measure_values[m], search));
    for (auto& factors : search.devices) add_squares(factors);
    if (table.has_limits()) out.push_back(dependence_of("yield", {passed.begin(), passed.end()}, search));
    return out;
}

/// Removes the confidence intervals. Items at several listed values are not a random sample.
void remove_intervals(PointSummary& point) {
    const auto remove_interval = [](Estimate& e) { e.low = e.high = Estimate::none; };
    remove_interval(point.yield);
    for (auto& m : point.measures) {
        remove_interval(m.mean), remove_interval(m.sigma);
        for (auto& q : m.quantiles) remove_interval(q);
        if (m.yield) remove_interval(*m.yield);
    }
}

/// Removes what makes sense only for random samples: a grid is complete, so it has no confidence intervals, sigmas or tests of normality.
void remove_statistics(PointSummary& point) {
    remove_intervals(point);
    for (auto& m : point.measures) m.sigma = {}, m.normality = m.normality_floor = Estimate::none;
}

/// For a grid: the effects of the axes on all measures, and on the yield.
std::vector<Dependence> effects_on_all(const SweepTable& table, const std::vector<char>& passed) {
    std::vector<Dependence> out;
    for (std::size_t m = 0; m < table.measures.size(); ++m)
        out.push_back({table.measures[m].name, {}, {}, {}, {}, axis_effects(table, table.measure_values[m])});
    if (table.has_limits()) out.push_back({"yield", {}, {}, {}, {}, axis_effects(table, {passed.begin(), passed.end()})});
    return out;
}

}  // namespace

Result<SweepSummary> summary_of(const SweepTable& table, const std::optional<MismatchSamples>& mismatch,
                                const SweepSummaryOptions& options) {
    const auto groups = TRY(group_rows(table, options.axes));
    SweepSummary out;
    out.options = options, out.axes = groups.axes, out.mismatch = mismatch;
    std::vector<char> passed(table.rows());
    for (std::size_t r = 0; r < passed.size(); ++r) passed[r] = table.passes(r);
    for (const auto& g : groups.groups) out.points.push_back(point_summary(table, g, passed));
    SweepGroup all{"", std::vector<std::size_t>(table.rows())};
    std::iota(all.rows.begin(), all.rows.end(), std::size_t{0});
    out.all = point_summary(table, all, passed);
    ThreadPool pool(table.rows() > 100000 ? 0 : 1);
    pool.for_each(table.measures.size(), [&](std::size_t m, unsigned) { put_measure(out, table, groups, m); });
    if (!table.is_grid) {
        if (table.varies_by_list()) remove_intervals(out.all);
        out.dependences = dependences_of(table, mismatch, passed, out.analysed_chips);
        return out;
    }
    remove_statistics(out.all);
    for (auto& point : out.points) remove_statistics(point);
    out.dependences = effects_on_all(table, passed);
    return out;
}

Result<std::optional<MismatchSamples>> read_mismatch_samples(const SweepResults& results) {
    const auto text = results.about(mismatch_metadata_name);
    if (text.empty()) return std::optional<MismatchSamples>();
    auto samples = parse_mismatch_samples(text);
    if (!samples) return bad_input(samples.error().message, {results.path()});
    return std::optional(std::move(*samples));
}

std::string title_of(const SweepResults& results) {
    const auto title = results.about("title");
    return title.empty() ? std::filesystem::path(results.path()).stem().string() : title;
}

}  // namespace corpuscle
