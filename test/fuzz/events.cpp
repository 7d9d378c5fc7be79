// Arbitrary bytes after the header of an address-event file, and as a stream's saved state. Expected: sorted trains with finite times, or
// an error with a message.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "io/spikes/spike_files.hpp"
#include "live/stream_state.hpp"

using namespace corpuscle;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = "/tmp/corpuscle-fuzz-events-" + std::to_string(::getpid());
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    for (const std::string first : {"corpaer1", "#!AER-DAT2.0\r\n", ""}) {
        if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
            std::fwrite(first.data(), 1, first.size(), f);
            std::fwrite(data, 1, size, f);
            std::fclose(f);
        }
        const auto trains = read_spikes(path);
        if (!trains) require(!trains.error().message.empty());
        if (trains)
            for (const auto& t : *trains) {
                require(!t.times.empty() && std::is_sorted(t.times.begin(), t.times.end()));
                for (const double x : t.times) require(std::isfinite(x));
            }
    }
    const auto state = unpack_stream({reinterpret_cast<const std::byte*>(data), size}, "state");
    if (!state) return require(!state.error().message.empty()), 0;
    const auto again = unpack_stream(pack_stream(*state), "state");
    require(again && again->force == state->force && again->number == state->number && again->skin == state->skin);
    return 0;
}
