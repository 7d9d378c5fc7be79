#include "circuit/export/force.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "circuit/force_order.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double within = 1e-4;  // of the largest force
constexpr int in_a_line = 6;     // points

/// The samples at which straight lines bend that stay within `allowed` of all others: each line is as long as it can be.
std::vector<std::int64_t> bends(const Trace& trace, std::int64_t last, double allowed) {
    const auto at = [&](std::int64_t k) { return trace.at(static_cast<double>(k) * trace.T()); };
    std::vector<std::int64_t> out{0};
    for (std::int64_t from = 0; from < last;) {
        double least = -std::numeric_limits<double>::infinity(), most = -least;
        std::int64_t to = from + 1;
        for (std::int64_t k = from + 1; k <= last; ++k) {
            const auto length = static_cast<double>(k - from);
            const double slope = (at(k) - at(from)) / length;
            if (slope < least || slope > most) break;  // a line to here would pass another sample too far away
            to = k;
            least = std::max(least, slope - allowed / length), most = std::min(most, slope + allowed / length);
        }
        out.push_back(from = to);
    }
    return out;
}

}  // namespace

Result<std::string> force_points(const Circuit& circuit, double scale) {
    const auto force = force_order(circuit);
    if (!force) return force.error();
    if (!*force) return std::string();
    const Trace& trace = **force;
    const std::int64_t last = trace.end() - 1 - (Trace::lag + 1);  // behind it the force stands still
    double largest = 0;
    for (std::int64_t k = 0; k <= last; ++k) largest = std::max(largest, std::abs(trace.at(static_cast<double>(k) * trace.T())));
    std::string out = "pwl(";
    int count = 0;
    for (const auto k : bends(trace, last, within * largest)) {
        const double t = static_cast<double>(k) * trace.T();
        out += fmt::format("{}{:.9g} {:.9g}", count == 0 ? "" : count % in_a_line == 0 ? "\n+ " : " ", t, scale * trace.at(t));
        ++count;
    }
    return out + ')';
}

}  // namespace corpuscle::circuit
