#pragma once
// Pauses between bursts of spikes, for example while no object is touched.

namespace corpuscle {

/// Decides for each interspike interval whether it is a pause. A pause is longer than half a second and longer than ten times the mean of
/// the intervals before it. An interval of more than ten seconds is always a pause. These limits are choices: touched afferents fire faster
/// than once a second, most of them ten times as fast.
class PauseDetector {
    static constexpr double min_pause = 0.5, min_ratio = 10;  // min_pause: s
    double firing_ = 0, paused_ = 0;                          // s, total durations
    double intervals_ = 0;                                    // number of intervals without the pauses

    double mean() const { return firing_ / intervals_; }

public:
    static constexpr double max_interval = 10;  ///< s: a longer one is always a pause

    /// Adds the next interval, s; returns true if it is a pause.
    bool add(double interval) {
        if (interval > max_interval || (intervals_ > 0 && interval > min_pause && interval > min_ratio * mean())) {
            paused_ += interval;
            return true;
        }
        // Compared with a much shorter interval, all earlier ones were pauses.
        if (intervals_ > 0 && mean() > min_pause && mean() > min_ratio * interval) paused_ += firing_, firing_ = intervals_ = 0;
        firing_ += interval, ++intervals_;
        return false;
    }
    /// True if the pauses are longer in total than the firing. The first and last intervals of such a train are then not comparable.
    bool outlast_firing() const { return paused_ > firing_; }
};

}  // namespace corpuscle
