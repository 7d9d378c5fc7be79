#pragma once
// The interface between the population, compiled for every machine, and the models on SIMD lanes, compiled once for each instruction set.
// It consists of plain data and pointers only. 64 afferents are simulated together over a chunk of steps: first their receptors, then their
// neurons.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "model/current.hpp"

namespace corpuscle::lanes {

inline constexpr int tile_size = 64;   ///< afferents of a tile; the same for every instruction set, so that results do not depend on it
inline constexpr int max_outputs = 2;  ///< neurons of one afferent
inline constexpr int firing_list_capacity = 256;  ///< capacity of a list of firing masks

/// Steps of a chunk. Its rows of force, and the currents computed from them, stay in the first-level cache.
template <class V>
inline constexpr int chunk_steps = 128 / sizeof(V);
/// Rows of currents of one output. The end of a step is the beginning of the next, so one more row may be needed.
template <class V>
inline constexpr int current_rows = chunk_steps<V> + 1;

/// Afferents of one vector that fired in a step: one bit for each, from afferent `first` of the tile on.
struct Firing {
    std::int32_t step, first;
    std::uint64_t bits;
};

/// Buffer of firing masks; `on_full` is called whenever it is full.
template <class V>
struct FiringList {
    Firing* firings;  ///< firing_list_capacity elements
    V* offsets;       ///< one vector for each firing mask; null: the time within the step is not needed
    int count;
    std::int32_t step;    ///< the current step
    std::uint64_t valid;  ///< one bit for each afferent of the tile that is not padding
    std::int64_t truncated_steps;
    void (*on_full)(FiringList&);
};

enum class ForceInput { rows, int16, profile };

/// Memory to prefetch evenly while computing: the data of the next chunk.
struct PrefetchRange {
    const char* at;
    std::size_t bytes;
};

/// Arguments for the receptors of a tile over a chunk.
template <class V>
struct ReceptorCall {
    const std::byte* models;
    std::size_t stride;    ///< bytes from a vector's model to the next; 0: one model for all
    V* state;              ///< [value][tile_size]
    int afferents, steps;  ///< afferents of the tile without padding; steps of the chunk
    Method method;
    ForceInput input;
    const V* rows;                   ///< ForceInput::rows: force [step][tile_size], N
    const std::int16_t* int16_rows;  ///< ForceInput::int16: force [step][tile_size] as integers
    V scale;                         ///< N per unit of these integers
    const V* profile;                ///< ForceInput::profile: force of each step, N, the same for all afferents
    const V* gain;                   ///< [tile_size]: the factor of each afferent for the profile
    V* from;           ///< out: currents, [output][current_rows][tile_size], A; for a continuous receptor only the first row
    V* to;
    PrefetchRange prefetch;
    bool has_non_finite;  ///< out: some force may be NaN or infinite
};

/// Arguments for the neurons of a tile over a chunk, for one output of the receptor.
template <class V>
struct NeuronCall {
    const std::byte* models;
    std::size_t stride;
    V* state;
    int afferents, steps;
    const V* from;  ///< [step][tile_size]; if `gain` is set, one value for each step; the same for `to` and `end_sum`
    const V* to;
    const V* end_sum;
    const V* gain;  ///< [tile_size]; null: every afferent has its own currents
    FiringList<V>* fired;
    PrefetchRange prefetch;
};

/// A receptor and a neuron in one loop. The pointers are null for a pair that cannot be fused.
template <class V>
struct FusedKernel {
    bool (*is_usable)(const std::byte* neurons, std::size_t count);  ///< true if it can be used with these models
    void (*flush_decayed)(const ReceptorCall<V>&);                   ///< for the receptors
    void (*run)(const ReceptorCall<V>&, const NeuronCall<V>&);       ///< ignores the current arrays of the calls
};

template <class V>
struct ReceptorKernel {
    std::string_view name;
    int outputs;
    bool continuous;
    std::size_t model_bytes, state_values;
    /// Builds the models of `count` afferents (one tile), or one for all if `count` is 1, from an array of the receptor's Params.
    void (*build)(std::byte* at, const void* params, int count, double dt, Method);
    void (*start)(const ReceptorCall<V>&);          ///< sets the state before the first row of force
    void (*flush_decayed)(const ReceptorCall<V>&);  ///< sets decayed state to zero; reads only models and state
    void (*run)(ReceptorCall<V>&);
    std::span<const FusedKernel<V>> fused;  ///< this receptor with each neuron, in the order of KernelTable::neurons
};

template <class V>
struct NeuronKernel {
    std::string_view name;
    std::size_t model_bytes, state_values;
    void (*build)(std::byte* at, const void* params, int count, double dt, Method);
    void (*start)(const NeuronCall<V>&);
    void (*flush_decayed)(const NeuronCall<V>&);
    void (*run)(const NeuronCall<V>&);
};

/// The kernels of one instruction set.
template <class V>
struct KernelTable {
    int lanes;
    std::span<const ReceptorKernel<V>> receptors;
    std::span<const NeuronKernel<V>> neurons;
};

namespace baseline {
extern const KernelTable<double> doubles;
extern const KernelTable<float> floats;
}  // namespace baseline
namespace avx2 {
extern const KernelTable<double> doubles;
extern const KernelTable<float> floats;
}  // namespace avx2
namespace avx512 {
extern const KernelTable<double> doubles;
extern const KernelTable<float> floats;
}  // namespace avx512

}  // namespace corpuscle::lanes
