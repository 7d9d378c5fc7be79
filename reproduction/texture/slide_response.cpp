#include "reproduction/texture/slide_response.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/variant/netlist_overrides.hpp"
#include "reproduction/thesis/chip_runs.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"

namespace corpuscle {

Result<SlideSpikes> simulate_slides(const std::string& afferent, const std::vector<TaxelValues>& forces) {
    const auto planned = TRY(plan_any_afferent(afferent));
    const auto clock = TRY(make_clock(slide_force_rate));
    const auto made = make_afferent(planned.result, {.dt = clock.T()});
    SlideSpikes out;
    for (const auto& recording : forces) {
        out.emplace_back();
        for (const auto& force : recording.smooth) {
            const auto response = TRY(simulate(*made, force));
            out.back().push_back(spike_times(response.spikes, clock));
        }
    }
    return out;
}

Result<SlideSpikes> simulate_slides_with_chips(const std::string& chip, const std::vector<TaxelValues>& forces, double duration,
                                               const std::function<bool(double)>& progress) {
    const auto netlist = TRY(circuit::apply_overrides(chip, {}));
    const auto design = TRY(circuit::CircuitAfferentFactory::create(netlist.result));
    std::vector<circuit::Chip> chips;
    for (const auto& recording : forces)
        for (const auto& force : recording.smooth) {
            const auto samples = std::min(force.size(), static_cast<std::size_t>(duration * slide_force_rate));
            chips.push_back({0, design, {}, std::span(force).first(samples), 1 / slide_force_rate});
        }
    const auto total = static_cast<double>(chips.size());
    auto responses = TRY(run_all_chips(std::move(chips), [&](std::size_t done) { return progress(static_cast<double>(done) / total); }));
    SlideSpikes out;
    auto next = responses.begin();
    for (const auto& recording : forces) {
        out.emplace_back();
        for (std::size_t c = 0; c < recording.smooth.size(); ++c, ++next) {
            if (next->error) return *next->error;
            out.back().push_back(std::move(next->spikes));
        }
    }
    return out;
}

}  // namespace corpuscle
