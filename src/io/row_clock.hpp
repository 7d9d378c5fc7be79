#pragma once
// Determines when each row of a table was sampled, from its time column or from the rate that the user gives.

#include <optional>
#include <string>
#include <vector>

#include "io/recording.hpp"
#include "signal/clock.hpp"

namespace corpuscle {

struct RowClock {
    std::optional<std::size_t> time_column;
    double seconds_per_unit = 1;  ///< unit of the time column
    double origin = 0;            ///< the value of the time column that becomes 0 s
    bool uses_row_times = false;  ///< true: rows have their own, uneven times, false: rows follow `clock`
    bool drops_untimed = false;   ///< true: rows without a readable time are dropped
    Clock clock;
    std::int64_t gap_count = 0;  ///< number of steps longer than 1.5 times the median step
    std::vector<std::string> notes;

    double seconds(double time) const { return (time - origin) * seconds_per_unit; }
};

/// Reads all times of the table, if it has a time column, and rewinds it. An uneven clock requires `rate` or `resample`.
/// Rows that are dropped because of a bad value in `channels` are ignored.
Result<RowClock> find_row_clock(Table&, const RecordingOptions&, const std::string& path, std::optional<std::size_t> time,
                                const std::vector<std::size_t>& channels);

}  // namespace corpuscle
