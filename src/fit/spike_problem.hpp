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
    /// s; spikes from this time on are held out. Infinity: none; minus infinity: all.
    double held_out_from = std::numeric_limits<double>::infinity();
};

struct SpikeProblemOptions {
    double tau = 10e-3;                 ///< s, standard deviation of the Gaussian in the last stage
    SimulationOptions simulation = {};  ///< dt is that of each recording
};

/// Holds out a fraction of the recordings: of three or more the last ones, otherwise the end of each.
void hold_out(std::vector<SpikeRecording>&, double fraction);

/// Recordings without a spike to fit are an error.
Result<std::unique_ptr<FitProblem>> make_spike_problem(std::vector<SpikeRecording>, const SpikeProblemOptions&);

}  // namespace corpuscle
