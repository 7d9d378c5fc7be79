#pragma once
// Skin at work: force at the sites in, spikes of all its afferents out, block by block. Blocks of any size, threads and instruction
// sets give the same spikes to the bit; so does a skin that was saved and resumed.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "model/chain.hpp"
#include "signal/instruction_set.hpp"
#include "signal/pool.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// A block of force: site s at step t is of[s * stride + t], N.
struct SiteForce {
    const double* of = nullptr;
    std::size_t stride = 0;
    /// The sites that are not 0 all through the block, rising; the others are not read.
    std::span<const std::uint32_t> touched = {};
    bool all = true;  ///< no list of touched ones: look at all
};

/// Which of a skin's afferents one process has: an equal range of each class.
struct SkinShare {
    std::uint32_t part = 0, of = 1;
};

/// What was done.
struct SkinWork {
    std::int64_t steps = 0;           ///< samples of each site
    std::int64_t afferent_steps = 0;  ///< worked out
    std::int64_t at_rest = 0;         ///< afferent-steps passed over: no force came, and nothing in them could change
    std::int64_t spikes = 0;          ///< told
    std::int64_t capped = 0;          ///< steps whose spikes were more than the cap allows
};

class Skin {
public:
    /// Without noise, sensors and converters: see goes_on_lanes().
    static Result<std::unique_ptr<Skin>> make(const std::shared_ptr<const Innervation>&, const Run&, InstructionSet, SkinShare = {});
    ~Skin();

    const Innervation& innervation() const;
    std::size_t sites() const;
    std::int64_t step() const;  ///< samples answered so far
    const SkinWork& work() const;

    /// Answers the next block; appends to `spikes` those that arrive in it, in order of time, then unit. After the first blocks of
    /// its kind it allocates nothing with one thread, unless a step has more spikes than ever before.
    Result<void> respond(const SiteForce&, std::size_t steps, std::vector<Spike>& spikes, Pool&);
    /// Those still on their way to where the nerve is listened to.
    void last(std::vector<Spike>& spikes);

    /// All that it carries; packed by resume's own format. The same skin, made anew, goes on from there.
    std::vector<std::byte> save() const;
    Result<void> resume(std::span<const std::byte>);

    struct Held;

private:
    explicit Skin(std::unique_ptr<Held>);
    std::unique_ptr<Held> held_;
};

}  // namespace corpuscle
