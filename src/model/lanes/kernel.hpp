#pragma once
// The interface between the population, which is compiled once for all machines, and the models on SIMD lanes (kernel.cpp), which are
// compiled once for each instruction set. It consists of plain data and pointers only. A tile of 64 afferents is simulated over a chunk of
// steps: first all receptors, then all neurons. A tile consists of vectors: the afferents whose values fit one SIMD register. V is the
// number type, double or float.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/number/instruction_set.hpp"
#include "model/current.hpp"

namespace corpuscle::lanes {

inline constexpr int tile_size = 64;   ///< afferents of a tile; the same for every instruction set, so that results do not depend on it
inline constexpr int max_outputs = 2;  ///< largest number of currents of a receptor, and so of neurons of an afferent
inline constexpr int firing_list_capacity = 256;  ///< capacity of a list of firing masks

/// Number of steps of a chunk: so few that its rows of force, and the currents computed from them, stay in the first-level cache.
template <class V>
inline constexpr int chunk_steps = 128 / sizeof(V);
/// Number of rows in the array of one output's currents. A continuous receptor stores only the currents at the boundaries between steps, of
/// which there is one more than steps.
template <class V>
inline constexpr int current_rows = chunk_steps<V> + 1;

/// A firing mask: the afferents of one vector that fired in a step.
struct Firing {
    std::int32_t step, first;  ///< step of the chunk; the vector's first afferent, counted in the tile
    std::uint64_t bits;        ///< bit k is 1 if afferent first + k fired
};

/// Buffer of firing masks; `on_full` is called whenever it is full.
template <class V>
struct FiringList {
    Firing* firings;               ///< firing_list_capacity elements
    V* offsets;                    ///< for each firing mask a vector of the spikes' offsets within the step; null: offsets are not needed
    int count;                     ///< number of firing masks in the buffer
    std::int32_t step;             ///< the step of the chunk that is being simulated
    std::uint64_t valid;           ///< one bit for each afferent of the tile: 1 unless it is padding
    std::int64_t truncated_steps;  ///< summed over afferents: steps that reached the limit of spikes
    void (*on_full)(FiringList&);
};

/// The layout of the force that a call reads: see the members of ReceptorCall with the same names.
enum class ForceInput { rows, int16, profile };

/// Memory that a loop prefetches, evenly over its steps: the force of the next chunk.
struct PrefetchRange {
    const char* at;
    std::size_t bytes;
};

/// Arguments of all functions of a kernel: the models and the state of a tile, of its receptors or of its neurons for one output.
template <class V>
struct TileCall {
    const std::byte* models;
    std::size_t stride;    ///< bytes from the model of a vector to that of the next vector; 0: one model for all
    V* state;              ///< of the tile: [state value][tile_size]
    int afferents, steps;  ///< afferents of the tile without padding; steps of the chunk
    PrefetchRange prefetch;
};

/// Arguments for the receptors of a tile over a chunk.
template <class V>
struct ReceptorCall : TileCall<V> {
    Method method;
    ForceInput input;
    const V* rows;                   ///< ForceInput::rows: force [step][tile_size], N
    const std::int16_t* int16_rows;  ///< ForceInput::int16: force [step][tile_size] as integers
    V scale;                         ///< N per unit of these integers
    const V* profile;                ///< ForceInput::profile: force of each step, N, the same for all afferents
    const V* gain;                   ///< ForceInput::profile: factor of each afferent, [tile_size]
    V* from;  ///< result: currents at the beginning of each step, [output][current_rows][tile_size], A; if continuous, of step 0 only
    V* to;    ///< result: currents at the end of each step, in the same layout
    bool has_non_finite;  ///< result: true if some force may be NaN or infinite
};

/// Arguments for the neurons of a tile over a chunk, for one output of the receptor.
template <class V>
struct NeuronCall : TileCall<V> {
    const V* from;     ///< currents at the beginning of each step, A: [step][tile_size]; if `gain` is not null, [step]
    const V* to;       ///< currents at the end of each step, in the same layout
    const V* end_sum;  ///< from + to for each step; only used if `gain` is not null
    const V* gain;     ///< [tile_size]: factor of each afferent for currents that all share; null: every afferent has its own currents
    const V* streams;  ///< [tile_size]: random_stream() of each afferent; only for ModelKernel::start
    FiringList<V>* fired;
};

/// The functions that simulate a receptor and a neuron in one loop. All are null for a pair that cannot be fused.
template <class V>
struct FusedKernel {
    bool (*is_usable)(const std::byte* neurons, std::size_t count);  ///< true if the loop can simulate these `count` neurons
    void (*flush_decayed)(const TileCall<V>&);                       ///< as ModelKernel::flush_decayed
    void (*run)(const ReceptorCall<V>&, const NeuronCall<V>&);       ///< ignores from, to, end_sum and the neurons' gain
};

/// The functions of a receptor or a neuron.
template <class V, class Call>
struct ModelKernel {
    std::string_view name;
    std::size_t model_bytes, state_values;  ///< bytes of the model of one vector; number of state values of one afferent
    /// Builds the models of the `count` afferents of a tile, or one model for all if `count` is 1, from the values of
    /// all parameters, afferent by afferent.
    void (*build)(std::byte* at, const double* values, int count, double dt, Method);
    void (*start)(Call&);                       ///< sets the state before the first step
    void (*flush_decayed)(const TileCall<V>&);  ///< as the models' flush_decayed()
    void (*run)(Call&);
};
template <class V>
using NeuronKernel = ModelKernel<V, const NeuronCall<V>>;
template <class V>
struct ReceptorKernel : ModelKernel<V, ReceptorCall<V>> {
    int outputs;                            ///< number of currents
    bool continuous;                        ///< true if the current at the beginning of a step is that at the end of the step before
    bool scales_with_force;                 ///< true if the current is proportional to force
    std::span<const FusedKernel<V>> fused;  ///< this receptor with each neuron, in the order of KernelTable::neurons
};

/// The kernels of one instruction set.
template <class V>
struct KernelTable {
    int lanes;  ///< afferents in a vector
    std::span<const ReceptorKernel<V>> receptors;
    std::span<const NeuronKernel<V>> neurons;
};

CORPUSCLE_KERNELS(KernelTable<double>, kernels_in_double)
CORPUSCLE_KERNELS(KernelTable<float>, kernels_in_float)

}  // namespace corpuscle::lanes
