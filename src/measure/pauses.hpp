#pragma once
// Pauses between bursts of spikes, for example while no object is touched.

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

}  // namespace corpuscle
