// Simulates one afferent with a complete force.

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

}  // namespace corpuscle::sweeps
