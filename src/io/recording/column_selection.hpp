#pragma once
// Selects the channels and the time column of a table, and determines their units. `path` is the path of the file, for messages.

#include "io/recording/force_axes.hpp"

namespace corpuscle {

/// The indices of the requested columns. `wanted` are the arguments of --channel: names, names with units ("fz_N"), numbers, and ranges
/// ("2-5", "fx-fz"). Numbers count the columns from 1, without the time column. If `wanted` is empty, selects all columns except the time,
/// those that the table excludes, and those in units that are not forces. Appends to `notes` which columns were excluded, and the names of
/// columns that were selected by number.
Result<std::vector<std::size_t>> select_columns(const Table&, std::optional<std::size_t> time, const std::vector<std::string>& wanted,
                                                const std::string& path, std::vector<std::string>* notes = nullptr);

/// The index of the time column. `wanted` is its name, its number (counted from 1), or "none"; by default, it is the time column that the
/// table found in the file. nullopt: the table has no time column.
Result<std::optional<std::size_t>> select_time_column(const Table&, const std::optional<std::string>& wanted, const std::string& path);

/// Returns an error if --unit and --scale contradict each other.
Result<void> check_unit_options(const RecordingOptions&);

/// The factor that converts a column's values to newtons. A unit that is not a force is an error. `selection` is the last remedy in its
/// message.
Result<double> newtons_per_unit(const Column&, const RecordingOptions&, const std::string& path,
                                std::string_view selection = "--channel to select another column");

/// True if neither the heading nor an option gives the unit of a column.
bool lacks_unit(const Column&, const RecordingOptions&);
/// The note that the columns of these names have no unit; "" without names.
std::string unitless_note(std::vector<std::string> names);
/// The note that --unit overrides the unit in the heading; "" if it does not.
std::string overridden_unit_note(const Column&, const RecordingOptions&);

/// The factor that converts the values of a time column to seconds. A unit that is not a time is an error.
Result<double> seconds_per_unit(const Column&, const RecordingOptions&, const std::string& path);

struct SensorPlacement {
    std::size_t column;                ///< index of the sensor's column in the table of the recording, or of a three-axis sensor
    std::string name;                  ///< "": the name of the column
    std::optional<Position> position;  ///< nullopt: the layout states none
    SensorAxes axes = {};              ///< of a three-axis sensor
};

/// A layout file, which states which channels of a recording are sensors, with their names and positions.
struct SensorLayout {
    std::vector<SensorPlacement> sensors;  ///< in the order of the file
    bool has_length_unit = true;           ///< false if a coordinate has no unit of length
};

/// Reads a text table with a header. Its column `channel` (or `sensor`) holds the name or number of a channel, as for --channel; the
/// optional column `name` gives the channel a new name. The columns `x`, `y` and `z` are the position ("x_mm", "x [m]"); without a unit
/// only relative positions are known. Other columns are ignored. `time` is the time column of the recording, if it has one.
///
/// If the recording has three-axis sensors, `channel` holds the name or number of one of them. The optional columns x_axis, y_axis and
/// z_axis are the directions of its axes on the skin, see parse_sensor_axes().
Result<SensorLayout> read_sensor_layout(const std::string& path, const Table&, std::optional<std::size_t> time,
                                        std::span<const AxisSensor> = {});

}  // namespace corpuscle
