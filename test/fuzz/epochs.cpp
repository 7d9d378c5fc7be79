// Arbitrary bytes as a table of epochs. Expected: trials in order of time with finite times, or an error that names an existing line.

#include "run/trials/epoch_table.hpp"

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
    static const std::string path = "/tmp/corpuscle-fuzz-epochs-" + std::to_string(::getpid()) + ".csv";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data, 1, size, f);
        std::fclose(f);
    }
    const auto table = read_epochs(path);
    if (!table) {
        require(!table.error().message.empty());
        const bool is_gzip = size > 1 && data[0] == 0x1f && data[1] == 0x8b;  // the number of lines is unknown
        require(is_gzip || table.error().location.line <= 1 + std::count(data, data + size, '\n'));
        return 0;
    }
    require(!table->trials.empty());
    double last = -INFINITY;
    for (const auto& t : table->trials) {
        require(std::isfinite(t.start) && std::isfinite(t.stop) && t.start < t.stop && t.start >= last);
        last = t.start;
    }
    const auto aligned = align_trials(table->trials, 0, 10, std::vector<double>{1, 2}, {.alignment = AlignmentPoint::onset});
    if (!aligned) return require(!aligned.error().message.empty()), 0;
    for (const auto& t : *aligned) require(!t.has_zero() || (t.from <= t.to && t.zero + t.to <= 10 + 1e-9));
    return 0;
}
