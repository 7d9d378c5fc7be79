#pragma once
// Tables of epochs: the trials of a recording.

#include "run/trials/aligned_trial.hpp"

namespace corpuscle {

struct EpochTable {
    std::vector<Trial> trials;         ///< in order of their start; of equal starts, in order of their stop, then their label
    std::vector<std::string> notes;    ///< for the user about ignored columns
};

/// Reads a table with a header, as text or as JSON (a record on each line, or a list). Columns: start, stop or duration, and label, or other
/// names that such tables have (start_time, onset; trial_type, condition). A unit of time in a heading ("start_ms") is the unit of its
/// numbers; without one they are seconds. Of an NWB file, reads /intervals/trials. `label`: the name of the column of labels; nullopt: as
/// above. Errors name file, line and value.
Result<EpochTable> read_epochs(const std::string& path, const std::optional<std::string>& label = {});

}  // namespace corpuscle
