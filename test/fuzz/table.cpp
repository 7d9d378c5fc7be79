// Arbitrary bytes as a table (CSV or JSON, also gzip or UTF-16). Expected: finite numbers, or an error that names an existing line.

#include <algorithm>
#include <limits>

#include "recording.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const bool is_gzip = size > 2 && data[1] == 0x1f && data[2] == 0x8b;  // the number of lines is unknown
    const auto lines = is_gzip ? std::numeric_limits<long>::max() : size > 1 ? std::count(data + 1, data + size, '\n') + 1 : 1;
    return corpuscle::fuzz::recording(data, size, ".csv", lines);
}
