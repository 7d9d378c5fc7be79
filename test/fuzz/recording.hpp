#pragma once
// Reads arbitrary bytes as a recording of one file format. Every force must be finite, or there must be an error with a message.

#include <pthread.h>
#include <sanitizer/common_interface_defs.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "io/recording/recording.hpp"
#include "require.hpp"

namespace corpuscle::fuzz {

/// An error must have a message and name a line up to `lines`, if any. A helper process may crash (by a signal or a sanitizer), but must
/// not send an invalid response.
inline void check(const Error& error, long lines) {
    require(!error.message.empty() && error.location.line <= lines);
    require(!error.message.starts_with("invalid response of the helper"));
}

/// Reads up to 50 blocks; all forces must be finite.
inline void read_all(const std::string& path, const RecordingOptions& options, long lines) {
    auto source = open_recording(path, options);
    if (!source) return check(source.error(), lines);
    require(!(*source)->channels().empty());
    require((*source)->clock().T() > 0);
    Frames block((*source)->channels().size(), 64);
    for (int k = 0; k < 50; ++k) {  // limited, because resampling can turn a short file into many samples
        if (auto ok = (*source)->read(block); !ok) return check(ok.error(), lines);
        if (block.count == 0) return;
        for (const auto& channel : block.force)
            for (std::size_t n = 0; n < block.count; ++n) require(std::isfinite(channel[n]));
    }
}

/// One input of the fuzzer: the bits of the first byte select the options, the other bytes are the file. `lines`: the largest line number
/// that an error may name.
inline int recording(const std::uint8_t* data, std::size_t size, const std::string& extension, long lines) {
    if (size < 1) return 0;
    static const std::string path = "/tmp/corpuscle-fuzz-" + std::to_string(::getpid()) + extension;
    static const bool once = [] {                                                             // at the first call
        ::pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });  // a child's crash is not a failure
        return std::atexit([] { std::remove(path.c_str()); }), true;
    }();
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
    if (data[0] & 64) options.bad_fields = BadFields::interpolate, options.despike.emplace(), options.notch = {12}, options.lowpass = 9;
    if (data[0] & 128) options.bad_fields = BadFields::drop, options.range = std::pair{-1e6, 1e6}, options.offset = 3;
    read_all(path, options, lines);
    return 0;
}

}  // namespace corpuscle::fuzz
