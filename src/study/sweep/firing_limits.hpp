#pragma once
// Limits on a chip's response to a stimulus, relative to the designed response: spikes in each phase, and the time of the first spike.

#include <span>
#include <string>
#include <vector>

#include "measure/measure_base.hpp"

namespace corpuscle {

/// Limits on a chip's spikes.
struct FiringLimits {
    struct PhaseLimits {
        TimeWindow phase;  ///< s
        double min, max;   ///< spikes
        double designed;   ///< designed spike count, each spike spread over the interval after it
    };
    std::vector<PhaseLimits> phases;
    double first_spike = 0, first_spike_tolerance = 0;  ///< s: designed time of the first spike, and the allowed deviation

    /// Limits around the spikes of a reference (a model). Each phase allows a quarter more or less, at least one spike. Phases before the
    /// reference's first spike allow none. The time of the first spike may deviate by `time_tolerance`, s.
    static FiringLimits around(std::span<const double> reference, std::span<const TimeWindow> phases, double time_tolerance);

    bool are_met(std::span<const double> spikes) const;
    /// The distance from the designed response: sum of squared deviations, each relative to its allowed range. It does not
    /// jump when a spike crosses a phase's edge, so that a search can use it. The verdict is are_met().
    double distance(std::span<const double> spikes) const;
    std::string text() const;  ///< "0, 4 to 6, 7 to 11 ... spikes, the first at 309 ms +- 10 ms"
};

/// Number of spikes in a phase, with each spike spread evenly over the interval after it; the last spike is not spread.
double spread_count(std::span<const double> spikes, const TimeWindow& phase);

}  // namespace corpuscle
