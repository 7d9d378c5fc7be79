#pragma once
// Selects columns of a table, and determines their units.

#include <optional>
#include <string>
#include <vector>

#include "io/recording.hpp"

namespace corpuscle {

/// The columns requested by name, name and unit ("fz_N"), number, or range ("2-5", "fx-fz"). Numbers do not count the time column.
/// If `wanted` is empty, selects all columns except those that the table excludes and those in units that a force sensor never has.
/// Appends notes about the excluded columns and about the names of columns selected by number.
Result<std::vector<std::size_t>> select_columns(const Table&, std::optional<std::size_t> time, const std::vector<std::string>& wanted,
                                                const std::string& path, std::vector<std::string>* notes = nullptr);

/// The time column requested by name or number; nullopt for "none". By default the time column found in the file, if there is one.
Result<std::optional<std::size_t>> select_time_column(const Table&, const std::optional<std::string>& wanted, const std::string& path);

/// The factor that converts the column's values to newtons.
Result<double> newtons_per_unit(const Column&, const RecordingOptions&, const std::string& path);

/// The factor that converts a time column's values to seconds.
Result<double> seconds_per_unit(const Column&, const RecordingOptions&, const std::string& path);

}  // namespace corpuscle
