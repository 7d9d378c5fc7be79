// Any bytes as a text of numbers: finite numbers, or an error that names a line that exists.

#include <algorithm>

#include "recording.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto lines = size > 1 ? std::count(data + 1, data + size, '\n') + 1 : 1;
    return corpuscle::fuzz::recording(data, size, ".csv", lines);
}
