#include "run/trials/aligned_trial.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

#include "measure/measure_base.hpp"

namespace corpuscle {
namespace {

/// The point of alignment; NaN without a contact onset in the trial.
double zero_of(const Trial& trial, std::span<const double> onsets, const TrialOptions& options) {
    if (options.alignment != AlignmentPoint::onset) return trial.start;
    const auto first = std::lower_bound(onsets.begin(), onsets.end(), trial.start);
    return first == onsets.end() || *first >= trial.stop ? no_value : *first;
}

}  // namespace

std::span<const double> AlignedTrial::spikes_of(std::span<const double> train) const {
    if (!has_zero()) return {};
    const auto first = std::lower_bound(train.begin(), train.end(), begin);
    return {first, std::lower_bound(first, train.end(), end)};
}

Result<std::vector<AlignedTrial>> align_trials(std::span<const Trial> trials, double start, double stop, std::span<const double> onsets,
                                               const TrialOptions& options) {
    std::vector<AlignedTrial> out;
    for (const auto& trial : trials) {
        if (!(trial.start < stop && trial.stop > start))
            return bad_input(fmt::format("trial '{}' from {:g} s to {:g} s is outside of the recording, which lasts from {:g} s to {:g} s; "
                                         "remove it or correct its times",
                                         trial.label, trial.start, trial.stop, start, stop),
                             {"", trial.line});
        AlignedTrial aligned{trial, zero_of(trial, onsets, options), no_value, no_value, no_value, no_value};
        if (aligned.has_zero()) {
            // Without a window the edges are those of the trial exactly, so that adjacent trials share no spike and lose none.
            const double zero = aligned.zero, from = options.window ? options.window->first : trial.start - zero,
                         to = options.window ? options.window->second : trial.stop - zero;
            aligned.begin = std::clamp(options.window ? zero + from : trial.start, start, stop);
            aligned.end = std::clamp(options.window ? zero + to : trial.stop, start, stop);
            aligned.from = std::clamp(from, start - zero, stop - zero), aligned.to = std::clamp(to, start - zero, stop - zero);
        }
        out.push_back(std::move(aligned));
    }
    return out;
}

std::string label_of_input(const std::string& name) {
    const auto last = name.find_last_not_of("0123456789");
    if (last == name.npos || last + 1 == name.size() || last == 0) return name;
    return std::string("_-. ").find(name[last]) == std::string::npos ? name : name.substr(0, last);
}

}  // namespace corpuscle
