// Any bytes as a recording: numbers that are finite, or an error that names a line that exists.

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "io/recording.hpp"

using namespace corpuscle;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void read_all(const std::string& path, const RecordingOptions& options, std::size_t lines) {
    auto source = open_recording(path, options);
    if (!source) return require(source.error().place.line <= static_cast<long>(lines) && !source.error().sentence.empty());
    require(!(*source)->channels().empty());
    require((*source)->clock().T() > 0);
    Frames block((*source)->channels().size(), 64);
    for (int k = 0; k < 50; ++k) {  // resampled, a short file may hold a great many samples
        if (auto ok = (*source)->read(block); !ok) return require(ok.error().place.line <= static_cast<long>(lines));
        if (block.count == 0) return;
        for (const auto& channel : block.force)
            for (std::size_t n = 0; n < block.count; ++n) require(std::isfinite(channel[n]));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1) return 0;
    static const std::string path = "/tmp/corpuscle-fuzz-" + std::to_string(::getpid()) + ".csv";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data + 1, 1, size - 1, f);
        std::fclose(f);
    }
    RecordingOptions options;
    if (data[0] & 1) options.rate = 100;
    if (data[0] & 2) options.resample = 30;
    if (data[0] & 4) options.scale = 1e-3;
    if (data[0] & 8) options.channels = {"1-2"};
    if (data[0] & 16) options.time = "none";
    options.absolute = data[0] & 32;
    std::size_t lines = 1;
    for (std::size_t k = 1; k < size; ++k) lines += data[k] == '\n';
    read_all(path, options, lines);
    return 0;
}
