// Arbitrary bytes as a file of one NumPy array.

#include <limits>

#include "recording.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return corpuscle::fuzz::recording(data, size, ".npy", std::numeric_limits<long>::max());
}
