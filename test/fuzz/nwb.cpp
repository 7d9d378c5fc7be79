// Arbitrary bytes as an NWB file: its spikes and its force. The HDF5 library may crash, but only in its own process.

#include <algorithm>
#include <limits>

#include "io/spikes/spike_files.hpp"
#include "recording.hpp"

namespace {

using namespace corpuscle;

/// Trains must be in order and finite, or there must be an error with a message.
void read_units(const std::string& path, const SpikeColumns& columns) {
    const auto trains = read_spikes(path, columns);
    if (!trains) return fuzz::check(trains.error(), 0);
    for (const auto& train : *trains) {
        fuzz::require(std::is_sorted(train.times.begin(), train.times.end()));
        for (const double t : train.times) fuzz::require(std::isfinite(t));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = "/tmp/corpuscle-fuzz-units-" + std::to_string(::getpid()) + ".nwb";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    const std::string_view magic = "\x89HDF";
    if (size < 5 ||
        !std::equal(magic.begin(), magic.end(), data + 1, [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }))
        return 0;  // other bytes are other formats, for which there are other fuzzers
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data + 1, 1, size - 1, f);
        std::fclose(f);
    }
    read_units(path, data[0] & 1 ? SpikeColumns{{}, "id"} : SpikeColumns{});
    return fuzz::recording(data, size, ".nwb", std::numeric_limits<long>::max());
}
