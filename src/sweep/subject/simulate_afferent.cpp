// Simulates one afferent with a complete force, also for the measures of a reference model.

#include <fmt/format.h>

#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {

Result<SimulatedResponse> simulate_afferent(const Afferent& afferent, const SweepForce& force, std::span<const std::size_t> probes,
                                            std::size_t every, const std::function<bool()>& stop) {
    const auto response = TRY(simulate(afferent, force.samples, {probes, every, stop}));
    SimulatedResponse out;
    for (const auto& values : response.probes) out.probe_samples.emplace_back(values.begin(), values.end());
    for (const auto& s : response.spikes)
        if (s.step <= static_cast<std::int64_t>(force.samples.size())) out.spikes.push_back(force.clock.time(s.step, s.offset));
    return out;
}

Result<double> model_measure(const LocatedText& model, const ForceFactory& force, const LocatedText& measure) {
    if (force.varies())
        return model.error_here("like: the force varies between items, and so does a model's response; write numbers instead");
    const auto plan = plan_any_afferent(model.text);
    if (!plan) return model.error_here("like: " + plan.error().message);
    const auto& sweep_force = *force.nominal();
    const auto afferent = make_afferent(plan->result, {sweep_force.clock.T()});
    const auto response = TRY(simulate_afferent(*afferent, sweep_force));
    AfferentMeasures measures(sweep_force, false, {});
    const auto column = TRY(measures.require_column(measure));
    ItemResponse item;
    item.spikes = response.spikes;
    return measures.values(sweep_force, item)[column];
}

}  // namespace corpuscle::sweeps
