#pragma once
// Finds the columns of a table of spikes that hold the times and identify the trains.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/spikes/spike_files.hpp"

namespace corpuscle {

struct ResolvedSpikeColumns {
    std::size_t time = 0;                                    ///< index of the column of spike times
    double seconds_per_unit = 1;                             ///< the unit of the spike times, in s
    std::optional<std::size_t> afferent = {}, channel = {};  ///< indices of the columns that identify the train; nullopt: no such column
};

/// Finds the columns by their headings, or as the user requests in `wanted`. `headings` has one element for each column, "" if the file has
/// no header. A missing or wrong column is an error. If the error concerns one column, sets `column` to its number, counted from 1.
Result<ResolvedSpikeColumns> find_spike_columns(const std::vector<std::string>& headings, const SpikeColumns& wanted, std::size_t& column);

}  // namespace corpuscle
