// How fast is a text recording read, and how much memory does it use?
//
//     bench-read [MEGABYTES [FOLDER]]      default: 200 MB, the present folder
//
// Method: a CSV file with a column of times and 16 channels of footsteps, two decimals, is written to FOLDER, then read completely in these
// ways:
// - only its bytes, by fread, which is the limit;
// - its numbers, every column into blocks;
// - as a recording of force with all checks, at a given rate (one pass) and with the clock of its column of times (two passes).
// Output: bytes per wall second, and the peak memory of the process so far.

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "io/recording/recording.hpp"
#include "io/recording/recording_formats.hpp"

namespace {

using namespace corpuscle;

/// Writes the file of footsteps.
void write_steps(const std::string& path, double megabytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    std::string text = "time_s";
    for (int c = 1; c <= 16; ++c) text += fmt::format(",ch{}_N", c);
    double written = 0;
    for (std::int64_t k = 0; written < megabytes * 1e6; ++k) {
        text += fmt::format("\n{:.2f}", static_cast<double>(k) * 0.01);
        for (int c = 0; c < 16; ++c) {
            const double F = 400 * std::sin(0.06 * static_cast<double>(k) + 0.4 * c);
            F > 0 ? fmt::format_to(std::back_inserter(text), ",{:.2f}", F) : fmt::format_to(std::back_inserter(text), ",0");
        }
        if (text.size() < (1U << 20)) continue;
        written += static_cast<double>(std::fwrite(text.data(), 1, text.size(), file));
        text.clear();
    }
    std::fclose(file);
}

/// Times `work`, which reads the file and returns the number of rows or blocks. `bytes`: size of the file.
void report(const char* label, double bytes, const std::function<std::int64_t()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const auto rows = work();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    fmt::print("{:44} {:6.0f} MB/s {:6.2f} s {:12} rows, {:4} MB peak\n", label, bytes / seconds / 1e6, seconds, rows,
               used.ru_maxrss / 1024);
}

std::int64_t bytes_alone(const std::string& path) {
    std::FILE* file = std::fopen(path.c_str(), "rb");
    std::vector<char> block(1U << 20);
    std::int64_t blocks = 0;
    while (std::fread(block.data(), 1, block.size(), file) > 0) ++blocks;
    std::fclose(file);
    return blocks;
}

std::int64_t numbers(const std::string& path) {
    const auto table = open_text_table(path);
    std::vector<std::size_t> all((*table)->columns().size());
    for (std::size_t c = 0; c < all.size(); ++c) all[c] = c;
    std::vector<std::vector<double>> block(all.size());
    std::int64_t rows = 0;
    for (auto read = (*table)->read(all, rows_per_block, block); read && *read > 0; read = (*table)->read(all, rows_per_block, block))
        rows += static_cast<std::int64_t>(*read);
    return rows;
}

std::int64_t force(const std::string& path, const RecordingOptions& options) {
    const auto source = open_recording(path, options);
    Frames block((*source)->channels().size(), 4096);
    std::int64_t rows = 0;
    while ((*source)->read(block) && block.count > 0) rows += static_cast<std::int64_t>(block.count);
    return rows;
}

}  // namespace

int main(int argc, char** argv) {
    const double megabytes = argc > 1 ? std::atof(argv[1]) : 200;
    const std::string path = std::string(argc > 2 ? argv[2] : ".") + "/bench-read.csv";
    write_steps(path, megabytes);
    const auto bytes = static_cast<double>(std::filesystem::file_size(path));
    bytes_alone(path);  // warm-up: a file that fits into memory is cached for all measurements
    report("bytes alone (blocks of 1 MB)", bytes, [&] { return bytes_alone(path); });
    report("numbers", bytes, [&] { return numbers(path); });
    RecordingOptions by_rate, by_clock;
    by_rate.channels = {"2-17"}, by_rate.time = "none", by_rate.rate = 100, by_rate.scale = by_clock.scale = 0.008;
    report("force, --time none --rate 100Hz: one pass", bytes, [&] { return force(path, by_rate); });
    report("force, on its own clock: two passes", bytes, [&] { return force(path, by_clock); });
    std::filesystem::remove(path);
}
