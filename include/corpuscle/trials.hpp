#pragma once
// Trials: parts of a force, or forces of their own, whose responses are compared. They may overlap.

#include <map>
#include <optional>

#include "corpuscle/respond.hpp"

namespace corpuscle {

/// A trial [start, stop) of a force, s on its clock. Trials with the same label are averaged.
struct Epoch {
    double start = 0, stop = 0;
    std::string label = "trial";
};

/// Reads a table start,stop,label (CSV, TSV, JSON lines; other names and units in doc/trials.md), or the trials of an NWB file, in order of
/// time. `label`: the column of the labels; "": the usual one. Throws InputError with file, line or row, and value.
CORPUSCLE_API std::vector<Epoch> read_trial_table(const std::string& path, const std::string& label = "");

/// The contacts of a force: the times at which it rises above a threshold, and returns to rest.
struct ForceContacts {
    double level = 0, noise = 0;        ///< N, at rest: median and standard deviation
    double threshold = 0, release = 0;  ///< N: a contact begins above `threshold` and ends below `release`
    std::vector<double> onsets = {};    ///< s
    std::vector<double> releases = {};  ///< s; infinite if the force ends in contact
};

/// Finds the contacts in a force, summed over its channels. `threshold` in N; default: from the noise at rest (doc/trials.md). Throws
/// InputError.
CORPUSCLE_API ForceContacts find_force_contacts(const ForceView&, std::optional<double> threshold = {});

/// How trials are aligned.
struct TrialAlignment {
    bool to_onset = false;                                    ///< true: time 0 is the first contact onset in a trial; false: its start
    std::optional<std::pair<double, double>> window = {};  ///< s, the measured part around time 0; default: the complete trial
    std::optional<double> onset_threshold = {};               ///< N; default: automatic
};

/// A response, its force and its trials. The force is needed for onsets only.
struct TrialSource {
    const Response* response = nullptr;
    ForceView force = {};
    std::vector<Epoch> trials = {};
};

/// The response of one afferent in one trial.
struct AlignedResponse {
    std::size_t trial = 0, afferent = 0;  ///< indexes
    std::vector<double> times = {};       ///< of spikes, s, relative to time 0 of the trial
    std::vector<double> values = {};      ///< of all measures, in the order of measure_catalogue(); NaN if undefined
};

/// Peri-stimulus time histogram of one label and afferent: for each bin, mean over the trials that cover it.
struct TrialHistogram {
    std::string label;
    std::size_t afferent = 0;                      ///< index
    std::vector<double> from = {}, to = {};        ///< s, edges of the bins
    std::vector<double> rate = {}, standard_error = {};  ///< Hz; NaN if undefined
    std::vector<std::int64_t> trials = {}, spikes = {};
};

/// Mean and standard deviation over the trials of a label, for one afferent and each measure. NaN if undefined.
struct LabelStatistics {
    std::string label;
    std::size_t afferent = 0;
    std::vector<double> mean = {}, standard_deviation = {};
    std::vector<std::int64_t> trials = {};  ///< that have a value
};

struct TrialAnalysis {
    std::vector<Epoch> trials = {};
    std::vector<std::size_t> source = {};           ///< for each trial, the index of its source
    std::vector<double> zero = {};                  ///< for each trial, time 0 on the clock of its force, s; NaN without a contact onset
    std::vector<double> from = {}, to = {};         ///< for each trial, the measured part relative to time 0, s
    std::vector<RespondingAfferent> afferents = {};  ///< the same afferent on the same channel of several sources is one
    std::vector<AlignedResponse> responses = {};    ///< of every afferent in every trial, in order of trial, then afferent
    std::vector<LabelStatistics> labels = {};
    /// The histograms in bins of this width in s; 0: a width that suits the trials. Throws InputError.
    std::function<std::vector<TrialHistogram>(double bin)> histograms = {};
};

/// Analyses trials. Throws InputError for a trial outside of its force, or without spikes and force to align.
CORPUSCLE_API TrialAnalysis analyse_trials(std::span<const TrialSource>, const TrialAlignment& = {});

/// A trial of a recording in long format.
struct RecordedTrial {
    std::string label;
    Force force;
};

/// Reads a table with several trials one below another. `by`: the columns that identify a trial; `label`: the column of the label, "": the name
/// of the file. Options as for read_recording(). Throws InputError.
CORPUSCLE_API std::vector<RecordedTrial> read_recording_trials(const std::string& path, const std::vector<std::string>& by,
                                                               const std::string& label = "", const Options& = {});

}  // namespace corpuscle
