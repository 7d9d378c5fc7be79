#pragma once
// Time windows of sliding recordings as trials of a read-out, and how they are divided into those that are learned and those that are
// tested.

#include "reproduction/texture/slide_response.hpp"

namespace corpuscle {

inline constexpr double slide_start = 1;  ///< s; windows begin after it, because the afferents first respond to the grip that holds already

/// A time window of a recording.
struct SlideTrial {
    std::size_t recording = 0, surface = 0, grip = 0, speed = 0;  ///< as in Slide
    std::size_t window = 0, windows = 0;                          ///< its number in the recording, from 0; their total number
    double from = 0, to = 0;                                      ///< s

    bool is_in_second_half() const { return 2 * window >= windows; }
    /// The half of a recording that the window is in.
    std::size_t passage() const { return 2 * recording + is_in_second_half(); }
};

/// Windows of this duration (s), one after the other, in the first `until` s of each recording. An even number of each recording.
std::vector<SlideTrial> slide_trials(const std::vector<Slide>&, double duration, double until = 1e9);

/// A number for each taxel in each trial: [trial][taxel].
using TaxelFeature = std::vector<std::vector<double>>;
/// The numbers of spikes.
TaxelFeature spike_counts(const std::vector<SlideTrial>&, const SlideSpikes&);
/// The means of the recorded values.
TaxelFeature mean_readings(const std::vector<SlideTrial>&, const std::vector<TaxelValues>&);
/// The means of the absolute differences between two consecutive recorded values.
TaxelFeature mean_changes(const std::vector<SlideTrial>&, const std::vector<TaxelValues>&);

/// The trials that are tested.
enum class SlideTest {
    other_half,   ///< those of the other half of each recording. The windows that touch that half are not learned.
    other_speed,  ///< those of the recordings with the other speed
    other_grip,   ///< those of the recordings with the other grip
};

/// Indexes of trials.
struct SlideSplit {
    std::vector<std::size_t> learned, tested;
};
/// Two divisions, so that each trial is tested once. Of other_half: only trials of recordings with at least four windows.
std::vector<SlideSplit> slide_splits(const std::vector<SlideTrial>&, SlideTest);

}  // namespace corpuscle
