#pragma once
// The layout of a population on lanes: kernels, models, afferent numbers.

#include <memory>
#include <string>
#include <vector>

#include "model/lanes/aligned_buffer.hpp"
#include "model/lanes/kernel.hpp"
#include "model/lanes/shared_receptor.hpp"

namespace corpuscle::lanes {

/// Everything that a population is built from, already checked.
template <class V>
struct PopulationLayout {
    const ReceptorKernel<V>* receptor;
    const NeuronKernel<V>* neuron;
    const FusedKernel<V>* fused;  ///< receptor and neuron in one loop; null: not available
    int lanes;
    std::size_t size;
    AlignedBuffer<std::byte> receptors, neurons;      ///< models: one for all, or those of each tile in turn
    std::unique_ptr<SharedReceptor> shared_receptor;  ///< set if all afferents share one receptor
    bool scales_with_force;
    std::vector<std::uint32_t> afferent_numbers;
    std::string name;
};

}  // namespace corpuscle::lanes
