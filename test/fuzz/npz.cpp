// Arbitrary bytes as a file of several NumPy arrays.

#include <limits>

#include "recording.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return corpuscle::fuzz::recording(data, size, ".npz", std::numeric_limits<long>::max());
}
