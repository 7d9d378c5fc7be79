// Arbitrary bytes as an HDF5 file. The library may crash, but only in its own process.

#include <limits>

#include "recording.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return corpuscle::fuzz::recording(data, size, ".h5", std::numeric_limits<long>::max());
}
