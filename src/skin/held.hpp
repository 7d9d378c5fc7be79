#pragma once
// Implementation of Skin. Included only by skin.cpp and skin_state.cpp.

#include <optional>

#include "model/population.hpp"
#include "skin/conduction.hpp"
#include "skin/field.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// The afferents of one class and the force on them.
struct SkinCrowd {
    std::unique_ptr<Population> population;
    std::shared_ptr<FeltForce> felt;
    bool as_before = false;  ///< the force is shared with a class that has the same receptive fields and is computed there
};

struct Skin::Held {
    Held(std::shared_ptr<const Innervation> skin, const Run& run, SkinShare share)
        : skin(std::move(skin)), run(run), share(share), conduction(*this->skin, run.dt) {}

    std::shared_ptr<const Innervation> skin;
    Run run;
    SkinShare share;
    std::vector<SkinCrowd> crowds;
    Conduction conduction;
    std::vector<Spike> left;             // spikes fired in the current steps
    std::vector<std::uint32_t> touched;  // sites touched in them
    std::int64_t step = 0;
    SkinWork work;

    std::span<const std::uint32_t> touched_in(const SiteForce&, std::size_t at, std::size_t steps);
    Result<void> feel(const SiteForce&, std::size_t at, std::size_t steps, std::vector<Spike>&, ThreadPool&);
};

}  // namespace corpuscle
