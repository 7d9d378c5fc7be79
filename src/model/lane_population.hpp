#pragma once
// Many afferents of one kind, simulated together on SIMD lanes and threads. All have the same receptor and neuron models, with individual
// or shared parameters. In double precision the result is bit-identical to simulating the afferents one at a time, for any number of lanes
// and threads.

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "model/catalog.hpp"
#include "signal/instruction_set.hpp"
#include "signal/thread_pool.hpp"

namespace corpuscle {

/// A block of force: one array of samples (N) for each afferent. Afferents may share an array.
struct ForceColumns {
    std::span<const double* const> columns;
};

/// Afferents per tile of tiled force.
inline constexpr std::size_t tile_width = 64;

/// A block of force in tiles: [tile][step][tile_width], N. Aligned to 64 bytes; the last tile is padded with zeros. This is the fastest
/// layout to read. V is the precision of the population.
template <class V>
struct ForceTiles {
    const V* rows;
    /// Optional: one byte for each tile, not 0 if its force is zero during the whole block. The rows of such a tile are not read, and the
    /// tile is skipped if its state cannot change without force.
    const std::uint8_t* zero_force = nullptr;
};

/// Tiles of 16-bit integers, as an analog-to-digital converter delivers them; multiplied by `scale` they are in N.
struct ForceInt16 {
    const std::int16_t* rows;
    double scale;
};

/// One force for all afferents (N), multiplied by a `gain` (0 or more) for each afferent; empty: all gains are 1. If all afferents share
/// their receptor, and its current scales with force, the current is computed once, in double, and then multiplied.
struct ForceProfile {
    std::span<const double> force;
    std::span<const double> gain = {};
};

using PopulationForce = std::variant<ForceColumns, ForceTiles<double>, ForceTiles<float>, ForceInt16, ForceProfile>;

/// The response of a population to a block.
struct PopulationResponse {
    std::vector<Spike>* spikes = nullptr;  ///< appended, in order of time, then afferent
    /// Or one bit for each afferent and step: word [tile][step], bit u for afferent u of the tile. Each block overwrites it. Further spikes
    /// of an afferent in the same step are counted in `extra_spikes`.
    std::vector<std::uint64_t>* spike_bits = nullptr;
    std::int64_t extra_spikes = 0;
    std::int64_t truncated_steps = 0;  ///< steps that reached the limit of spikes per step
    std::int64_t skipped_steps = 0;    ///< steps of afferents that were skipped, because no state could change
    std::size_t failed_afferent = 0;   ///< after an error: the first afferent that caused it
};

enum class Precision { double_precision, single_precision };

class LanePopulation {
public:
    virtual ~LanePopulation() = default;
    virtual std::size_t size() const = 0;
    /// Simulates the next block of `steps` samples. The block size does not change the spikes. The force of all blocks must have the same
    /// layout. A NaN force, or a state that becomes NaN or infinite, is an error; the population cannot be used after it.
    virtual Result<void> respond(const PopulationForce&, std::size_t steps, PopulationResponse&, ThreadPool&) = 0;
    virtual std::int64_t step() const = 0;  ///< samples simulated so far
    /// The complete state. An identical new population resumes from it bit for bit, and refuses the state of another population.
    virtual std::vector<double> save() const = 0;
    virtual Result<void> resume(std::span<const double>) = 0;
};

/// Specification of a population.
struct PopulationPlan {
    std::span<const AfferentPlan* const> plans;  ///< one for all afferents, or one for each; with the same receptor and neuron models
    std::size_t size = 0;                        ///< at least 1
    std::span<const std::uint32_t> afferent_numbers = {};  ///< written to the spikes; ascending; empty: 0, 1, 2 ...
    Precision precision = Precision::double_precision;
};

/// True if lanes can simulate this afferent: no sensor, transducer or converter before it, and no noise.
bool can_use_lanes(const AfferentPlan&, const SimulationOptions&);

/// Returns an error for plans that cannot share lanes: different models, or different values of a parameter that must be the same for all.
Result<std::unique_ptr<LanePopulation>> make_lane_population(const PopulationPlan&, const SimulationOptions&, InstructionSet);

}  // namespace corpuscle
