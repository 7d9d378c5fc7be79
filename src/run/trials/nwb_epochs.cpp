// The trials of an NWB file, which a helper program reads.

#include <fmt/format.h>
#include <cmath>

#include "io/hdf5/hdf5_request.hpp"
#include "io/nwb/nwb_messages.hpp"
#include "run/trials/epoch_formats.hpp"

namespace corpuscle {
namespace {

/// Returns an error for times that are not those of a trial.
Result<void> check_trial(const NwbTrial& trial, std::size_t row, const std::string& path) {
    const auto error = [&](const std::string& message) {
        return bad_input(fmt::format("/intervals/trials: row {} (from 0): {}", row, message), {path});
    };
    for (const auto& [column, time] : {std::pair{"start_time", trial.start}, {"stop_time", trial.stop}})
        if (!std::isfinite(time))
            return error(fmt::format("{} is {}, which is not a time; correct it, or give the trials as CSV", column, time));
    if (!(trial.stop > trial.start))
        return error(
            fmt::format("the trial stops at {:g} s, but starts at {:g} s; stop_time must be after start_time", trial.stop, trial.start));
    return {};
}

}  // namespace

Result<EpochTable> read_nwb_epochs(const std::string& path, const std::optional<std::string>& label) {
    TrialsRequest request{path, {std::begin(epoch_label_names), std::end(epoch_label_names)}, label.has_value()};
    if (label) request.labels = {*label};
    const auto table = TRY(request_from_hdf5<NwbTrialTable>(HelperProcess::trials_protocol, request));
    std::vector<Trial> trials;
    for (const auto& t : table.trials) {
        TRY(check_trial(t, trials.size(), path));
        trials.push_back({t.start, t.stop, table.label.empty() ? std::string(default_trial_label) : t.label});
    }
    if (trials.empty()) return bad_input("the table /intervals/trials of this NWB file has no rows; give the trials as CSV", {path});
    return make_epoch_table(std::move(trials), table.unused, !table.label.empty());
}

}  // namespace corpuscle
