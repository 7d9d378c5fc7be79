#include "study/sweep/pattern.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "signal/quantity.hpp"

namespace corpuscle {
namespace {

double count_in(std::span<const double> spikes, const TimeWindow& phase) {
    return static_cast<double>(std::count_if(spikes.begin(), spikes.end(), [&](double t) { return t >= phase.from && t < phase.to; }));
}

}  // namespace

double spread_count(std::span<const double> spikes, const TimeWindow& phase) {
    double out = 0;
    for (std::size_t k = 0; k + 1 < spikes.size(); ++k) {
        const double overlap = std::min(spikes[k + 1], phase.to) - std::max(spikes[k], phase.from);
        if (overlap > 0) out += overlap / (spikes[k + 1] - spikes[k]);
    }
    return out + (spikes.empty() ? 0 : count_in(spikes.last(1), phase));
}

FiringLimits FiringLimits::about(std::span<const double> designed, std::span<const TimeWindow> phases, double first_off) {
    FiringLimits out;
    bool fired = false;
    for (const auto& phase : phases) {
        const double count = count_in(designed, phase), tolerance = std::max(1.0, std::floor(count / 4));
        fired |= count > 0;
        out.phases.push_back({phase, std::max(0.0, count - tolerance), fired ? count + tolerance : 0, spread_count(designed, phase)});
    }
    out.first = designed.empty() ? 0 : designed[0], out.first_off = first_off;
    return out;
}

bool FiringLimits::kept(std::span<const double> spikes) const {
    for (const auto& p : phases)
        if (const double count = count_in(spikes, p.phase); count < p.least || count > p.most) return false;
    return first_off <= 0 || (!spikes.empty() && std::abs(spikes[0] - first) <= first_off);
}

double FiringLimits::distance(std::span<const double> spikes) const {
    double out = 0;
    for (const auto& p : phases) {
        const double tolerance = (spread_count(spikes, p.phase) - p.share) / std::max(0.5, (p.most - p.least) / 2);
        out += tolerance * tolerance;
    }
    if (first_off <= 0) return out;
    const double delay = spikes.empty() ? phases.back().phase.to - first : spikes[0] - first;
    return out + delay * delay / (first_off * first_off);
}

std::string FiringLimits::text() const {
    std::string out;
    for (const auto& p : phases)
        out += fmt::format("{}{}", out.empty() ? "" : ", ",
                           p.least == p.most ? fmt::format("{:g}", p.least) : fmt::format("{:g} to {:g}", p.least, p.most));
    return fmt::format(
        "{} spikes{}", out,
        first_off > 0 ? fmt::format(", the first at {} +- {}", format_quantity(first, "s"), format_quantity(first_off, "s")) : "");
}

}  // namespace corpuscle
