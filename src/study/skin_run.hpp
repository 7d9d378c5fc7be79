#pragma once
// Runs force through a whole skin into sinks: the counterpart of afferent_run.hpp, which is for afferents on channels.

#include <functional>
#include <memory>

#include "signal/force_source.hpp"
#include "skin/contact/contact.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// The input of a run.
struct SkinInput {
    std::string name;         ///< name of the force: "press"
    std::string description;  ///< "a sphere of 5 mm, pressed with ..."
    Clock clock;
    std::vector<Phase> phases;
    const Innervation& skin;
};

/// The response to one block of force.
struct SkinRunBlock {
    std::int64_t first_sample = 0;  ///< index of the block's first sample
    std::size_t steps = 0;
    const SiteForce& force;
    std::span<const double> total_force;  ///< total force of all sites at each step, N
    std::span<const Spike> spikes;        ///< in order of time, then afferent index
};

class SkinSink {
public:
    virtual ~SkinSink() = default;
    virtual Result<void> begin(const SkinInput&) { return {}; }
    virtual Result<void> block(const SkinInput&, const SkinRunBlock&) { return {}; }
    /// `last`: spikes that the nerve fibres are still conducting at the end of the force.
    virtual Result<void> end(const SkinInput&, std::int64_t /*samples*/, std::span<const Spike> /*last*/) { return {}; }
};

/// Force at the sites, block after block.
class SkinForce {
public:
    /// Valid until the next block.
    struct Block {
        SiteForce force;
        std::span<const double> total_force;  ///< of all sites together, N; one value for each step of the block
    };
    virtual ~SkinForce() = default;
    /// Returns the next block; at the end of the force, a block without samples.
    virtual Result<Block> next() = 0;
    virtual double progress() const = 0;  ///< completed fraction, 0 to 1
};

/// The force at the sites when a contact presses one channel of force onto the skin.
std::unique_ptr<SkinForce> make_pressed_force(ForceSource&, Contact&);
/// The force at the sites from one channel for each site; `sites`: the site of each channel.
std::unique_ptr<SkinForce> make_site_force(ForceSource&, std::vector<std::uint32_t> sites, std::size_t all_sites);
/// The site of each channel of a recording: by name, or by order if there are as many channels as sites.
Result<std::vector<std::uint32_t>> match_sites(const SkinPlan&, const ForceSource&);

/// Simulates a skin, in one process or divided among several.
class SkinSimulator {
public:
    virtual ~SkinSimulator() = default;
    /// Simulates these steps and appends their spikes.
    virtual Result<void> respond(const SiteForce&, std::size_t steps, std::vector<Spike>&) = 0;
    /// Call after the last step: appends the spikes that the nerve fibres are still conducting.
    virtual Result<void> flush(std::vector<Spike>&) = 0;
    virtual SkinStats stats() const = 0;
};
/// Simulates the complete skin in this process.
std::unique_ptr<SkinSimulator> local_skin_simulator(Skin&, ThreadPool&);

/// A record of a run that can be stopped and resumed: the spikes so far, to be replayed, and the sample at which to continue.
class SkinRunLog {
public:
    virtual ~SkinRunLog() = default;
    virtual std::int64_t resumed_samples() const = 0;  ///< samples simulated before this run
    /// Adds the force of the next block to the log. If the block was simulated before, returns an error unless its force is the same.
    virtual Result<void> add_force(const SkinForce::Block&, std::int64_t first) = 0;
    /// Replays the spikes of the next block that was simulated before.
    virtual Result<void> replay(std::int64_t end, std::vector<Spike>&) = 0;
    /// Appends the spikes of a newly simulated block.
    virtual Result<void> append(std::span<const Spike>) = 0;
    /// Makes everything so far durable.
    virtual Result<void> flush() = 0;
    /// Call at the end of the force, which had this many samples.
    virtual Result<void> finish(std::int64_t samples) = 0;
};

struct SkinRunOptions {
    /// Called once a block with the completed fraction, 0 to 1; false stops the run.
    std::function<bool(double)> should_continue = [](double) { return true; };
    SkinRunLog* log = nullptr;
};

/// Runs a force through a skin. A run that is stopped by the callback returns an error of code `interrupted`.
Result<SkinStats> run_skin(SkinForce&, const SkinInput&, SkinSimulator&, std::span<SkinSink* const>, const SkinRunOptions&);

}  // namespace corpuscle
