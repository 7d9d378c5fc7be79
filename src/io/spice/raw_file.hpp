#pragma once
// Reads the .raw files of SPICE simulators: binary or text, one or several plots. LTspice's have a header in UTF-16 and single precision.

#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

struct RawPlot {
    std::string title, name;  ///< "DC transfer characteristic"
    std::vector<std::string> variables;
    std::vector<std::vector<double>> values;  ///< of each variable, as many as there are points

    std::size_t points() const { return values.empty() ? 0 : values[0].size(); }
};

inline constexpr std::size_t max_raw_bytes = std::size_t{256} << 20;

/// All plots of a file; at least one, each with at least one variable and one point. Complex plots are an error.
Result<std::vector<RawPlot>> read_raw_file(const std::string& path);
/// The same from the bytes of a file. `path` is for messages.
Result<std::vector<RawPlot>> parse_raw(std::string_view bytes, const std::string& path);

}  // namespace corpuscle
