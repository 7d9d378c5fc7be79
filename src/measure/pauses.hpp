#pragma once
// Intervals between bursts of spikes, which are no firing: what was in hand was let go.

namespace corpuscle {

/// Tells pauses from intervals as they come. A pause is longer than half a second and than ten times the mean of the intervals before it,
/// or longer than ten seconds (choices: afferents that are touched fire faster than once a second, most of them ten times as fast).
class Pauses {
    static constexpr double least = 0.5, times = 10;
    double firing_ = 0, paused_ = 0;  // s, in all
    double intervals_ = 0;            // that are no pauses

    double mean() const { return firing_ / intervals_; }

public:
    static constexpr double longest = 10;  ///< s: no interval is longer

    /// The next interval, s; whether it is a pause.
    bool add(double interval) {
        if (interval > longest || (intervals_ > 0 && interval > least && interval > times * mean())) {
            paused_ += interval;
            return true;
        }
        if (intervals_ > 0 && mean() > least && mean() > times * interval) paused_ += firing_, firing_ = intervals_ = 0;
        firing_ += interval, ++intervals_;
        return false;
    }
    /// Of such a train an interval at its beginning says nothing of one at its end.
    bool outlast_firing() const { return paused_ > firing_; }
};

}  // namespace corpuscle
