#pragma once
// How a chip fired under a touch beside how it was meant to: spikes of each phase, and the first of all.

#include <span>
#include <string>
#include <vector>

#include "measure/stretch.hpp"

namespace corpuscle {

/// What a chip's spikes must keep to.
struct FiringLimits {
    struct OfPhase {
        Stretch phase;       ///< s
        double least, most;  ///< spikes
        double share;        ///< spikes as they are meant, each spread over the interval that follows it
    };
    std::vector<OfPhase> phases;
    double first = 0, first_off = 0;  ///< s: the first spike's time as it is meant, and how far off it may be

    /// About the spikes of another (a model): in each phase a quarter more or less and at least one, but none where it has none before the
    /// first of its phases that has some; the first spike within `first_off`.
    static FiringLimits about(std::span<const double> meant, std::span<const Stretch> phases, double first_off);

    bool kept(std::span<const double> spikes) const;
    /// How far off, as one number: squares of deviations, each in what is allowed of it. Without steps where a spike crosses a phase's
    /// edge, so that a search finds its way; kept() decides.
    double distance(std::span<const double> spikes) const;
    std::string text() const;  ///< "0, 4 to 6, 7 to 11 ... spikes, the first at 309 ms +- 10 ms"
};

/// Spikes of a phase, each spread evenly over the interval that follows it; the last one is whole where it is.
double spread_count(std::span<const double> spikes, const Stretch& phase);

}  // namespace corpuscle
