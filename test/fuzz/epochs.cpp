// Arbitrary bytes as a table of epochs. Expected: trials in order of time with finite times, or an error that names an existing line.

#include "run/trials/epoch_table.hpp"

#include <cmath>

#include "table_file.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto table = read_epochs(fuzz::write_table("epochs", data, size));
    if (!table) return fuzz::check_located(table.error(), data, size), 0;
    fuzz::require(!table->trials.empty());
    double last = -INFINITY;
    for (const auto& t : table->trials) {
        fuzz::require(std::isfinite(t.start) && std::isfinite(t.stop) && t.start < t.stop && t.start >= last);
        last = t.start;
    }
    const auto aligned = align_trials(table->trials, 0, 10, std::vector<double>{1, 2}, {.alignment = AlignmentPoint::onset});
    if (!aligned) return fuzz::require(!aligned.error().message.empty()), 0;
    for (const auto& t : *aligned) fuzz::require(!t.has_zero() || (t.from <= t.to && t.zero + t.to <= 10 + 1e-9));
    return 0;
}
