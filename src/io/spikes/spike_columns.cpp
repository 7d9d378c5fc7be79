#include "io/spikes/train_collector.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "io/table/heading.hpp"

namespace corpuscle {
namespace {

/// Headings of columns that identify the trains, the most likely first.
constexpr std::string_view train_headings[] = {"unit",  "unit_id", "cluster",        "cluster_id", "clusters", "neuron", "neuron_id",
                                               "cell",  "cell_id", "spike_clusters", "id",         "ids",      "label",  "train",
                                               "units", "index",   "address",        "spike_unit", "senders"};

/// `name` is in lower case.
bool is_spike_time_name(std::string_view name) {
    return is_time_name(name) || name == "spike_time" || name == "spike_times" || name == "spiketime" || name == "spiketimes" ||
           name == "spike time";
}

/// The headings as a list for messages.
std::string listed_headings(const std::vector<std::string>& headings) {
    std::vector<std::string> names;
    if (headings.empty()) return "none";
    for (const auto& h : headings) names.push_back("'" + h.substr(0, 40) + "'");
    if (names.size() > 12) names.resize(12), names.push_back("...");
    return fmt::format("{}", fmt::join(names, ", "));
}

/// The index of the column with this heading, name (the heading without its unit) or number (counted from 1). nullopt if there is none.
std::optional<std::size_t> requested_column(const std::vector<std::string>& headings, const std::string& wanted) {
    for (std::size_t c = 0; c < headings.size(); ++c)
        if (headings[c] == wanted || (!headings[c].empty() && parse_heading(headings[c]).name == wanted)) return c;
    const auto number = parse_bare_number<std::size_t>(wanted);
    return number && *number >= 1 && *number <= headings.size() ? std::optional(*number - 1) : std::nullopt;
}

}  // namespace

Result<ResolvedSpikeColumns> find_spike_columns(const std::vector<std::string>& headings, const SpikeColumns& wanted, std::size_t& column) {
    std::optional<std::size_t> time, train;
    ResolvedSpikeColumns out;
    for (const auto& [option, requested, resolved] : {std::tuple{"--time", &wanted.time, &time}, {"--train", &wanted.train, &train}}) {
        if (!*requested) continue;
        *resolved = requested_column(headings, **requested);
        if (!*resolved)
            return bad_input(fmt::format("{} {}: there is no such column. Columns: {}", option, **requested, listed_headings(headings)));
    }
    for (std::size_t c = 0; c < headings.size(); ++c) {
        const auto name = lower(parse_heading(headings[c]).name);
        if (!time && is_spike_time_name(name)) time = c;
        if (name == "afferent" && !wanted.train) out.afferent = c;
        if (name == "channel") out.channel = c;
    }
    for (const auto name : train_headings)
        for (std::size_t c = 0; c < headings.size() && !train && !out.afferent; ++c)
            if (c != time && lower(headings[c]) == name) train = c;
    if (train) out.afferent = train;
    if (out.channel == out.afferent) out.channel.reset();
    if (!time && headings.size() == 1 && headings[0].empty()) time = 0;
    if (!time)
        return bad_input(
            fmt::format("no column of spike times; rename one to time_s (or time, t [ms] ...), or select it with --time. Columns: {}",
                        listed_headings(headings)));
    if (!out.afferent && !out.channel && headings.size() > 1)
        return bad_input(
            fmt::format("no column identifies the trains; rename one to unit, afferent or channel, or select it with --train. Columns: {}",
                        listed_headings(headings)));
    out.time = *time;
    const auto time_unit = parse_heading(headings[*time]).unit;
    const auto seconds = time_unit.empty() ? std::optional(1.0) : seconds_per_time_unit(time_unit);
    if (!seconds) return column = *time + 1, bad_input(fmt::format("'{}' is not a unit of time; use s, ms, us or min", time_unit));
    out.seconds_per_unit = *seconds;
    return out;
}

}  // namespace corpuscle
