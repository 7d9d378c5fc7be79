#pragma once
// Measures of interspike intervals, and pauses between bursts of spikes, for example while no object is touched.

#include <cmath>

#include "measure/measure_base.hpp"

namespace corpuscle {

/// Decides for each interspike interval of a train whether it is a pause. A pause is longer than half a second and longer than ten times
/// the mean of the earlier intervals that are not pauses. An interval of more than ten seconds is always a pause. These limits are choices:
/// touched afferents fire more than once a second, most of them more than ten times a second.
class PauseDetector {
    static constexpr double min_pause = 0.5;  // s
    static constexpr double min_ratio = 10;   // of a pause to the mean interval
    double firing_ = 0, paused_ = 0;          // total durations of the intervals that are not pauses, and of the pauses, s
    double intervals_ = 0;                    // number of intervals that are not pauses

    double mean() const { return firing_ / intervals_; }  // s

public:
    static constexpr double max_interval = 10;  ///< s; a longer interval is always a pause

    /// Adds the next interval, s; returns true if it is a pause.
    bool add(double interval) {
        if (interval > max_interval || (intervals_ > 0 && interval > min_pause && interval > min_ratio * mean())) {
            paused_ += interval;
            return true;
        }
        // If this interval is much shorter than the mean of the earlier ones, all of those were pauses.
        if (intervals_ > 0 && mean() > min_pause && mean() > min_ratio * interval) paused_ += firing_, firing_ = intervals_ = 0;
        firing_ += interval, ++intervals_;
        return false;
    }
    /// True if the pauses last longer in total than the other intervals. The first and last intervals of such a train cannot be compared,
    /// because they probably belong to different touches.
    bool outlast_firing() const { return paused_ > firing_; }
};

/// Adaptation ratio: the first interspike interval of the phase divided by the last one, as in NeuroElectro (Tripathy et al. 2014, Front
/// Neuroinform 8:40). Both spikes of an interval must be in the phase, and pauses do not count as intervals. The ratio is undefined for
/// fewer than two intervals, and if the pauses last longer in total than the other intervals.
struct AdaptationRatio : MeasureBase {
    static constexpr MeasureInfo info{"adaptation_ratio", "adaptation", "", 2,
                                      "first interval of the phase divided by its last: 1 means no adaptation, 0.5 a slowing to half"};
    int intervals = 0;           // number of intervals so far, but not more than 2
    double first = 0, last = 0;  // lengths of the first and the latest interval, s
    PauseDetector pauses;
    void interval(double from, double to, bool inside) {
        if (!inside || pauses.add(to - from)) return;
        last = to - from;
        if (intervals == 0) first = last;
        if (intervals < 2) ++intervals;
    }
    double value(const TimeWindow&) const { return intervals == 2 && last > 0 && !pauses.outlast_firing() ? first / last : no_value; }
};

/// Coefficient of variation of the interspike intervals (Softky & Koch 1993, J Neurosci 13:334): their population standard deviation
/// divided by their mean. It is 0 for equal intervals and 1 for a Poisson process. Pauses count as intervals. The value is undefined for
/// fewer than two intervals, and if the pauses last longer in total than the other intervals. The sums are updated as in Welford (1962).
struct IntervalVariation : MeasureBase {
    static constexpr MeasureInfo info{"isi_cv", "ISI CV", "", 2,
                                      "standard deviation of the interspike intervals of the phase divided by their mean"};
    double count = 0;    // number of intervals
    double mean = 0;     // s
    double squares = 0;  // sum of the squared deviations from the mean, s^2
    PauseDetector pauses;
    void interval(double from, double to, bool inside) {
        if (!inside) return;
        pauses.add(to - from);
        const double x = to - from, deviation = x - mean;
        mean += deviation / ++count;
        squares += deviation * (x - mean);
    }
    double value(const TimeWindow&) const {
        return count >= 2 && mean > 0 && !pauses.outlast_firing() ? std::sqrt(squares / count) / mean : no_value;
    }
};

}  // namespace corpuscle
