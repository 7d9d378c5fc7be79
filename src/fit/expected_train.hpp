#pragma once
// The spikes of an afferent under a recorded force: of an irregular afferent those of several realisations, whose mean is its rate.

#include "fit/spike_problem.hpp"

namespace corpuscle {

/// The spikes of a number of simulations with different random numbers, merged in order of time.
struct ExpectedTrain {
    std::vector<double> times;  ///< s
    double realisations = 1;    ///< the number of simulations
};

/// The spikes of one simulation. `noise`: of the membrane, A; `seed`: of all its random numbers.
Result<std::vector<double>> simulated_train(const AfferentPlan&, const SpikeRecording&, SimulationOptions, double noise,
                                            std::uint64_t seed);

/// The spikes without membrane noise, of `realisations` simulations with the seeds from `seed` on.
Result<ExpectedTrain> expected_train(const AfferentPlan&, const SpikeRecording&, const SimulationOptions&, std::size_t realisations,
                                     std::uint64_t seed);

}  // namespace corpuscle
