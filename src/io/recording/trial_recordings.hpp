#pragma once
// Recordings in long format: one table with the rows of several trials, which one or more columns identify. Each trial becomes a recording
// of its own, with its own clock; its times may restart or go on.

#include "io/recording/recording.hpp"

namespace corpuscle {

struct TrialColumns {
    std::vector<std::string> by;              ///< names of the columns that together identify a trial
    std::optional<std::string> label = {};  ///< the column of the label; nullopt: the label is the name of the file
};

struct TrialRecording {
    std::string label;
    std::unique_ptr<ForceSource> source;  ///< "press trial 3"
};

/// Opens the trials of a table, in the order of their first rows. Rows of a trial need not be adjacent. The columns that are read are kept in
/// memory.
Result<std::vector<TrialRecording>> open_trial_recordings(const std::string& path, const RecordingOptions&, const TrialColumns&);

}  // namespace corpuscle
