// Arbitrary bytes as a recording of three-axis sensors, and after a line "---" a layout with their axes. Expected: finite normal force and
// shear, or an error.

#include <algorithm>
#include <limits>

#include "io/recording/force_axes.hpp"
#include "recording.hpp"

using namespace corpuscle;

namespace {

/// Writes a temporary file, which is removed at the end, and returns its path.
std::string write_file(const std::string& name, std::string_view text) {
    const auto path = "/tmp/corpuscle-fuzz-" + std::to_string(::getpid()) + name;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(text.data(), 1, text.size(), f);
        std::fclose(f);
    }
    return path;
}

void remove_files() {
    for (const char* name : {"-axes.csv", "-axes-layout.csv"})
        std::remove(("/tmp/corpuscle-fuzz-" + std::to_string(::getpid()) + name).c_str());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bool once = [] { return std::atexit(remove_files), true; }();
    (void)once;
    const std::string_view all(reinterpret_cast<const char*>(data), size);
    const auto divider = all.find("\n---\n");
    RecordingOptions options{.rate = 100};
    const auto path = write_file("-axes.csv", all.substr(0, divider));
    if (divider != all.npos) options.layout = write_file("-axes-layout.csv", all.substr(divider + 5));
    constexpr auto any_line = std::numeric_limits<long>::max();
    const auto source = open_recording(path, options);
    if (!source) return fuzz::check(source.error(), any_line), 0;
    const auto channels = (*source)->channels().size();
    fuzz::require(channels > 0);
    Frames block(channels, 64, true);
    for (int k = 0; k < 50; ++k) {
        if (const auto ok = (*source)->read(block); !ok) return fuzz::check(ok.error(), any_line), 0;
        if (block.count == 0) break;
        for (const auto* component : {&block.force, &block.shear_x, &block.shear_y})
            for (std::size_t c = 0; c < channels; ++c)
                for (std::size_t n = 0; n < block.count; ++n) fuzz::require(std::isfinite((*component)[c][n]));
    }
    for (const auto& m : (*source)->quality().metrics) fuzz::require(m.channel < channels);
    return 0;
}
