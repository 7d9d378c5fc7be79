// The results of a run of afferents on channels as text for a terminal.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "cli/output/terminal.hpp"
#include "cli/respond/channel_run.hpp"
#include "core/text/quantity.hpp"
#include "run/compare/implementation_comparison.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_input_lines = 60;
constexpr std::size_t max_rate_rows = 60;              // of the printed table of measures
constexpr std::size_t max_rate_rows_with_silent = 24;  // longer tables omit afferents without spikes

std::string cell(const MeasureInfo& m, double x) { return std::isnan(x) ? "-" : fmt::format("{:.{}f}", x, m.decimals); }

/// The cell of measure m in a row: the value of one afferent or, for copies, mean and standard deviation with at least one decimal.
std::string cell(const MeasureRow& row, std::size_t m) {
    if (row.copy_statistics.empty()) return cell(measures[m], row.values[m]);
    const int decimals = std::max(measures[m].decimals, 1);
    const double mean = row.copy_statistics[m].mean(), deviation = row.copy_statistics[m].standard_deviation();
    if (std::isnan(mean)) return "-";
    return fmt::format("{:.{}f}", mean, decimals) + (std::isnan(deviation) ? "" : fmt::format(" +- {:.{}f}", deviation, decimals));
}

/// One line for each input. It shows sample rate, duration and range of force, so that the user notices a wrong unit or rate.
std::string inputs_table(const RunSummary& summary) {
    std::string text;
    const auto shown = std::span(summary.inputs).first(std::min(summary.inputs.size(), max_input_lines));
    for (const auto& i : shown)
        text += fmt::format("{}: {}{} samples at {}, {}, {:.4g} to {:.4g} N\n", printable(i.name),
                            i.channels.size() == 1 ? "" : fmt::format("{} channels, ", i.channels.size()), i.samples,
                            format_quantity(i.clock.rate(), "Hz"), format_quantity(static_cast<double>(i.samples) * i.clock.T(), "s"),
                            i.min_force + 0.0, i.max_force + 0.0);  // no -0
    if (shown.size() < summary.inputs.size()) text += fmt::format("... and {} more inputs\n", summary.inputs.size() - shown.size());
    return text;
}

std::string copies_line(const CopySpec& spec) {
    if (spec.count == 0) return "";
    return spec.count == 1
               ? "1 copy of each afferent\n"
               : fmt::format("{} copies of each afferent; mean +- standard deviation over copies that have a value\n", spec.count);
}

/// The table of rates and other measures. A long table omits afferents that did not fire.
std::string rate_table(const RunSummary& summary) {
    std::map<std::pair<std::string, std::string>, double> spikes;  // by afferent and channel, over all phases
    for (const auto& r : summary.rows) spikes[{r.afferent, r.channel}] += r.values[measure_index<SpikeCount>()];
    const bool shows_silent = summary.rows.size() <= max_rate_rows_with_silent;
    TableRows rows = {{"afferent", "channel", "phase"}};
    const auto columns = summary.columns();
    for (const auto c : columns) rows[0].push_back(column_heading(measures[c]));
    std::size_t omitted = 0;
    for (const auto& r : summary.rows) {
        if (!shows_silent && spikes[{r.afferent, r.channel}] == 0) continue;
        if (rows.size() > max_rate_rows) {
            ++omitted;
            continue;
        }
        rows.push_back({r.afferent, r.channel, r.phase});
        for (const auto c : columns) rows.back().push_back(cell(r, c));
    }
    auto text = format_table(rows);
    if (omitted > 0) text += fmt::format("... and {} more rows; --out writes all of them to summary.json\n", omitted);
    const auto silent = std::count_if(spikes.begin(), spikes.end(), [](const auto& s) { return s.second == 0; });
    if (!shows_silent && silent > 0)
        text += fmt::format("Not shown: {} of {} afferents without spikes (counted once per channel).\n", silent, spikes.size());
    return text;
}

constexpr std::size_t max_comparisons = 30;             // in the printed table, approximately
constexpr std::size_t max_comparisons_with_silent = 8;  // if there are more, those without spikes are omitted

/// The spike counts of all phases, of the implementation or of its reference (selected by `count`): "0 5 8 1 0".
std::string by_phase(const ImplementationComparison& c, std::size_t ImplementationComparison::PhaseCount::* count) {
    std::string text;
    for (const auto& p : c.phases) text += fmt::format("{}{}", text.empty() ? "" : " ", p.*count);
    return text.empty() ? "-" : text;
}

std::vector<std::string> line_of(const ImplementationComparison& c) {
    const auto shown = [](double x, const char* format) { return std::isnan(x) ? std::string("-") : fmt::format(fmt::runtime(format), x); };
    return table_row(c.afferent, c.channel, c.total.spikes, by_phase(c, &ImplementationComparison::PhaseCount::spikes),
                     shown(100 * c.total.excess(), "{:+.0f}"), c.matched, shown(1e3 * c.median_shift, "{:+.2f}"),
                     shown(c.victor_purpura, "{:.2f}"), shown(c.van_rossum, "{:.2f}"));
}

/// The line of the reference, with which the following lines are compared.
std::vector<std::string> reference_line(const ImplementationComparison& c) {
    return table_row(c.reference, c.channel, c.total.reference_spikes,
                     by_phase(c, &ImplementationComparison::PhaseCount::reference_spikes));
}

/// A table that compares the implementations of each afferent type with its reference (ImplementationGroup). "" if no type has several
/// implementations.
std::string implementations_table(const ImplementationComparisons& comparisons) {
    TableRows rows = {
        {"implementation", "channel", "spikes", "by phase", "change (%)", "matched", "shift (ms)", "Victor-Purpura", "van Rossum"}};
    const auto& all = comparisons.rows;
    std::size_t omitted = 0, silent = 0;
    const ImplementationComparison* last = nullptr;  // the last printed row; its reference has been printed, too
    for (const auto& c : all) {
        if (c.total.spikes + c.total.reference_spikes == 0 && all.size() > max_comparisons_with_silent) {
            ++silent;
            continue;
        }
        if (rows.size() > max_comparisons) {
            ++omitted;
            continue;
        }
        if (!last || last->reference != c.reference || last->channel != c.channel) rows.push_back(reference_line(c));
        rows.push_back(line_of(c));
        last = &c;
    }
    if (rows.size() == 1) return "";
    auto text = "\n" + format_table(rows);
    if (omitted > 0) text += fmt::format("... and {} more rows; --out writes all of them to summary.json\n", omitted);
    if (silent > 0) text += fmt::format("Not shown: {} pairs without spikes.\n", silent);
    return text +
           fmt::format(
               "Compared with the first row of each afferent type and channel. Spikes within {} match; shift: median of matched spikes.\n"
               "Victor-Purpura cost {:g} per second; van Rossum time constant {}.\n",
               format_quantity(2 / ImplementationComparisons::cost, "s"), ImplementationComparisons::cost,
               format_quantity(ImplementationComparisons::tau, "s"));
}

}  // namespace

std::string ChannelRun::table() const {
    return inputs_table(outcome_->summary) + copies_line(outcome_->copies) + rate_table(outcome_->summary) +
           implementations_table(outcome_->summary.comparisons);
}

}  // namespace corpuscle
