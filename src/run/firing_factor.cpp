#include "run/firing_factor.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

constexpr double max_factor = 1e6;
constexpr double factor_tolerance = 1.02;  // the search stops when its bounds differ by this ratio

/// True if the afferent fires at least once when the force is multiplied by `factor`. False after an error.
bool fires_with_factor(const Afferent& afferent, std::span<const double> force, double factor) {
    constexpr std::size_t block = 4096;
    std::vector<double> scaled(block);
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    auto state = afferent.start();
    for (std::size_t at = 0; at < force.size(); at += block) {
        const auto count = std::min(block, force.size() - at);
        for (std::size_t k = 0; k < count; ++k) scaled[k] = factor * force[at + k];
        if (!afferent.respond({scaled.data(), count}, state, response)) return false;
        if (!spikes.empty()) return true;
    }
    return false;
}

}  // namespace

bool fires(const AfferentPlan& plan, const SimulationOptions& run, std::span<const double> force) {
    return fires_with_factor(*make_afferent(plan, run), force, 1);
}

std::optional<double> factor_to_fire(const AfferentPlan& plan, const SimulationOptions& run, std::span<const double> force) {
    const auto afferent = make_afferent(plan, run);
    double low = 1, high = 1;  // it fires at `high`, and not at `low` unless both are 1
    while (!fires_with_factor(*afferent, force, high)) {
        if (high >= max_factor) return {};
        low = high, high *= 2;
    }
    while (high > low * factor_tolerance) {
        const double midpoint = std::sqrt(low * high);
        (fires_with_factor(*afferent, force, midpoint) ? high : low) = midpoint;
    }
    return high;
}

std::string format_rounded_up(double x) {
    if (!(x > 0) || !std::isfinite(x)) return fmt::format("{:g}", x);
    const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
    return fmt::format("{:.6g}", std::ceil(x / unit - 1e-9) * unit);
}

}  // namespace corpuscle
