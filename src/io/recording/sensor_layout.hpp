#pragma once
// Reads a layout file, which states which channels of a recording are sensors, with their names and positions.

#include "core/force_source.hpp"
#include "io/table/table.hpp"

namespace corpuscle {

struct SensorPlacement {
    std::size_t column;                ///< index of the sensor's column in the table of the recording
    std::string name;                  ///< "": the name of the column
    std::optional<Position> position;  ///< nullopt: the layout states none
};

struct SensorLayout {
    std::vector<SensorPlacement> sensors;  ///< in the order of the file
    bool has_length_unit = true;           ///< false if a coordinate has no unit of length
};

/// Reads a text table with a header. Its column `channel` (or `sensor`) holds the name or number of a channel, as for --channel; the
/// optional column `name` gives the channel a new name. The columns `x`, `y` and `z` are the position ("x_mm", "x [m]"); without a unit
/// only relative positions are known. Other columns are ignored. `time` is the time column of the recording, if it has one.
Result<SensorLayout> read_sensor_layout(const std::string& path, const Table&, std::optional<std::size_t> time);

}  // namespace corpuscle
