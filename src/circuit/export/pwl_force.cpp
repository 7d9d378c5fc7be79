#include "circuit/export/pwl_force.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "circuit/afferent/force_directive.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double max_error = 1e-4;  // as a fraction of the largest force
constexpr int points_per_line = 6;

/// Numbers, from 0 to `last`, of the samples through which a piecewise linear curve passes that stays within `tolerance` (N) of all
/// samples. Each line is as long as possible.
std::vector<std::int64_t> select_breakpoints(const ForceWaveform& waveform, std::int64_t last, double tolerance) {
    const auto at = [&](std::int64_t k) { return waveform.at(static_cast<double>(k) * waveform.T()); };
    std::vector<std::int64_t> out{0};
    for (std::int64_t from = 0; from < last;) {
        double min_slope = -std::numeric_limits<double>::infinity(), max_slope = -min_slope;  // N per sample
        std::int64_t to = from + 1;
        for (std::int64_t k = from + 1; k <= last; ++k) {
            const auto length = static_cast<double>(k - from);
            const double slope = (at(k) - at(from)) / length;
            if (slope < min_slope || slope > max_slope)
                break;  // a line to this sample would miss an earlier one by more than the tolerance
            to = k;
            min_slope = std::max(min_slope, slope - tolerance / length), max_slope = std::min(max_slope, slope + tolerance / length);
        }
        out.push_back(from = to);
    }
    return out;
}

}  // namespace

Result<std::string> pwl_force(const Circuit& circuit, double scale) {
    const auto force = TRY(force_directive(circuit));
    if (!force) return std::string();
    const ForceWaveform& waveform = *force;
    // force_directive() appends lookahead + 1 samples with a constant force.
    const std::int64_t last = waveform.end_sample() - 1 - (ForceWaveform::lookahead + 1);
    double largest = 0;
    for (std::int64_t k = 0; k <= last; ++k) largest = std::max(largest, std::abs(waveform.at(static_cast<double>(k) * waveform.T())));
    std::string out = "pwl(";
    int count = 0;
    for (const auto k : select_breakpoints(waveform, last, max_error * largest)) {
        const double t = static_cast<double>(k) * waveform.T();
        out += fmt::format("{}{:.9g} {:.9g}", count == 0 ? "" : count % points_per_line == 0 ? "\n+ " : " ", t, scale * waveform.at(t));
        ++count;
    }
    return out + ')';
}

}  // namespace corpuscle::circuit
