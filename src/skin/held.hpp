#pragma once
// What a skin at work holds. Included by skin.cpp and saved.cpp alone.

#include <optional>

#include "model/population.hpp"
#include "skin/conduction.hpp"
#include "skin/field.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// The units of one class: what they feel, and they.
struct SkinCrowd {
    std::unique_ptr<Population> population;
    std::shared_ptr<FeltForce> felt;
    bool as_before = false;  ///< another class stands as this one and feels the same: it has worked that out
};

struct Skin::Held {
    Held(std::shared_ptr<const Innervation> skin, const Run& run, SkinShare share)
        : skin(std::move(skin)), run(run), share(share), conduction(*this->skin, run.dt) {}

    std::shared_ptr<const Innervation> skin;
    Run run;
    SkinShare share;
    std::vector<SkinCrowd> crowds;
    Conduction conduction;
    std::vector<Spike> left;             // the skin, in the steps at work
    std::vector<std::uint32_t> touched;  // in them
    std::int64_t step = 0;
    SkinWork work;

    std::span<const std::uint32_t> touched_in(const SiteForce&, std::size_t at, std::size_t steps);
    Result<void> feel(const SiteForce&, std::size_t at, std::size_t steps, std::vector<Spike>&, Pool&);
};

}  // namespace corpuscle
