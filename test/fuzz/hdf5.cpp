// Any bytes as a file of HDF5; the library may die of it, in its own process.

#include <limits>

#include "recording.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return corpuscle::fuzz::recording(data, size, ".h5", std::numeric_limits<long>::max());
}
