#pragma once
// The parts of a population on lanes: kernels, models, afferent numbers.

#include <memory>
#include <string>
#include <vector>

#include "model/lanes/aligned_buffer.hpp"
#include "model/lanes/kernel.hpp"
#include "model/lanes/shared_receptor.hpp"

namespace corpuscle::lanes {

/// The parts from which TiledPopulation is built. They have been checked.
template <class V>
struct PopulationLayout {
    const ReceptorKernel<V>* receptor;
    const NeuronKernel<V>* neuron;
    const FusedKernel<V>* fused;                      ///< receptor and neuron in one loop; null: not available
    int lanes;                                        ///< afferents in a vector
    std::size_t size;                                 ///< number of afferents
    AlignedBuffer<std::byte> receptors, neurons;      ///< the models: one for all afferents, or those of tile 0, tile 1 ...
    std::unique_ptr<SharedReceptor> shared_receptor;  ///< not null if all afferents have the same receptor parameters
    bool scales_with_force;                           ///< true if the receptor's current is proportional to force
    std::vector<std::uint32_t> afferent_numbers;      ///< Spike::afferent_index of each afferent; empty: 0, 1, 2 ...
    std::string name;                                 ///< for messages: "sa1b+lif-b"
};

}  // namespace corpuscle::lanes
