#include "corpuscle/trials.hpp"

#include <algorithm>

#include "api/result.hpp"
#include "api/view_source.hpp"
#include "io/recording/trial_recordings.hpp"
#include "run/trials/contact_detector.hpp"
#include "run/trials/epoch_table.hpp"
#include "run/trials/trial_responses.hpp"

namespace corpuscle {
namespace {

using api::value_or_throw;

/// The contacts of the sum of all channels.
Contacts contacts_of(const ForceView& view, std::optional<double> threshold) {
    if (view.count == 0) throw InputError("the force is missing, which contact onsets are found in");
    const auto source = api::make_view_source(view);
    std::vector<double> sum;
    for (Frames block(source->channels().size(), 4096);;) {
        value_or_throw(source->read(block));
        if (block.count == 0) return find_contacts(sum, source->clock(), threshold);
        const auto first = sum.size();
        sum.resize(first + block.count);
        for (const auto& channel : block.force)
            for (std::size_t k = 0; k < block.count; ++k) sum[first + k] += channel[k];
    }
}

/// Adds the trials of one source.
void add_source(const TrialSource& source, std::size_t index, const TrialOptions& options, TrialResponses& responses, TrialAnalysis& out) {
    const auto& response = *source.response;
    std::vector<std::vector<double>> trains(response.afferents.size());
    for (std::size_t k = 0; k < response.times.size(); ++k) trains[response.indices[k]].push_back(response.times[k]);
    std::vector<std::size_t> indexes;
    for (const auto& a : response.afferents) {
        indexes.push_back(responses.add_afferent(a.name, a.channel, a.name));
        if (indexes.back() == out.afferents.size()) out.afferents.push_back(a);
    }
    std::vector<Trial> trials;
    for (const auto& t : source.trials) trials.push_back({t.start, t.stop, t.label});
    const auto onsets = options.uses_onsets() ? contacts_of(source.force, options.onset_threshold).onsets() : std::vector<double>();
    const auto aligned = value_or_throw(align_trials(trials, response.start, response.start + response.duration, onsets, options));
    responses.add(aligned, trains, indexes);
    for (const auto& t : aligned) {
        out.trials.push_back({t.start, t.stop, t.label});
        out.source.push_back(index), out.zero.push_back(t.zero), out.from.push_back(t.from), out.to.push_back(t.to);
    }
}

LabelStatistics statistics_of(const LabelRow& row) {
    LabelStatistics out{row.label, row.group};
    for (const auto& m : row.statistics)
        out.mean.push_back(m.mean()), out.standard_deviation.push_back(m.standard_deviation()), out.trials.push_back(m.copies);
    return out;
}

TrialHistogram histogram_of(const Histogram& histogram) {
    TrialHistogram out{histogram.label, histogram.group};
    for (const auto& bin : histogram.bins) {
        out.from.push_back(bin.from), out.to.push_back(bin.to), out.spikes.push_back(bin.spikes);
        out.rate.push_back(bin.rate.mean()), out.standard_error.push_back(bin.standard_error()), out.trials.push_back(bin.rate.copies);
    }
    return out;
}

}  // namespace

std::vector<Epoch> read_trial_table(const std::string& path, const std::string& label) {
    std::vector<Epoch> out;
    for (auto& t : value_or_throw(read_epochs(path, label.empty() ? std::nullopt : std::optional(label))).trials)
        out.push_back({t.start, t.stop, std::move(t.label)});
    return out;
}

ForceContacts find_force_contacts(const ForceView& force, std::optional<double> threshold) {
    const auto found = contacts_of(force, threshold);
    ForceContacts out{found.level, found.noise, found.threshold, found.release, {}, {}};
    for (const auto& c : found.contacts) out.onsets.push_back(c.onset), out.releases.push_back(c.release);
    return out;
}

TrialAnalysis analyse_trials(std::span<const TrialSource> sources, const TrialAlignment& alignment) {
    TrialOptions options;
    options.alignment = alignment.to_onset ? AlignmentPoint::onset : AlignmentPoint::start;
    options.window = alignment.window, options.onset_threshold = alignment.onset_threshold;
    if (options.window && !(options.window->first < options.window->second)) throw InputError("the window must end after it begins");
    TrialAnalysis out;
    const auto responses = std::make_shared<TrialResponses>();
    for (std::size_t k = 0; k < sources.size(); ++k) add_source(sources[k], k, options, *responses, out);
    if (out.trials.empty()) throw InputError("there are no trials");
    for (const auto& r : responses->responses) out.responses.push_back({r.trial, r.afferent, r.spikes, r.values});
    // Each afferent is a group of its own, with the same index.
    for (const auto& row : responses->label_rows()) out.labels.push_back(statistics_of(row));
    out.histograms = [responses, window = options.window](double bin) {
        if (!(bin >= 0)) throw InputError("a bin must be above 0 s");
        std::vector<TrialHistogram> all;
        for (const auto& h : value_or_throw(responses->histograms(bin > 0 ? bin : responses->default_bin(window), window)))
            all.push_back(histogram_of(h));
        return all;
    };
    return out;
}

std::vector<RecordedTrial> read_recording_trials(const std::string& path, const std::vector<std::string>& by, const std::string& label,
                                                 const Options& options) {
    if (by.empty()) throw InputError("by: name the column that identifies a trial");
    std::vector<RecordedTrial> out;
    const auto reading = api::recording_options(options);
    for (auto& trial : value_or_throw(open_trial_recordings(path, reading, {by, label.empty() ? std::nullopt : std::optional(label)})))
        out.push_back({std::move(trial.label), api::read_force(*trial.source, reading.unit.has_value())});
    return out;
}

}  // namespace corpuscle
