#pragma once
// A layout file: which channels are sensors, what they are called, where they sit.

#include <optional>
#include <string>
#include <vector>

#include "io/table.hpp"
#include "signal/source.hpp"

namespace corpuscle {

struct Placed {
    std::size_t column;  ///< of the table
    std::string name;    ///< "": as the table calls it
    std::optional<Position> position;
};

struct Layout {
    std::vector<Placed> sensors;
    bool metres = true;  ///< false: the file gives no unit of length
};

/// Reads a table of text with a header. `channel` (or `sensor`) names a channel, or counts it as --channel does; `name` gives it a
/// new name; `x`, `y`, `z` say where it sits ("x_mm", "x [m]"; without a unit only the pattern is meant). Other columns are passed over.
Result<Layout> read_layout(const std::string& path, const Table&, std::optional<std::size_t> time);

}  // namespace corpuscle
