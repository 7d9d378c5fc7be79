// Arbitrary bytes as a .raw file. Expected: plots whose variables have equal numbers of values, or an error that names an existing line.

#include "io/spice/raw_file.hpp"

#include <algorithm>
#include <cstdint>

#include "require.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    const auto plots = parse_raw(bytes, "fuzz.raw");
    if (!plots) {
        fuzz::require(!plots.error().message.empty());
        fuzz::require(plots.error().location.line <= 2 + std::count(bytes.begin(), bytes.end(), '\n'));
        return 0;
    }
    fuzz::require(!plots->empty());
    for (const auto& plot : *plots) {
        fuzz::require(plot.points() > 0 && plot.values.size() == plot.variables.size());
        for (const auto& values : plot.values) fuzz::require(values.size() == plot.points());
    }
    return 0;
}
