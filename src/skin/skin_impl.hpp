#pragma once
// Implementation of Skin. Included only by skin.cpp and skin_state.cpp.

#include "skin/conduction.hpp"
#include "skin/field_force.hpp"

namespace corpuscle {

/// The afferents of one class and the force on them.
struct ClassSimulation {
    std::unique_ptr<LanePopulation> population;
    std::shared_ptr<FieldForce> field_force;
    bool shares_force = false;  ///< true: an earlier class has the same receptive fields and computes the force for both
};

struct Skin::Impl {
    Impl(std::shared_ptr<const Innervation> skin, const SimulationOptions& run, SkinPart part)
        : skin(std::move(skin)), run(run), part(part), conduction(*this->skin, run.dt) {}

    std::shared_ptr<const Innervation> skin;
    SimulationOptions run;
    SkinPart part;
    std::vector<ClassSimulation> classes;
    Conduction conduction;
    std::vector<Spike> fired;            // spikes fired in the skin during the call of run_steps()
    std::vector<std::uint32_t> touched;  // result of find_touched()
    std::int64_t step = 0;               // number of samples simulated so far
    SkinStats stats;

    std::span<const std::uint32_t> find_touched(const SiteForce&, std::size_t at, std::size_t steps);
    Result<void> run_steps(const SiteForce&, std::size_t at, std::size_t steps, std::vector<Spike>&, ThreadPool&);
};

}  // namespace corpuscle
