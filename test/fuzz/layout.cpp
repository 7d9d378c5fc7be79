// Arbitrary bytes as the layout of a recording with three channels. Expected: a selection of the channels, or an error that
// names an existing line.

#include <algorithm>

#include "recording.hpp"

using namespace corpuscle;

namespace {

/// Writes a temporary file and returns its path.
std::string write_file(const std::string& name, const void* bytes, std::size_t size) {
    const auto path = "/tmp/corpuscle-fuzz-" + std::to_string(::getpid()) + name;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(bytes, 1, size, f);
        std::fclose(f);
    }
    return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string text = "time_s,a_N,b_N,c_N\n0,1,2,3\n1,1,2,3\n2,1,2,3\n",
                             force = write_file("-force.csv", text.data(), text.size());
    static const std::string layout = write_file("-layout.csv", "", 0);
    static const bool once = [] { return std::atexit([] { std::remove(force.c_str()), std::remove(layout.c_str()); }), true; }();
    (void)once;
    write_file("-layout.csv", data, size);
    const auto source = open_recording(force, {.layout = layout});
    if (!source) {
        fuzz::check(source.error(), 1 + std::count(data, data + size, '\n'));
        return 0;
    }
    const auto& channels = (*source)->channels();
    fuzz::require(!channels.empty() && channels.size() <= 3);
    for (const auto& c : channels)
        if (c.position) fuzz::require(std::isfinite(c.position->x) && std::isfinite(c.position->y) && std::isfinite(c.position->z));
    return 0;
}
