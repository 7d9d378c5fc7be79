#pragma once
// Reads a layout file: which channels are sensors, their names and their positions.

#include <optional>
#include <string>
#include <vector>

#include "io/table.hpp"
#include "signal/force_source.hpp"

namespace corpuscle {

struct SensorPlacement {
    std::size_t column;  ///< of the table
    std::string name;    ///< "": the name in the table
    std::optional<Position> position;
};

struct SensorLayout {
    std::vector<SensorPlacement> sensors;
    bool has_length_unit = true;  ///< false if the file has no unit of length
};

/// Reads a text table with a header. Column `channel` (or `sensor`) is the name or number of a channel, as for --channel. Column
/// `name` is an optional new name. Columns `x`, `y`, `z` are the position ("x_mm", "x [m]"; without a unit only relative positions
/// are known). Other columns are ignored.
Result<SensorLayout> read_sensor_layout(const std::string& path, const Table&, std::optional<std::size_t> time);

}  // namespace corpuscle
