// Simulates one afferent with a complete force, also for the measures of a reference model.

#include <fmt/format.h>
#include <algorithm>

#include "run/afferent_plan.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::size_t block_samples = 4096;

}  // namespace

Result<SimulatedResponse> simulate_afferent(const Afferent& afferent, const SweepForce& force, std::span<const std::size_t> probes,
                                            std::size_t every, const std::function<bool()>& stop) {
    // The response to a sample comes `delay` samples later, so the last force is held for that time.
    const auto delay = static_cast<std::size_t>(afferent.delay());
    auto samples = force.samples;
    samples.insert(samples.end(), delay, samples.back());
    std::vector<std::vector<double>> probe_values(probes.empty() ? 0 : afferent.probes().size(), std::vector<double>(block_samples));
    std::vector<double*> probe_rows;
    for (auto& s : probe_values) probe_rows.push_back(s.data());
    SimulatedResponse out;
    out.probe_samples.resize(probes.size());
    std::vector<Spike> spikes;
    auto state = afferent.start();
    for (std::size_t at = 0; at < samples.size(); at += block_samples) {
        if (stop && stop()) return Error{ErrorCode::interrupted, "interrupted"};
        const auto count = std::min(block_samples, samples.size() - at);
        ResponseBlock response{spikes, 0, probe_rows};
        if (auto ok = afferent.respond(std::span(samples).subspan(at, count), state, response); !ok) return ok.error();
        for (std::size_t p = 0; p < probes.size(); ++p)
            for (std::size_t k = 0; k < count; ++k)
                if (at + k >= delay && (at + k - delay) % every == 0)
                    out.probe_samples[p].push_back(static_cast<float>(probe_values[probes[p]][k]));
    }
    for (const auto& s : spikes)
        if (s.step <= static_cast<std::int64_t>(force.samples.size())) out.spikes.push_back(force.clock.time(s.step, s.offset));
    return out;
}

Result<double> model_measure(const LocatedText& model, const ForceFactory& force, const LocatedText& measure) {
    if (force.varies())
        return model.error_here("like: the force varies between items, and so does a model's response; write numbers instead");
    const auto plan = plan_any_afferent(model.text, {});
    if (!plan) return model.error_here("like: " + plan.error().message);
    const auto& sweep_force = *force.nominal();
    const auto afferent = make_afferent(*plan, {sweep_force.clock.T()});
    const auto response = simulate_afferent(*afferent, sweep_force);
    if (!response) return response.error();
    AfferentMeasures measures(sweep_force, false, {});
    const auto column = measures.require_column(measure);
    if (!column) return column.error();
    ItemResponse item;
    item.spikes = response->spikes;
    return measures.values(sweep_force, item)[*column];
}

}  // namespace corpuscle::sweeps
