#pragma once
// Random numbers of neurons: each afferent has a sequence of its own, which its index and the seed of the run select.

#include "core/random.hpp"

namespace corpuscle {

/// The sequence of an afferent, for the start() of a neuron: a multiple of 2^-24 in [0, 1), which float represents exactly.
inline double random_stream(std::uint64_t seed, std::uint32_t afferent_index) {
    constexpr std::uint32_t purpose = 0x74687200;  // "thr" in ASCII, for threshold
    return static_cast<double>(philox({0, 0, afferent_index, purpose}, seed)[0] >> 8) * 0x1p-24;
}

/// The state of a neuron at the start of a simulation.
template <class N>
auto start_neuron(const N& neuron, std::uint64_t seed, std::uint32_t afferent_index) {
    if constexpr (requires { neuron.start(0.0); })
        return neuron.start(random_stream(seed, afferent_index));
    else
        return neuron.start();
}

}  // namespace corpuscle
