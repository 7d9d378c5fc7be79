#pragma once
// Force through a whole skin to listeners: what respond.hpp is for afferents on channels.

#include <functional>
#include <memory>

#include "signal/source.hpp"
#include "skin/contact/contact.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// What is answered.
struct SkinInput {
    std::string name;      ///< of the force: "press"
    std::string sentence;  ///< "a sphere of 5 mm, pressed with ..."
    Clock clock;
    std::vector<Phase> phases;
    const Innervation& skin;
};

/// What one block gave.
struct SkinAnswered {
    std::int64_t first = 0;  ///< number of the block's first sample
    std::size_t steps = 0;
    const SiteForce& force;
    std::span<const double> total;  ///< force of all sites together at each step, N
    std::span<const Spike> spikes;  ///< in order of time, then unit
};

class SkinListener {
public:
    virtual ~SkinListener() = default;
    virtual Result<void> begin(const SkinInput&) { return {}; }
    virtual Result<void> block(const SkinInput&, const SkinAnswered&) { return {}; }
    /// `last`: spikes still on their way at the end of the force.
    virtual Result<void> end(const SkinInput&, std::int64_t /*samples*/, std::span<const Spike> /*last*/) { return {}; }
};

/// Force at the sites, block after block.
class SkinForce {
public:
    /// What one block is; it stays until the next.
    struct Block {
        SiteForce force;
        std::span<const double> total;  ///< of all sites together, N; as long as the block
    };
    virtual ~SkinForce() = default;
    /// No samples: the end.
    virtual Result<Block> next() = 0;
    virtual double done() const = 0;  ///< 0 to 1
};

/// One channel of force, pressed onto the skin.
std::unique_ptr<SkinForce> pressed_force(Source&, Contact&);
/// A channel a site; `sites`: of each channel.
std::unique_ptr<SkinForce> site_force(Source&, std::vector<std::uint32_t> sites, std::size_t all_sites);
/// Which site each channel of a recording is: by name, or where there are as many of both, in order.
Result<std::vector<std::uint32_t>> sites_of(const SkinPlan&, const Source&);

/// Who answers: one skin, or shares of it in several processes.
class SkinAnswerer {
public:
    virtual ~SkinAnswerer() = default;
    virtual Result<void> answer(const SiteForce&, std::size_t steps, std::vector<Spike>&) = 0;
    virtual Result<void> last(std::vector<Spike>&) = 0;
    virtual SkinWork work() const = 0;
};
/// All of it in this process.
std::unique_ptr<SkinAnswerer> alone_answerer(Skin&, Pool&);

/// A run that can be stopped and gone on with: what was answered so far, to be told again, and where to go on.
class SkinSpool {
public:
    virtual ~SkinSpool() = default;
    virtual std::int64_t step() const = 0;  ///< answered before this run
    /// The force of the next block, answered before or not; refuses one that is not what it was before.
    virtual Result<void> force(const SkinForce::Block&, std::int64_t first) = 0;
    /// Of those, the spikes of the next block.
    virtual Result<void> told(std::int64_t end, std::vector<Spike>&) = 0;
    /// A block answered now.
    virtual Result<void> answered(std::span<const Spike>) = 0;
    /// Nothing is lost of what was answered so far.
    virtual Result<void> keep() = 0;
    /// The force had so many samples.
    virtual Result<void> ended(std::int64_t samples) = 0;
};

struct SkinRunOptions {
    /// Called once a block with the share done, 0 to 1; false stops the run.
    std::function<bool(double)> keep_on = [](double) { return true; };
    SkinSpool* spool = nullptr;
};

/// Runs a force through a skin. Stopped by keep_on, it is an error of code `interrupted`.
Result<SkinWork> run_skin(SkinForce&, const SkinInput&, SkinAnswerer&, std::span<SkinListener* const>, const SkinRunOptions&);

}  // namespace corpuscle
