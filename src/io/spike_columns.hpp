#pragma once
// Finds the columns of a table of spikes that hold the times and identify the trains.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/spike_files.hpp"

namespace corpuscle {

struct ResolvedSpikeColumns {
    std::size_t time = 0;
    double seconds_per_unit = 1;  ///< unit of the time column
    std::optional<std::size_t> afferent = {}, channel = {};
};

/// `headings` are the header fields of the file, "" without a header. If a column is missing or wrong, returns an error. Sets `column` to
/// the number of a wrong column, counted from 1.
Result<ResolvedSpikeColumns> find_spike_columns(const std::vector<std::string>& headings, const SpikeColumns& wanted, std::size_t& column);

}  // namespace corpuscle
