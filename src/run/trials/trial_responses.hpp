#pragma once
// Responses to trials: the spikes of each afferent in each trial with their measures, the statistics over trials with the same label, and
// the histogram of their spikes around the point of alignment (PSTH).

#include <map>

#include "measure/measures.hpp"
#include "run/summary/run_summary.hpp"
#include "run/trials/aligned_trial.hpp"

namespace corpuscle {

/// An afferent of trials: the same afferent on the same channel of every input.
struct TrialAfferent {
    std::string name, channel;
    std::size_t group = 0;  ///< afferents of a group are averaged: on channels a single one, in a skin those of a class in a region
};

struct TrialGroup {
    std::string name, channel;
    std::size_t afferents = 0;  ///< their number
};

/// Groups of afferents, over each of which a histogram averages.
struct TrialGrouping {
    std::vector<TrialGroup> groups;
    std::vector<std::size_t> group_of;  ///< for each afferent, the index of its group
};

/// The response of one afferent in one trial.
struct TrialResponse {
    std::size_t trial = 0, afferent = 0;  ///< indexes
    std::vector<double> spikes = {};      ///< s, relative to the point of alignment
    std::vector<double> values = {};      ///< of all `measures`; NaN if undefined
};

/// Every measure of the spikes of one trial, in its measured part. The latency counts from the point of alignment. NaN if the trial has no
/// such point.
std::vector<double> trial_values(std::span<const double> train, const AlignedTrial&);

/// Statistics over the trials of a label, for one group.
struct LabelRow {
    std::string label;
    std::size_t group = 0;
    std::vector<CopyStatistics> statistics;  ///< one for each of `measures`; `copies` is the number of trials with a value
};

/// A bin of a histogram, s relative to the point of alignment. `rate` has the mean rate of the group in each trial that covers the bin, Hz.
struct HistogramBin {
    double from = 0, to = 0;
    std::int64_t spikes = 0;
    CopyStatistics rate = {};

    double standard_error() const;
};

struct Histogram {
    std::string label;
    std::size_t group = 0;
    std::vector<HistogramBin> bins;
};

class TrialResponses {
    using Names = std::pair<std::string, std::string>;  // of an afferent or group, and of its channel
    std::map<Names, std::size_t> afferent_indexes_, group_indexes_;
    std::vector<std::vector<std::vector<double>>> group_values_;  // [trial][group]: means of all measures over the afferents of the group

    void add_trial(const AlignedTrial&, std::span<const std::vector<double>> trains, std::span<const std::size_t> indexes);

public:
    std::vector<AlignedTrial> trials;
    std::vector<TrialAfferent> afferents;
    std::vector<TrialGroup> groups;
    bool keeps_silent = true;              ///< true: `responses` has also those without a spike
    std::vector<TrialResponse> responses;  ///< in order of trial, then afferent

    /// The index of an afferent, which is added if it is new.
    std::size_t add_afferent(const std::string& name, const std::string& channel, const std::string& group_name);
    /// Adds the trials of one input. `trains`: the spike times of its afferents, s on the clock of the trials; `indexes`: those of the
    /// afferents.
    void add(std::span<const AlignedTrial>, std::span<const std::vector<double>> trains, std::span<const std::size_t> indexes);

    /// A width of bins, s, of which 25 to 62 fill the window, or without one the longest trial: 1, 2 or 5 times a power of ten.
    double default_bin(const std::optional<std::pair<double, double>>& window) const;
    /// All labels, in order of their first trial.
    std::vector<std::string> labels() const;
    /// For each label, a row for each group.
    std::vector<LabelRow> label_rows() const;
    /// The histograms of all groups and labels in bins of `width` s. The first bin begins at the start of `window`, and the last one ends
    /// with it and may be shorter. Without a window, the bins cover all trials, and 0 is an edge. A bin includes its start and excludes its
    /// end. A trial counts in the bins that its measured part covers.
    /// More than max_histogram_bins bins are an error.
    Result<std::vector<Histogram>> histograms(double width, const std::optional<std::pair<double, double>>& window) const;
    /// The same for other groups.
    Result<std::vector<Histogram>> histograms(double width, const std::optional<std::pair<double, double>>& window,
                                              const TrialGrouping&) const;
    /// The groups of the same name on all channels as one group, without a channel. In a skin: its classes, over all regions.
    TrialGrouping groups_by_name() const;
};

inline constexpr std::size_t max_histogram_bins = 1'000'000;

}  // namespace corpuscle
