#pragma once
// The response of an afferent to sines of one frequency at many amplitudes.

#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The response at one amplitude, in the steady state.
struct CycleResponse {
    double amplitude = 0;         ///< N; half of the peak-to-peak value
    double spikes_per_cycle = 0;  ///< the cycle response of Johansson et al. 1982: mean over the copies
    bool one_to_one = false;      ///< exactly one spike in each cycle, of every copy
    double vector_strength = 0;   ///< the smallest of the copies; NaN if a copy has fewer than two spikes
};

/// The responses to sines of frequency f, in order of rising amplitude.
struct VibrationResponse {
    double f = 0;  ///< Hz
    std::vector<CycleResponse> responses;
    double shortest_interval = 0;  ///< between two spikes at any amplitude, s; infinite if there is none

    /// The least amplitude (N) with at least one spike per cycle; NaN if there is none.
    double threshold() const;
    /// The least amplitude (N) that evokes a spike; NaN if there is none. A slowly adapting afferent fires because of the preload, too.
    double detection_threshold() const;
    /// The widest range of amplitudes, without a gap, with exactly one spike in each cycle.
    struct Plateau {
        double low, high;            ///< N; NaN if there is no such amplitude
        double min_vector_strength;  ///< within the range
    };
    Plateau plateau() const;
    /// The spikes per cycle at the greatest of the amplitudes that is not above `amplitude` (N).
    double spikes_per_cycle(double amplitude) const;
};

/// Simulates an afferent under forces A + A sin(2 pi f t), so that the preload equals the amplitude A and the probe never lifts off. The
/// amplitudes go from 10 uN to 40 N in steps of 3 %. The preload has acted long enough for all adaptation before the vibration begins.
/// An irregular afferent is simulated in several copies, which differ in their random numbers.
Result<VibrationResponse> vibrate(const std::string& afferent, double f, std::size_t copies);

/// The middle (geometric mean) of the frequencies at which an afferent gives the most spikes per cycle at this amplitude (N).
double most_excitable(std::span<const VibrationResponse>, double amplitude);

}  // namespace corpuscle
