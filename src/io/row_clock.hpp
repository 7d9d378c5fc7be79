#pragma once
// When each row of a table was sampled: from its time column, or from the rate that the user gives.

#include <optional>
#include <string>
#include <vector>

#include "io/recording.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

struct RowClock {
    std::optional<std::size_t> column;  ///< of the time
    double seconds_per_unit = 1;        ///< of that column
    double origin = 0;                  ///< of that column, in its unit: what counts as 0 s
    bool by_times = false;              ///< rows stand at their own uneven times; else on the clock
    bool drops_untimed = false;         ///< rows whose time is not readable are left out
    Clock clock;
    std::int64_t gaps = 0;  ///< steps longer than one and a half times the median step
    std::vector<std::string> remarks;

    double seconds(double time) const { return (time - origin) * seconds_per_unit; }
};

/// Reads the table once for its times, if it has some, and rewinds it. An uneven clock needs `rate` or `resample`.
/// Rows that are dropped for what stands in `channels` do not count.
Result<RowClock> find_row_clock(Table&, const RecordingOptions&, const std::string& path, std::optional<std::size_t> time,
                                const std::vector<std::size_t>& channels);

}  // namespace corpuscle
