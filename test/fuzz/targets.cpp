// Arbitrary bytes as a table of targets. Expected: rows with finite numbers in order, or an error that names an existing line.

#include "fit/targets/target_table.hpp"

#include <cmath>

#include "table_file.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto rows = read_targets(fuzz::write_table("targets", data, size));
    if (!rows) return fuzz::check_located(rows.error(), data, size), 0;
    fuzz::require(!rows->empty());
    for (const auto& r : *rows) {
        fuzz::require(r.measure != nullptr && std::isfinite(r.low) && std::isfinite(r.high) && std::isfinite(r.weight) && r.weight > 0);
        fuzz::require(r.low <= r.value && r.value <= r.high && r.low < r.high);
        fuzz::require(!r.window || r.window->first < r.window->second);
    }
    return 0;
}
