#pragma once
// Force through a whole skin to listeners: what respond.hpp is for afferents on channels.

#include <functional>

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

}  // namespace corpuscle
