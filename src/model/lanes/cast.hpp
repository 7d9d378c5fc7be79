#pragma once
// What stands together in a population: parts, models, names.

#include <memory>
#include <string>
#include <vector>

#include "model/lanes/buffer.hpp"
#include "model/lanes/kernel.hpp"
#include "model/lanes/profile.hpp"

namespace corpuscle::lanes {

/// What a crowd is made of, found and checked.
template <class V>
struct Cast {
    const ReceptorLanes<V>* receptor;
    const NeuronLanes<V>* neuron;
    const JoinedLanes<V>* joined;  ///< both in one loop; or null
    int lanes;
    std::size_t units;
    Buffer<std::byte> receptors, neurons;       ///< models: one, or a tile's after a tile's
    std::unique_ptr<ProfileTransduction> once;  ///< if all share one transduction
    bool scales;
    std::vector<std::uint32_t> numbers;
    std::string name;
};

}  // namespace corpuscle::lanes
