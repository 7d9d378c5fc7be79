// Arbitrary bytes as an NWB file: its spikes, its trials or its force. The HDF5 library may crash or loop, but only in its own process. The
// first byte selects one of the three, because each takes a process, and a loop of the library takes a minute.

#include <algorithm>
#include <limits>

#include "core/text/utf8.hpp"
#include "io/spikes/spike_files.hpp"
#include "recording.hpp"
#include "run/trials/epoch_table.hpp"

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

/// Trials must be in order of time and finite, or there must be an error with a message.
void read_trials(const std::string& path, const std::optional<std::string>& label) {
    const auto table = read_epochs(path, label);
    if (!table) return fuzz::check(table.error(), 0);
    fuzz::require(!table->trials.empty());
    double last = -INFINITY;
    for (const auto& t : table->trials) {
        fuzz::require(std::isfinite(t.start) && std::isfinite(t.stop) && t.start < t.stop && t.start >= last && is_utf8(t.label));
        last = t.start;
    }
    for (const auto& note : table->notes) fuzz::require(is_utf8(note));
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
    switch (data[0] % 3) {
        case 0: return read_units(path, data[0] & 1 ? SpikeColumns{{}, "id"} : SpikeColumns{}), 0;
        case 1: return read_trials(path, data[0] & 2 ? std::optional<std::string>("block") : std::nullopt), 0;
        default: return fuzz::recording(data, size, ".nwb", std::numeric_limits<long>::max());
    }
}
