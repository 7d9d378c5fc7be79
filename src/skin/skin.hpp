#pragma once
// A skin in simulation: force at the sites in, spikes of all its afferents out, block by block. The spikes are the same bit for bit for all
// block sizes, numbers of threads and instruction sets. This also holds for a skin that was saved and resumed.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "model/chain.hpp"
#include "signal/instruction_set.hpp"
#include "signal/thread_pool.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// A block of force: site s at step t is data[s * stride + t], N.
struct SiteForce {
    const double* data = nullptr;
    std::size_t stride = 0;
    /// The sites whose force is not 0 in at least one step of the block, in ascending order; the others are not read.
    std::span<const std::uint32_t> touched = {};
    bool reads_all = true;  ///< true: all sites are read, and `touched` is ignored
};

/// The afferents of a skin that one process simulates: each class is divided into `count` equal ranges; `index` selects one.
struct SkinPart {
    std::uint32_t index = 0, count = 1;
};

/// Statistics of a run.
struct SkinStats {
    std::int64_t steps = 0;            ///< samples of each site
    std::int64_t afferent_steps = 0;   ///< simulated
    std::int64_t skipped_steps = 0;    ///< steps of afferents that were skipped: no force, and no state could change
    std::int64_t spikes = 0;           ///< spikes that arrived
    std::int64_t truncated_steps = 0;  ///< steps that reached the limit of spikes per step
};

class Skin {
public:
    /// Sensors, converters and noise are not supported: see can_use_lanes().
    static Result<std::unique_ptr<Skin>> make(const std::shared_ptr<const Innervation>&, const SimulationOptions&, InstructionSet,
                                              SkinPart = {});
    ~Skin();

    const Innervation& innervation() const;
    std::size_t sites() const;
    std::int64_t step() const;  ///< samples simulated so far
    const SkinStats& stats() const;

    /// Simulates the next block. Appends the spikes that arrive in it to `spikes`, in order of time, then afferent. With one thread it
    /// allocates no memory after the first blocks, unless a step has more spikes than any step before.
    Result<void> respond(const SiteForce&, std::size_t steps, std::vector<Spike>& spikes, ThreadPool&);
    /// Appends the spikes that are still in transit to the recording point.
    void finish(std::vector<Spike>& spikes);

    /// The complete state. A new skin made with the same arguments can resume from it.
    std::vector<std::byte> save() const;
    Result<void> resume(std::span<const std::byte>);

    struct Impl;

private:
    explicit Skin(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

}  // namespace corpuscle
