#pragma once
// Trials: parts of a recording, or complete inputs of a run, that are compared with each other. They may overlap.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// A trial [start, stop). An epoch of a table, a contact, or a complete input.
struct Trial {
    double start = 0, stop = 0;  ///< s, on the clock of its input
    std::string label = {};      ///< trials with the same label are averaged
    long line = 0;               ///< of its table; 0: it is not of a text table
};

/// The point of a trial at which its time is 0: its start, or the first contact onset in it.
enum class AlignmentPoint { start, onset };

/// How trials are found and aligned.
struct TrialOptions {
    std::string table = {};           ///< path of a table of epochs; "": none
    bool are_contacts = false;        ///< true: each contact is a trial
    std::vector<std::string> by = {};  ///< columns that identify the trials of a recording in long format; each trial is then an input
    std::optional<std::string> label = {};  ///< column of the labels, of the table or of the recording
    std::optional<AlignmentPoint> alignment = {};  ///< default: start
    /// s, the measured part around the point of alignment. Default: the complete trial.
    std::optional<std::pair<double, double>> window = {};
    std::optional<double> onset_threshold = {};  ///< N; default: automatic

    /// True if any option was given.
    bool is_used() const { return !table.empty() || are_contacts || !by.empty() || alignment || window; }
    /// True if trials begin at contact onsets or are aligned to them.
    bool uses_onsets() const { return are_contacts || alignment == AlignmentPoint::onset; }
};

/// A trial with its time of alignment. Without a contact onset in it, all other times are NaN.
struct AlignedTrial : Trial {
    double zero = 0;          ///< s, on the clock of the input
    double begin = 0, end = 0;  ///< s, on the clock of the input: the measured part, that part of the window in which there is a recording
    double from = 0, to = 0;    ///< s, the same relative to `zero`
    std::size_t input = 0;    ///< index of its input

    bool has_zero() const { return zero == zero; }
    /// The part of ascending spike times (on the clock of the input) in the measured part.
    std::span<const double> spikes_of(std::span<const double> train) const;
};

/// Aligns trials of a recording that lasts from `start` to `stop` (s, on its clock). `onsets`: of the contacts, ascending, on the same clock;
/// needed for AlignmentPoint::onset. A trial outside of the recording is an error.
Result<std::vector<AlignedTrial>> align_trials(std::span<const Trial>, double start, double stop, std::span<const double> onsets,
                                               const TrialOptions&);

/// The label of trials that are complete files: the name of the file without the number at its end, "press" for "press_03".
std::string label_of_input(const std::string& name);

}  // namespace corpuscle
