#pragma once
// Which columns of a table are meant, and what one unit of them is in SI.

#include <optional>
#include <string>
#include <vector>

#include "io/recording.hpp"

namespace corpuscle {

/// The columns asked for, by name, name and unit ("fz_N"), number, or range ("2-5", "fx-fz") among those other than the time. If nothing
/// is asked for all of them, but what the table leaves out and what is in a unit that no force sensor has. `remarks` gets what was
/// left out and, where they were counted, what they are called.
Result<std::vector<std::size_t>> choose_columns(const Table&, std::optional<std::size_t> time, const std::vector<std::string>& wanted,
                                                const std::string& path, std::vector<std::string>* remarks = nullptr);

/// The time column: the one asked for by name or number, none, or the one the file shows.
Result<std::optional<std::size_t>> choose_time(const Table&, const std::optional<std::string>& wanted, const std::string& path);

/// The factor from what stands in the column to newtons.
Result<double> newtons_per_unit(const Column&, const RecordingOptions&, const std::string& path);

/// The factor from what stands in a time column to seconds.
Result<double> seconds_per_unit(const Column&, const RecordingOptions&, const std::string& path);

}  // namespace corpuscle
