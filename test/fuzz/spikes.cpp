// Arbitrary bytes as a spike file. Expected: sorted trains with finite times and names that are read back, or an error that names an
// existing line.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "core/text/csv_field.hpp"
#include "io/spikes/spike_files.hpp"
#include "run/compare/train_comparison.hpp"

using namespace corpuscle;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void write_file(const std::string& path, const void* data, std::size_t size) {
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data, 1, size, f);
        std::fclose(f);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = "/tmp/corpuscle-fuzz-spikes-" + std::to_string(::getpid()) + ".csv";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    write_file(path, data, size);
    const auto trains = read_spikes(path);
    if (!trains) {
        require(!trains.error().message.empty());
        const bool is_gzip = size > 1 && data[0] == 0x1f && data[1] == 0x8b;  // the number of lines is unknown
        require(is_gzip || trains.error().location.line <= 1 + std::count(data, data + size, '\n'));
        return 0;
    }
    std::string text = "afferent,channel,time_s\n";
    for (const auto& t : *trains) {
        require(std::is_sorted(t.times.begin(), t.times.end()));
        for (const double x : t.times) require(std::isfinite(x));
        text += quote_csv_field(t.afferent) + "," + quote_csv_field(t.channel) + ",0.5\n";
    }
    write_file(path, text.data(), text.size());
    const auto again = read_spikes(path);
    const bool has_line_breaks = std::any_of(trains->begin(), trains->end(), [](const auto& t) {
        return (t.afferent + t.channel).find_first_of(std::string_view("\r\n\0", 3)) != std::string::npos;
    });
    require(has_line_breaks || (again && again->size() == trains->size()));
    const auto pairs = pair_trains(*trains, *trains, {});
    require(bool(pairs));
    for (const auto& p : *pairs)
        if (p.a->times.size() < 100) require(compare_trains(p, {})->matched == p.a->times.size());
    return 0;
}
