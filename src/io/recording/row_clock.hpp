#pragma once
// Determines when each row of a table was sampled, from its time column, or from the rate that the user or the file states.

#include "io/recording/recording.hpp"

namespace corpuscle {

struct RowClock {
    std::optional<std::size_t> time_column;  ///< nullopt: the table has none
    double seconds_per_unit = 1;             ///< the unit of the time column, in s
    double origin = 0;                       ///< the value in the time column that becomes 0 s
    bool uses_row_times = false;             ///< true: each row has its own time, because the times are uneven; false: rows follow `clock`
    bool drops_untimed = false;              ///< true: rows whose time cannot be read are dropped
    Clock clock;                             ///< of the rows; with uses_row_times, of the resampled samples
    std::int64_t gap_count = 0;  ///< number of time steps longer than 1.5 times the median step; 0 if more than one step in 20 is so long
    std::vector<std::string> notes;  ///< notes for the user about the times

    /// The time in s of a value in the time column.
    double seconds(double time) const { return (time - origin) * seconds_per_unit; }
};

/// Determines the clock of the rows. `column` is the index of the time column, if there is one: the function then reads all times and
/// rewinds the table. Uneven times are an error unless the options give `rate` or `resample`. If the options drop rows with a bad value,
/// the times of rows that are dropped because of a value in `channels` (indices of columns) are ignored.
Result<RowClock> find_row_clock(Table&, const RecordingOptions&, const std::string& path, std::optional<std::size_t> column,
                                const std::vector<std::size_t>& channels);

}  // namespace corpuscle
