#pragma once
// Fits an afferent to recorded spike trains: each train and the response to the same force are smoothed with a Gaussian, and the residuals
// are the differences of the two curves.

#include <limits>

#include "core/clock.hpp"
#include "core/simulation_options.hpp"
#include "fit/fit_problem.hpp"

namespace corpuscle {

/// A recorded spike train.
struct RecordedTrain {
    std::string name;
    std::vector<double> times;  ///< s, in the time of the force; ascending
};

/// A force and the trains that were recorded under it, each in its own repetition.
struct SpikeRecording {
    std::string name;
    std::vector<double> force;  ///< N
    Clock clock;
    std::vector<RecordedTrain> trains;
    std::string spike_file = {};  ///< of the trains, for messages
    double delay = 0;             ///< s, that was subtracted from the recorded times, for messages
    /// s; spikes from this time on are held out. Infinity: none; minus infinity: all.
    double held_out_from = std::numeric_limits<double>::infinity();

    double end() const { return clock.time(static_cast<std::int64_t>(force.size())); }  ///< s, of the force
};

struct SpikeProblemOptions {
    double tau = 10e-3;  ///< s, standard deviation of the Gaussian in the last stage
    /// See AfferentTraits. The times of irregular spikes have no counterpart in a simulation: the recorded rate is compared with the mean
    /// rate of several simulations, and the Gaussian of the last stage is rate_width times as wide.
    bool is_irregular = false;
    SimulationOptions simulation = {};  ///< dt is that of each recording
};

/// The standard deviation of a Gaussian that compares rates, in units of tau.
inline constexpr double rate_width = 8;

/// Holds out a fraction of the recordings: of three or more the last ones, otherwise the end of each.
void hold_out(std::vector<SpikeRecording>&, double fraction);

/// Warnings about spikes that are not used, about few spikes, and about samples that are too far apart for the afferent.
std::vector<std::string> recording_warnings(std::span<const SpikeRecording>, const AfferentPlan&);

/// The error of recordings without a spike to fit.
Error unused_spikes_error(std::span<const SpikeRecording>);

/// Recordings without a spike to fit are an error.
Result<std::unique_ptr<FitProblem>> make_spike_problem(std::vector<SpikeRecording>, const SpikeProblemOptions&);

}  // namespace corpuscle
