#pragma once
// The thesis's press stimulus (1.2, fig. 4): its phases, its force, and the spike counts and rates of a response.

#include <string>
#include <vector>

#include "measure/measures.hpp"
#include "reproduction/claims/trial.hpp"

namespace corpuscle::press {

// s: the phases, from the start of the stimulus; plateau_end is the last 100 ms of the plateau, not a phase of its own
inline constexpr TimeWindow rest{0, 0.25}, protraction{0.25, 0.375}, plateau{0.375, 0.625}, plateau_end{0.525, 0.625},
    retraction{0.625, 0.75}, after{0.75, 1.0};
inline constexpr double min_force = 0.2, max_force = 4;  // N

/// Force (N) over time (s), sampled every T (s).
Result<StudyCurve> force_curve(double T);

inline double spike_count(const std::vector<double>& train, const TimeWindow& window) { return measure<SpikeCount>(train, window); }
/// "0 5 9 1 0": spike counts at rest, in protraction, plateau, retraction and after.
std::string phase_counts(const std::vector<double>& train);
/// The instantaneous frequency as the thesis plots it: 1/interval at the time of the interval's first spike (3.3).
StudyCurve frequency_at_start(const std::vector<double>& train);
/// The same at the time of the second spike, as many tools plot it.
StudyCurve frequency_at_end(const std::vector<double>& train);

/// The trial that runs a model as the thesis does: Algorithms 4 to 6 in steps of 1 ms, with spikes at sample times.
TrialSpec thesis_algorithm(std::string afferent, std::vector<std::string> settings = {});

}  // namespace corpuscle::press
