#pragma once
// Many afferents of one kind at once: the same transduction and neuron, parameters of their own or shared, side by side on SIMD
// lanes and on threads. In double it answers as the afferents would one by one, to the bit, whatever the lanes and the threads.

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "model/catalog.hpp"
#include "signal/instruction_set.hpp"
#include "signal/pool.hpp"

namespace corpuscle {

/// A block of force, one array of samples (N) for each unit; units may share one.
struct ForceColumns {
    std::span<const double* const> of;
};

/// Units that stand side by side in tiled force.
inline constexpr std::size_t force_tile = 64;

/// A block of force in tiles: [tile][step][force_tile], N. On 64 bytes; the last tile is padded with zeros. The fastest
/// to read; V is the population's own precision.
template <class V>
struct ForceTiles {
    const V* rows;
    /// If given, a byte a tile: not 0 where no force comes all through the block. Its rows are not read, and a tile in which nothing
    /// can change without force is passed over.
    const std::uint8_t* without = nullptr;
};

/// Tiles of 16-bit integers as a converter gives them; times `scale` they are N.
struct ForceWords {
    const std::int16_t* rows;
    double scale;
};

/// One force for all (N), each unit feeling `gain` (0 or more) times it; no gains: 1. Where all units share their transduction
/// and its current scales with force, it is worked out once, in double, and the current multiplied.
struct ForceProfile {
    std::span<const double> force;
    std::span<const double> gain = {};
};

using PopulationForce = std::variant<ForceColumns, ForceTiles<double>, ForceTiles<float>, ForceWords, ForceProfile>;

/// Where a population puts its answer.
struct PopulationAnswer {
    std::vector<Spike>* spikes = nullptr;  ///< appended, in order of time, then unit
    /// Or one bit a unit and step: word [tile][step], unit u of a tile in bit u; each block overwrites it. A unit's further spikes
    /// in one step are counted in `unmarked`.
    std::vector<std::uint64_t>* marks = nullptr;
    std::int64_t unmarked = 0;
    std::int64_t capped = 0;  ///< steps whose spikes were more than the cap allows
    std::int64_t passed = 0;  ///< steps of units that were passed over: nothing in them could change
    std::size_t failed = 0;   ///< the first unit that an error is about
};

enum class Precision { in_double, in_float };

class Population {
public:
    virtual ~Population() = default;
    virtual std::size_t units() const = 0;
    /// Answers the next block of `steps` samples. Blocks of any size give the same spikes; every block's force comes the same way.
    /// A force that is no number, or a state that leaves the finite numbers, is an error, and ends the population.
    virtual Result<void> respond(const PopulationForce&, std::size_t steps, PopulationAnswer&, Pool&) = 0;
    virtual std::int64_t step() const = 0;  ///< samples answered so far
    /// All that it carries. The same population, made anew, goes on from there to the bit; it refuses what is not its own.
    virtual std::vector<double> save() const = 0;
    virtual Result<void> resume(std::span<const double>) = 0;
};

/// What makes a population.
struct PopulationPlan {
    std::span<const AfferentPlan* const> plans;   ///< one for all units, or one for each; of the same transduction and neuron
    std::size_t units = 0;                        ///< at least 1
    std::span<const std::uint32_t> numbers = {};  ///< how spikes call each unit, rising; none: 0, 1, 2 ...
    Precision precision = Precision::in_double;
};

/// Whether a population can stand for these afferents: no sensor, transducer or converter before them, and no noise.
bool goes_on_lanes(const AfferentPlan&, const Run&);

/// Refuses what lanes cannot share: different parts, or different values of a parameter that is one for all.
Result<std::unique_ptr<Population>> make_population(const PopulationPlan&, const Run&, InstructionSet);

}  // namespace corpuscle
