#pragma once
// The layout of a population on lanes: kernels, models, afferent numbers.

#include <memory>
#include <string>
#include <vector>

#include "model/lanes/buffer.hpp"
#include "model/lanes/kernel.hpp"
#include "model/lanes/profile.hpp"

namespace corpuscle::lanes {

/// Everything that a population is built from, already checked.
template <class V>
struct Cast {
    const ReceptorLanes<V>* receptor;
    const NeuronLanes<V>* neuron;
    const JoinedLanes<V>* joined;  ///< both in one loop; null: not available
    int lanes;
    std::size_t units;
    Buffer<std::byte> receptors, neurons;       ///< models: one for all, or those of each tile in turn
    std::unique_ptr<ProfileTransduction> once;  ///< set if all afferents share one receptor
    bool scales;
    std::vector<std::uint32_t> numbers;
    std::string name;
};

}  // namespace corpuscle::lanes
