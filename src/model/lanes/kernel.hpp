#pragma once
// Between the population, compiled for every machine, and the models on SIMD lanes, compiled once for each instruction set: plain
// data and pointers only. 64 units pass a chunk of steps together: first their transductions, then their neurons.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "model/current.hpp"

namespace corpuscle::lanes {

inline constexpr int tile_units = 64;    ///< of a tile; the same for every instruction set, so that nothing depends on it
inline constexpr int most_outputs = 2;   ///< neurons of one unit
inline constexpr int record_room = 256;  ///< of a list of firings

/// Steps of a chunk: a row of force, and the currents it becomes, stay in the first-level cache.
template <class V>
inline constexpr int chunk_steps = 128 / sizeof(V);
/// Rows of currents of one output: a step's end is where the next one begins, so there may be one more.
template <class V>
inline constexpr int current_rows = chunk_steps<V> + 1;

/// Units of one vector that fired in a step: a bit each, from `unit` of the tile on.
struct Firing {
    std::int32_t step, unit;
    std::uint64_t bits;
};

/// Where firings go; handed over whenever it is full.
template <class V>
struct FiringList {
    Firing* firings;  ///< room for record_room
    V* offsets;       ///< a vector for each firing; null: nobody asks where inside the step
    int count;
    std::int32_t step;    ///< the one at work
    std::uint64_t valid;  ///< a bit for each unit of the tile that is no padding
    std::int64_t capped;
    void (*full)(FiringList&);
};

enum class Feed { rows, words, profile };

/// Memory to ask for on the way, evenly: what the next chunk reads. Arithmetic goes on while it comes.
struct Ahead {
    const char* at;
    std::size_t bytes;
};

/// A tile's transductions over a chunk.
template <class V>
struct TransductionCall {
    const std::byte* models;
    std::size_t stride;  ///< from a vector's model to the next; 0: one for all
    V* state;            ///< [value][tile_units]
    int units, steps;    ///< of the tile's units, those that are no padding
    Method method;
    Feed feed;
    const V* rows;              ///< rows: force [step][tile_units], N
    const std::int16_t* words;  ///< words: the same as numbers that are N when times `scale`
    V scale;
    const V* profile;  ///< profile: one force a step, N, felt by each unit times its ...
    const V* gain;     ///< [tile_units]
    V* from;           ///< out: currents, [output][current_rows][tile_units], A; of a continuous transduction only the first row
    V* to;
    Ahead ahead;
    bool strange;  ///< out: some force may be no number
};

/// A tile's neurons over a chunk, under one output of the transduction.
template <class V>
struct NeuronCall {
    const std::byte* models;
    std::size_t stride;
    V* state;
    int units, steps;
    const V* from;  ///< [step][tile_units]; or, with gains, one value a step, and so
    const V* to;
    const V* both;
    const V* gain;  ///< [tile_units]; null: every unit has its own currents
    FiringList<V>* fired;
    Ahead ahead;
};

/// A transduction and a neuron in one loop; null: these two are not.
template <class V>
struct JoinedLanes {
    bool (*suits)(const std::byte* neurons, std::size_t count);     ///< whether it may be used with these models
    void (*settle)(const TransductionCall<V>&);                     ///< the receptors'
    void (*run)(const TransductionCall<V>&, const NeuronCall<V>&);  ///< uses nothing of their currents
};

template <class V>
struct ReceptorLanes {
    std::string_view name;
    int outputs;
    bool continuous;
    std::size_t model_bytes, state_values;
    /// Makes the models of `count` units (a tile's), or one for all if it is 1, of an array of the receptor's Params.
    void (*build)(std::byte* at, const void* params, int count, double dt, Method);
    void (*start)(const TransductionCall<V>&);   ///< the state before the first row of force
    void (*settle)(const TransductionCall<V>&);  ///< lets go of what has faded; uses only models and state
    void (*run)(TransductionCall<V>&);
    std::span<const JoinedLanes<V>> joined;  ///< with each neuron of the table
};

template <class V>
struct NeuronLanes {
    std::string_view name;
    std::size_t model_bytes, state_values;
    void (*build)(std::byte* at, const void* params, int count, double dt, Method);
    void (*start)(const NeuronCall<V>&);
    void (*settle)(const NeuronCall<V>&);
    void (*run)(const NeuronCall<V>&);
};

/// What one instruction set offers.
template <class V>
struct LaneTable {
    int lanes;
    std::span<const ReceptorLanes<V>> receptors;
    std::span<const NeuronLanes<V>> neurons;
};

namespace baseline {
extern const LaneTable<double> doubles;
extern const LaneTable<float> floats;
}  // namespace baseline
namespace avx2 {
extern const LaneTable<double> doubles;
extern const LaneTable<float> floats;
}  // namespace avx2
namespace avx512 {
extern const LaneTable<double> doubles;
extern const LaneTable<float> floats;
}  // namespace avx512

}  // namespace corpuscle::lanes
