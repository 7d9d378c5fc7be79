#pragma once
// Which columns of a table of spikes hold the times and tell trains apart.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/spikes.hpp"

namespace corpuscle {

struct SpikeColumnsFound {
    std::size_t time = 0;
    double seconds = 1;  ///< that one unit of it is
    std::optional<std::size_t> afferent = {}, channel = {};
};

/// `headings`: as they stand in the file; "" if it has none. An error says which are missing, and where a wrong one stands in `column`.
Result<SpikeColumnsFound> find_spike_columns(const std::vector<std::string>& headings, const SpikeColumns& wanted, std::size_t& column);

}  // namespace corpuscle
