#pragma once
// Simulates a skin under a force and passes the response to sinks: the counterpart of afferent_run.hpp, which is for afferents on channels.

#include <functional>
#include <memory>

#include "core/force_source.hpp"
#include "skin/contact/contact.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// The force of a run and the skin that it acts on.
struct SkinInput {
    std::string name;           ///< name of the force: "press"
    std::string description;    ///< "a sphere of 5 mm, pressed with ..."
    Clock clock;                ///< of the force
    std::vector<Phase> phases;  ///< of a stimulus
    const Innervation& skin;
};

/// The response to one block of force.
struct SkinRunBlock {
    std::int64_t first_sample = 0;  ///< index of the block's first sample; 0 is the first sample of the force
    std::size_t steps = 0;          ///< number of samples
    const SiteForce& force;
    std::span<const double> total_force;  ///< total force of all sites at each step, N
    std::span<const Spike> spikes;        ///< that arrive during the block, in order of time, then afferent index
};

class SkinSink {
public:
    virtual ~SkinSink() = default;
    virtual Result<void> begin(const SkinInput&) { return {}; }
    virtual Result<void> block(const SkinInput&, const SkinRunBlock&) { return {}; }
    /// `samples`: number of samples of the force. `last`: spikes that the nerve fibres are still conducting at the end of the force.
    virtual Result<void> end(const SkinInput&, std::int64_t /*samples*/, std::span<const Spike> /*last*/) { return {}; }
};

/// Force at the sites, block after block.
class SkinForce {
public:
    /// Valid until the next block.
    struct Block {
        SiteForce force;
        std::span<const double> total_force;  ///< of all sites together, N; one value for each sample of the block
    };
    virtual ~SkinForce() = default;
    /// Returns the next block; at the end of the force, a block without samples.
    virtual Result<Block> next() = 0;
    virtual double progress() const = 0;  ///< completed fraction, 0 to 1
};

/// The force at the sites when a contact presses one channel of force onto the skin.
std::unique_ptr<SkinForce> make_pressed_force(ForceSource&, Contact&);
/// The force at the sites from a recording with one channel for each site. `sites`: the site of each channel; `all_sites`: the number of
/// sites of the skin.
std::unique_ptr<SkinForce> make_site_force(ForceSource&, std::vector<std::uint32_t> sites, std::size_t all_sites);
/// The site of each channel of a recording: by name, or by order if there are as many channels as sites.
Result<std::vector<std::uint32_t>> match_sites(const SkinPlan&, const ForceSource&);

/// Simulates a skin, in one process or divided among several.
class SkinSimulator {
public:
    virtual ~SkinSimulator() = default;
    /// Simulates the next block of this many steps and appends its spikes.
    virtual Result<void> respond(const SiteForce&, std::size_t steps, std::vector<Spike>&) = 0;
    /// Call after the last step: appends the spikes that the nerve fibres are still conducting.
    virtual Result<void> flush(std::vector<Spike>&) = 0;
    virtual SkinStats stats() const = 0;
};
/// Simulates the complete skin in this process.
std::unique_ptr<SkinSimulator> local_skin_simulator(Skin&, ThreadPool&);

/// A log of a run that can be stopped and resumed: the spikes so far, which are replayed, and the sample at which the simulation continues.
class SkinRunLog {
public:
    virtual ~SkinRunLog() = default;
    virtual std::int64_t resumed_samples() const = 0;  ///< number of samples that an earlier run has simulated; 0 if the run is not resumed
    /// Adds the force of the next block, which begins with sample `first`. Returns an error if the force so far differs from that of
    /// the earlier run, at the latest in the block in which the earlier run ended.
    virtual Result<void> add_force(const SkinForce::Block&, std::int64_t first) = 0;
    /// For a block that an earlier run has simulated: appends its spikes. `end` is the index of the sample after the block.
    virtual Result<void> replay(std::int64_t end, std::vector<Spike>&) = 0;
    /// Adds the spikes of a newly simulated block to the log.
    virtual Result<void> append(std::span<const Spike>) = 0;
    /// Writes the log to disk, so that a run can be resumed after the last block.
    virtual Result<void> flush() = 0;
    /// Call at the end of the force. `samples`: its number of samples. Returns an error if an earlier run has simulated more.
    virtual Result<void> finish(std::int64_t samples) = 0;
};

struct SkinRunOptions {
    /// Called after each block with the completed fraction of the run, 0 to 1. If it returns false, the run stops.
    std::function<bool(double)> should_continue = [](double) { return true; };
    SkinRunLog* log = nullptr;  ///< null: the run cannot be resumed
};

/// Simulates a skin under a force. If should_continue stops the run, returns an error of code `interrupted`.
Result<SkinStats> run_skin(SkinForce&, const SkinInput&, SkinSimulator&, std::span<SkinSink* const>, const SkinRunOptions&);

}  // namespace corpuscle
