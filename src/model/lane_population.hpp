#pragma once
// Many afferents with the same receptor and neuron models, simulated together on SIMD lanes and threads. Their parameters may be individual
// or shared. In double precision the spikes are bit-identical to those of the same afferents simulated one by one (chain.hpp), for any
// number of lanes and threads.

#include <variant>

#include "core/afferent_factory.hpp"
#include "core/number/instruction_set.hpp"
#include "core/thread_pool.hpp"

namespace corpuscle {

/// A block of force as one array of samples, in newtons, for each afferent. Several afferents may refer to the same array. If an afferent
/// has several forces, their arrays follow one another.
struct ForceColumns {
    std::span<const double* const> columns;
};

/// Afferents per tile of force.
inline constexpr std::size_t tile_width = 64;

/// A block of force in tiles, as an array [tile][step][tile_width] in newtons. It is aligned to 64 bytes, and the last tile is padded with
/// zeros. This is the fastest layout to read. V is the number type of the population, double or float. If afferents have several forces,
/// the array is [tile of afferents][force][step][tile_width], and `zero_force` is [tile of afferents][force].
template <class V>
struct ForceTiles {
    const V* rows;
    /// Null, or one byte for each tile: 0 unless the force on the tile is zero during the whole block. The rows of a tile without
    /// force are not read, and the tile is skipped if its state cannot change without force.
    const std::uint8_t* zero_force = nullptr;
};

/// A block of force in tiles, in the same layout, but as 16-bit integers such as an analog-to-digital converter delivers. The force in
/// newtons is the integer times `scale`.
struct ForceInt16 {
    const std::int16_t* rows;
    double scale;
};

/// A block of one force for all afferents, in newtons. Each afferent feels it times its `gain`, which must not be negative; if `gain` is
/// empty, all gains are 1. If all afferents have the same receptor parameters, and the receptor's current is proportional to force, this
/// current is computed once, in double, and then multiplied by the gains. Afferents with several forces cannot have a profile.
struct ForceProfile {
    std::span<const double> force;
    std::span<const double> gain = {};
};

using PopulationForce = std::variant<ForceColumns, ForceTiles<double>, ForceTiles<float>, ForceInt16, ForceProfile>;

/// The response of a population to a block.
struct PopulationResponse {
    std::vector<Spike>* spikes = nullptr;  ///< if not null: spikes are appended to it, in order of time, then afferent
    /// If not null, spikes are written here instead of to `spikes`: one word for each [tile][step] of the block, with bit u set if afferent
    /// u of the tile fires. Each block overwrites it. Further spikes of an afferent in the same step are counted in `extra_spikes`.
    std::vector<std::uint64_t>* spike_bits = nullptr;
    std::int64_t extra_spikes = 0;
    std::int64_t truncated_steps = 0;  ///< summed over afferents: steps that reached the limit of spikes per step
    std::int64_t skipped_steps = 0;    ///< summed over afferents: steps that were skipped, because the state could not change
    std::size_t failed_afferent = 0;   ///< after an error: the index in the population of the first afferent that caused it
};

/// The number type of a population's states: double or float.
enum class Precision { double_precision, single_precision };

class LanePopulation {
public:
    virtual ~LanePopulation() = default;
    virtual std::size_t size() const = 0;
    /// Simulates the next block of `steps` samples. The spikes do not depend on the length of the blocks. The force of all blocks must have
    /// the same layout, that is, the same alternative of PopulationForce. A NaN force, or a state that becomes NaN or infinite, is an
    /// error; the population cannot be used after it.
    virtual Result<void> respond(const PopulationForce&, std::size_t steps, PopulationResponse&, ThreadPool&) = 0;
    virtual std::int64_t step() const = 0;  ///< number of samples simulated so far
    /// The complete state. A new population from the same plan that resumes from it gives the same spikes bit for bit. The state of another
    /// population is refused.
    virtual std::vector<double> save() const = 0;
    virtual Result<void> resume(std::span<const double>) = 0;
};

/// The plan of a population.
struct PopulationPlan {
    std::span<const AfferentPlan* const> plans;  ///< one plan for all afferents, or one for each; with the same receptor and neuron models
    std::size_t size = 0;                        ///< number of afferents, at least 1
    std::span<const std::uint32_t> afferent_numbers = {};  ///< Spike::afferent_index of each afferent, ascending; empty: 0, 1, 2 ...
    Precision precision = Precision::double_precision;
    /// Number of forces on each afferent. Each force has a receptor of its own, with the parameters of the afferent, and the mean of the
    /// currents of these receptors drives the neuron.
    std::size_t forces = 1;
};

inline constexpr std::size_t max_forces = 100;  ///< limit of PopulationPlan::forces

/// True if lanes can simulate this afferent: it is a receptor and a neuron without a front end, and there is no noise.
bool can_use_lanes(const AfferentPlan&, const SimulationOptions&);

/// Builds a population. Plans that cannot share lanes are an error: different models, or different values of a parameter that must be the
/// same for all.
Result<std::unique_ptr<LanePopulation>> make_lane_population(const PopulationPlan&, const SimulationOptions&, InstructionSet);

}  // namespace corpuscle
