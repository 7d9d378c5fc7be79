#pragma once
// Limits on a chip's response to a stimulus, around the response of a reference: number of spikes in each phase, and time of the first
// spike.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/measure_base.hpp"

namespace corpuscle {

/// All times are since the first sample of the force.
struct FiringLimits {
    struct PhaseLimits {
        TimeWindow phase;        ///< s
        double min, max;         ///< allowed number of spikes in the phase
        double reference_count;  ///< spread_count() of the reference in the phase
    };
    std::vector<PhaseLimits> phases;
    double first_spike = 0, first_spike_tolerance = 0;  ///< s: time of the first spike of the reference, and allowed deviation from it;
                                                        ///< a deviation of 0 or less: any time, or no spike, is allowed

    /// Limits around the spike times of a reference, such as a model, s. In each phase, the number of spikes may deviate from that of the
    /// reference by a quarter (rounded down), or by one spike if that is more. The phases before the first one in which the reference fires
    /// allow no spikes. The time of the first spike may deviate by `time_tolerance`, s.
    /// `count_tolerance`: allowed deviation of the number of spikes instead of a quarter.
    static FiringLimits around(std::span<const double> reference, std::span<const TimeWindow> phases, double time_tolerance,
                               std::optional<double> count_tolerance = {});

    bool are_met(std::span<const double> spikes) const;
    /// The distance from the reference: the sum of the squares of all deviations, each divided by half its allowed range. It uses
    /// spread_count(), which hardly changes when a spike crosses the end of a phase, so that a search can minimise it. Only are_met()
    /// decides whether a chip meets the limits.
    double distance(std::span<const double> spikes) const;
    std::string text() const;  ///< "0, 4 to 6, 7 to 11 ... spikes, the first at 309 ms +- 10 ms"
};

/// Number of spikes in a phase, with each spike spread evenly over the interval after it; the last spike is not spread.
double spread_count(std::span<const double> spikes, const TimeWindow& phase);

}  // namespace corpuscle
