#include "io/spikes/spike_files.hpp"

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"
#include "core/text/utf8.hpp"
#include "io/spikes/address_events.hpp"
#include "io/spikes/train_collector.hpp"
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
    return joined(names);
}

/// The index of the column with this heading, name (the heading without its unit) or number (counted from 1). nullopt if there is none.
std::optional<std::size_t> requested_column(const std::vector<std::string>& headings, const std::string& wanted) {
    for (std::size_t c = 0; c < headings.size(); ++c)
        if (headings[c] == wanted || (!headings[c].empty() && parse_heading(headings[c]).name == wanted)) return c;
    const auto number = parse_bare_number<std::size_t>(wanted);
    return number && *number >= 1 && *number <= headings.size() ? std::optional(*number - 1) : std::nullopt;
}

/// True if a is before b in natural order, in which "ch2" is before "ch10": runs of digits are compared by value, other characters by byte.
bool natural_less(std::string_view a, std::string_view b) {
    // The number of digits at the beginning of s.
    const auto digits = [](std::string_view s) { return std::min(s.find_first_not_of("0123456789"), s.size()); };
    while (!a.empty() && !b.empty()) {
        auto m = digits(a), n = digits(b);
        if (m == 0 || n == 0) {
            if (a[0] != b[0]) return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]);
            m = n = 1;
        } else {
            auto x = a.substr(0, m), y = b.substr(0, n);
            x.remove_prefix(std::min(x.find_first_not_of('0'), m)), y.remove_prefix(std::min(y.find_first_not_of('0'), n));
            if (x.size() != y.size()) return x.size() < y.size();
            if (x != y) return x < y;
            if (m != n) return m < n;
        }
        a.remove_prefix(m), b.remove_prefix(n);
    }
    return a.size() < b.size();
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

std::vector<NamedTrain> TrainCollector::sorted() && {
    std::vector<NamedTrain> out;
    for (auto& [name, times] : trains_) {
        std::sort(times.begin(), times.end());
        out.push_back({name.first, name.second, std::move(times)});
    }
    std::sort(out.begin(), out.end(), [](const NamedTrain& a, const NamedTrain& b) {
        return a.channel == b.channel ? natural_less(a.afferent, b.afferent) : natural_less(a.channel, b.channel);
    });
    return out;
}

Result<std::vector<NamedTrain>> read_spikes(const std::string& path, const SpikeColumns& columns) {
    const auto first = peek_input(path, 512);
    for (const std::string_view sound : {"RIFF", "fLaC"})
        if (first.starts_with(sound))
            return bad_input("this is a sound file, not a spike file; supported are CSV, JSON lines, .npy, .npz, NWB and address events",
                             {path});
    if (first.starts_with("\x89HDF")) return read_nwb_spikes(path, columns);
    if (first.starts_with("PK") && (first.find(".npy") != first.npos || path.ends_with(".npz"))) return read_npz_spikes(path);
    if (first.starts_with("\x93NUMPY")) return read_npy_spikes(path, columns);
    return first.starts_with(address_events::magic) ? read_aer_spikes(path)
           : first.starts_with("#!AER-DAT2.0")      ? read_aedat2_spikes(path)
                                                    : read_text_spikes(path, columns);
}

}  // namespace corpuscle
