#pragma once
// The options of a simulation that are the same for all its afferents.

#include <cstdint>

namespace corpuscle {

/// The integration method of a model.
/// exact: between samples the force is a straight line (first-order hold), and filters are integrated exactly for such a force.
/// backward_euler: the algorithms as the thesis prints them, to reproduce its figures.
enum class Method { exact, backward_euler };

/// Options of a simulation that are the same for all afferents.
struct SimulationOptions {
    double dt = 1e-4;  ///< s, sampling interval
    Method method = Method::exact;
    bool spikes_on_samples = false;  ///< true: a spike occurs at the sample that ends its step, as in the thesis; false: within the step
    /// Membrane noise: a white current into each neuron, constant within a step. `noise` is the standard deviation of its part between 0 Hz
    /// and noise_band, A.
    double noise = 0;
    std::uint64_t seed = 0;  ///< of the noise
};

}  // namespace corpuscle
