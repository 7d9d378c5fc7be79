#include "sweep/subject/firing_limits.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

/// Number of spikes in a phase.
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

FiringLimits FiringLimits::around(std::span<const double> reference, std::span<const TimeWindow> phases, double time_tolerance,
                                  std::optional<double> allowed) {
    FiringLimits out;
    bool fired = false;  // in this phase or an earlier one
    for (const auto& phase : phases) {
        const double count = count_in(reference, phase), count_tolerance = allowed.value_or(std::max(1.0, std::floor(count / 4)));
        fired |= count > 0;
        out.phases.push_back(
            {phase, std::max(0.0, count - count_tolerance), fired ? count + count_tolerance : 0, spread_count(reference, phase)});
    }
    out.first_spike = reference.empty() ? 0 : reference[0], out.first_spike_tolerance = time_tolerance;
    return out;
}

bool FiringLimits::are_met(std::span<const double> spikes) const {
    for (const auto& p : phases)
        if (const double count = count_in(spikes, p.phase); count < p.min || count > p.max) return false;
    return first_spike_tolerance <= 0 || (!spikes.empty() && std::abs(spikes[0] - first_spike) <= first_spike_tolerance);
}

double FiringLimits::distance(std::span<const double> spikes) const {
    double out = 0;
    for (const auto& p : phases) {
        const double deviation = (spread_count(spikes, p.phase) - p.reference_count) / std::max(0.5, (p.max - p.min) / 2);
        out += deviation * deviation;
    }
    if (first_spike_tolerance <= 0) return out;
    // A response without spikes counts as a first spike at the end of the last phase.
    const double delay = spikes.empty() ? phases.back().phase.to - first_spike : spikes[0] - first_spike;
    return out + delay * delay / (first_spike_tolerance * first_spike_tolerance);
}

std::string FiringLimits::text() const {
    std::string out;
    for (const auto& p : phases)
        out += fmt::format("{}{}", out.empty() ? "" : ", ",
                           p.min == p.max ? fmt::format("{:g}", p.min) : fmt::format("{:g} to {:g}", p.min, p.max));
    return fmt::format("{} spikes{}", out,
                       first_spike_tolerance > 0 ? fmt::format(", the first at {} +- {}", format_quantity(first_spike, "s"),
                                                               format_quantity(first_spike_tolerance, "s"))
                                                 : "");
}

}  // namespace corpuscle
