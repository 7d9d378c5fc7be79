#pragma once
// An experiment: gratings of three periods on the fingertip, to be told apart from spikes.

#include <array>
#include <string>
#include <vector>

#include "reproduction/readout/linear_readout.hpp"
#include "reproduction/skin/skin_touch.hpp"

namespace corpuscle {

inline constexpr std::array<double, 3> grating_periods{1e-3, 2e-3, 4e-3};  // m; half of a period is ridge
inline constexpr double grating_patch = 4e-3;                              // m, radius of the patch in which a grating touches
inline constexpr double grating_ramp = 50e-3, grating_settled = 0.1;       // s: rise of the force; from its start to that of the counts
inline constexpr double grating_counted = 0.2;                             // s: the longest window in which spikes are counted

/// A touch by a grating, and the response.
struct GratingTrial {
    std::size_t period = 0;  ///< index in grating_periods
    double speed = 0;        ///< m/s; 0: the grating rests
    double force = 0;        ///< N
    Position place = {};     ///< of the patch, relative to the middle of the fingertip, m
    double start = 0;        ///< s, when the force begins
    std::vector<SpikeTimes> spikes = {};
};

/// Simulates trials with the periods in turn. Force (0.5 to 2 N) and, if the grating slides, speed (20 to 80 mm/s) are random, evenly on
/// logarithmic scales. The place (up to 1.5 mm from the middle, along x and along y) and, if it slides, the phase are random, too. All
/// random numbers depend on `seed` and the number of the trial.
Result<std::vector<GratingTrial>> simulate_gratings(const std::shared_ptr<const Innervation>&, std::size_t trials, bool slides,
                                                    std::uint64_t seed);

/// The trials for a read-out of the period. The features are the numbers of spikes of each afferent of the class ("" for all classes)
/// within `duration` (s). With `knows_speed` also these numbers times the logarithm of the speed: the weights of the read-out then depend
/// on it.
std::vector<ReadoutTrial> spike_counts(const Innervation&, const std::vector<GratingTrial>&, std::string_view class_name, double duration,
                                       bool knows_speed);

}  // namespace corpuscle
