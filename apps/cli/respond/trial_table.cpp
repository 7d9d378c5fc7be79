#include "cli/respond/trial_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "cli/output/terminal.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_rows = 40;
const std::size_t shown[] = {measure_index<SpikeCount>(), measure_index<MeanRate>(), measure_index<PeakRate>(), measure_index<Latency>()};

std::string cell(const CopyStatistics& statistics, const MeasureInfo& measure) {
    const int decimals = std::max(measure.decimals, 1);
    if (statistics.copies == 0) return "-";
    const auto mean = fmt::format("{:.{}f}", statistics.mean(), decimals);
    return statistics.copies == 1 ? mean : fmt::format("{} +- {:.{}f}", mean, statistics.standard_deviation(), decimals);
}

}  // namespace

std::string trial_table(const TrialCollector& collected) {
    const auto& responses = collected.responses;
    const auto without_zero = std::count_if(responses.trials.begin(), responses.trials.end(), [](const auto& t) { return !t.has_zero(); });
    TableRows rows = {{"label", "afferent", "channel", "trials"}};
    for (const auto m : shown) rows[0].push_back(column_heading(measures[m]));
    const auto all = responses.label_rows();
    for (const auto& row : all) {
        if (rows.size() > max_rows) break;
        const auto& group = responses.groups[row.group];
        rows.push_back({row.label, group.name, group.channel, std::to_string(row.statistics[shown[0]].copies)});
        for (const auto m : shown) rows.back().push_back(cell(row.statistics[m], measures[m]));
    }
    auto text = fmt::format("\n{} trials, aligned to {}{}; mean +- standard deviation over trials that have a value\n",
                            responses.trials.size(), collected.options().uses_onsets() ? "contact onset" : "their start",
                            without_zero > 0 ? fmt::format(" ({} have none)", without_zero) : "");
    text += format_table(rows);
    if (all.size() + 1 > rows.size()) text += fmt::format("... and {} more rows; --out writes all of them\n", all.size() + 1 - rows.size());
    return text;
}

}  // namespace corpuscle
