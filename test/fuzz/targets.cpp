// Arbitrary bytes as a table of targets. Expected: rows with finite numbers in order, or an error that names an existing line.

#include "fit/targets/target_table.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

using namespace corpuscle;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = "/tmp/corpuscle-fuzz-targets-" + std::to_string(::getpid()) + ".csv";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data, 1, size, f);
        std::fclose(f);
    }
    const auto rows = read_targets(path);
    if (!rows) {
        require(!rows.error().message.empty());
        const bool is_gzip = size > 1 && data[0] == 0x1f && data[1] == 0x8b;  // the number of lines is unknown
        require(is_gzip || rows.error().location.line <= 1 + std::count(data, data + size, '\n'));
        return 0;
    }
    require(!rows->empty());
    for (const auto& r : *rows) {
        require(r.measure != nullptr && std::isfinite(r.low) && std::isfinite(r.high) && std::isfinite(r.weight) && r.weight > 0);
        require(r.low <= r.value && r.value <= r.high && r.low < r.high);
        require(!r.window || r.window->first < r.window->second);
    }
    return 0;
}
