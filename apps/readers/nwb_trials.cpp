// Reads the trials of an NWB file (Neurodata Without Borders): the columns start_time and stop_time of /intervals/trials, and a label.

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "core/text/utf8.hpp"
#include "helper_main.hpp"
#include "io/nwb/nwb_messages.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/remote_samples.hpp"
#include "nwb_table.hpp"

namespace corpuscle {
namespace {

constexpr std::uint64_t max_trials = std::uint64_t{1} << 20;
constexpr const char* group = "/intervals/trials";

/// The columns that can be read: times and labels have one value for each trial.
std::vector<std::string> label_candidates(const NwbTable& table) {
    auto names = table.column_names();
    std::erase_if(names, [&](const auto& name) {
        return name == "start_time" || name == "stop_time" || name == "id" || !table.has_one_value_per_row(name);
    });
    return names;
}

/// The name of the column of the labels; "" if there is none and none is needed.
Result<std::string> find_label(const NwbTable& table, const TrialsRequest& request) {
    const auto names = table.column_names();
    for (const auto& wanted : request.labels)
        for (const auto& name : names)
            if (lower(name) == lower(wanted) && (request.needs_label || table.has_one_value_per_row(name))) return name;
    if (!request.needs_label) return std::string();
    auto candidates = label_candidates(table);
    if (candidates.size() > 12) candidates.resize(12), candidates.push_back("...");
    return table.bad(fmt::format(
        "--label {}: {} has no such column; {}", fmt::join(request.labels, ", "), group,
        candidates.empty() ? "leave out --label: no column has labels" : fmt::format("there are: {}", fmt::join(candidates, ", "))));
}

Result<NwbTrialTable> read_trials(const NwbTable& table, const TrialsRequest& request) {
    if (table.is_empty()) return table.bad(fmt::format("this NWB file has no trials: it has no table {}; give the trials as CSV", group));
    const auto label = TRY(find_label(table, request));
    const auto starts = TRY(table.reals("start_time", max_trials)), stops = TRY(table.reals("stop_time", max_trials));
    if (!label.empty() && !table.has_one_value_per_row(label))
        return table.bad(
            fmt::format("--label {}: this column of {} has not one value for each trial; select another column", label, group));
    const auto labels = label.empty() ? std::vector<std::string>(starts.size()) : TRY(table.texts(label, max_trials));
    for (const auto& [column, count] : {std::pair{std::string("stop_time"), stops.size()}, {label, labels.size()}})
        if (count != starts.size())
            return table.bad(
                fmt::format("{}: start_time has {} elements, but {} has {}; the file may be damaged", group, starts.size(), column, count));
    NwbTrialTable out{{}, to_utf8(label), table.column_names()};
    for (std::size_t k = 0; k < starts.size(); ++k) out.trials.push_back({starts[k], stops[k], labels[k]});
    std::erase_if(out.unused,
                  [&](const auto& name) { return name == "start_time" || name == "stop_time" || name == "id" || name == label; });
    for (auto& name : out.unused) name = to_utf8(name);
    return out;
}

}  // namespace

Result<NwbTrialTable> read_nwb_trials(int descriptor, const TrialsRequest& request) {
    const auto file = TRY(hdf5::open_file(descriptor, request.path));
    TRY(check_is_nwb(file, "trials", request.path));
    return read_trials(NwbTable(file, group, request.path), request);
}

HelperService trials_service() { return request_service<TrialsRequest>(HelperProcess::trials_protocol, read_nwb_trials); }

}  // namespace corpuscle
