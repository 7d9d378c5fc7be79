#pragma once
// The readers of the formats of tables of epochs, and what they share. Use read_epochs(), which recognises the format.

#include <string_view>

#include "run/trials/epoch_table.hpp"

namespace corpuscle {

/// Names of the column of labels, in lower case. The first one that a table has is read.
inline constexpr std::string_view epoch_label_names[] = {"label", "condition", "trial_type", "stimulus", "class"};
inline constexpr std::string_view default_trial_label = "trial";  ///< of all trials of a table without such a column

/// Puts trials in order of time, and notes which columns were not read.
EpochTable make_epoch_table(std::vector<Trial>, const std::vector<std::string>& unused, bool has_labels);

/// The trials of an NWB file. Errors name the row, which NWB counts from 0.
Result<EpochTable> read_nwb_epochs(const std::string& path, const std::optional<std::string>& label);

}  // namespace corpuscle
