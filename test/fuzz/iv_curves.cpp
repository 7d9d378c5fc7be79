// Arbitrary bytes as a table of I-V curves. Expected: points with finite numbers in curves without gaps, or an error that names an existing
// line.

#include <cmath>

#include "fit/iv/iv_data.hpp"
#include "table_file.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    IvOptions options;
    options.v_ds = {0.1};
    const auto read = read_iv_files({fuzz::write_table("iv_curves", data, size)}, options);
    if (!read) return fuzz::check_located(read.error(), data, size), 0;
    std::size_t end = 0;
    for (const auto& c : read->curves) {
        fuzz::require(c.begin == end && c.end > c.begin);
        end = c.end;
    }
    fuzz::require(end == read->points.size());
    for (const auto& p : read->points) {
        for (const double v : p.v) fuzz::require(std::isfinite(v));
        fuzz::require(std::isfinite(p.I_D) && std::isfinite(p.temperature) && p.device < read->devices.size());
        fuzz::require(read->devices[p.device].W > 0 && read->devices[p.device].L > 0);
    }
    return 0;
}
