#pragma once
// The simulation of a skin: force at the sites in, spikes of all its afferents out, block by block. The spikes are the same bit for bit for
// all block lengths, numbers of threads and instruction sets. They are also the same if the simulation is saved and resumed in between.

#include "core/number/instruction_set.hpp"
#include "core/thread_pool.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// A block of force: the normal force in newtons at site s in step t of the block is data[s * stride + t]; pressing is positive.
struct SiteForce {
    const double* data = nullptr;
    std::size_t stride = 0;
    /// The sites whose force, normal or tangential, is not 0 in at least one step of the block, in ascending order. The force at other
    /// sites is not read.
    std::span<const std::uint32_t> touched = {};
    bool reads_all = true;  ///< true: the force at all sites is read, and `touched` is ignored
    /// The tangential force (shear) on the skin at each site in newtons, in the layout of `data` and in the plane of the skin: along x (to
    /// the right) and along y (away from the wrist). Null: this component is 0 everywhere.
    const double* shear_x = nullptr;
    const double* shear_y = nullptr;

    bool has_shear() const { return shear_x || shear_y; }
    /// True if something touches the skin at this site and step: it presses, or pulls along the skin.
    bool is_touched(std::size_t site, std::size_t step) const {
        const auto at = site * stride + step;
        return data[at] > 0 || (shear_x && shear_x[at] != 0) || (shear_y && shear_y[at] != 0);
    }
    /// Calls f with each component that is not null: `data`, `shear_x`, `shear_y`.
    template <class F>
    void for_each_component(const F& f) const {
        for (const double* component : {data, shear_x, shear_y})
            if (component) f(component);
    }

    /// Calls f with the index of each site whose force is read, in ascending order. `sites`: number of sites of the skin.
    template <class F>
    void for_each_site(std::size_t sites, const F& f) const {
        for (std::size_t s = 0; reads_all && s < sites; ++s) f(s);
        for (const auto s : touched)
            if (!reads_all) f(std::size_t{s});
    }
};

/// The afferents of a skin that one process simulates. Each class is divided into `count` ranges of nearly equal size, and the process
/// takes the one with this `index`, counted from 0.
struct SkinPart {
    std::uint32_t index = 0, count = 1;
};

/// Statistics of a simulation since its start.
struct SkinStats {
    std::int64_t steps = 0;            ///< number of samples of each site's force
    std::int64_t afferent_steps = 0;   ///< steps that were simulated, summed over afferents
    std::int64_t skipped_steps = 0;    ///< steps without force that were skipped because the state could not change, summed over afferents
    std::int64_t spikes = 0;           ///< spikes that have arrived at the recording point
    std::int64_t truncated_steps = 0;  ///< steps that reached the limit of spikes per step, summed over afferents
};

class Skin {
public:
    /// Starts the simulation of a skin. Afferents with a front end and noise are not supported: see can_use_lanes().
    static Result<std::unique_ptr<Skin>> make(const std::shared_ptr<const Innervation>&, const SimulationOptions&, InstructionSet,
                                              SkinPart = {});
    ~Skin();

    const Innervation& innervation() const;
    std::size_t sites() const;
    std::int64_t step() const;  ///< number of samples simulated so far
    const SkinStats& stats() const;

    /// Simulates the next block. Appends the spikes that arrive at the recording point during the block to `spikes`, in order of time, then
    /// afferent. With one thread it allocates no memory after the first blocks, unless a step has more spikes than any step before.
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
