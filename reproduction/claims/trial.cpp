#include "reproduction/claims/trial.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/stimulus/stimuli.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"

namespace corpuscle {

Result<TrialForce> trial_force(const TrialSpec& spec) {
    const auto overrides = parse_overrides(spec.settings);
    if (!overrides) return overrides.error();
    const auto made = make_stimulus(spec.stimulus, *overrides, spec.rate, spec.seed);
    if (!made) return made.error();
    auto& source = *made->result;
    auto force = read_channel(source);
    if (!force) return force.error();
    return TrialForce{source.clock(), std::move(*force), source.phases()};
}

StudyCurve TrialForce::curve() const {
    StudyCurve out{{}, force};
    for (std::size_t k = 0; k < force.size(); ++k) out.x.push_back(clock.time(static_cast<std::int64_t>(k)));
    return out;
}

namespace {

/// The index in Afferent::probes() of each probe in the spec. `requested`: their names, if the afferent has other names for them
/// ("i(xsummer.m1)" for "i(m1)").
Result<std::vector<std::size_t>> probe_indexes(const TrialSpec& spec, const Afferent& afferent, std::span<const RequestedProbe> requested) {
    std::vector<std::size_t> out;
    const auto probes = afferent.probes();
    for (std::size_t k = 0; k < spec.probes.size(); ++k) {
        const auto name = requested.empty() ? spec.probes[k] : requested[k].name.value_or(spec.probes[k]);
        const auto at = std::find_if(probes.begin(), probes.end(), [&](const Probe& p) { return p.name == name; });
        if (at == probes.end()) return bad_input(fmt::format("{} has no recordable quantity '{}'", spec.afferent, spec.probes[k]));
        out.push_back(static_cast<std::size_t>(at - probes.begin()));
    }
    return out;
}

}  // namespace

Result<TrialResult> run_trial(const TrialSpec& spec) {
    const auto trial = trial_force(spec);
    if (!trial) return trial.error();
    const auto overrides = parse_overrides(spec.settings);
    if (!overrides) return overrides.error();
    const auto planned = plan_any_afferent(spec.afferent, *overrides, spec.probes);
    if (!planned) return planned.error();
    const auto afferent = make_afferent(planned->result, {trial->clock.T(), spec.method, spec.sampled});
    const auto indexes = probe_indexes(spec, *afferent, planned->probes);
    if (!indexes) return indexes.error();
    auto response = simulate(*afferent, trial->force, {*indexes});
    if (!response) return response.error();
    TrialResult out{spike_times(response->spikes, trial->clock), {}, {}};
    for (std::size_t k = 0; k < response->range_violations.size(); ++k)
        if (response->range_violations[k].samples > 0) out.range_warnings.emplace_back(afferent->ranges()[k].meaning);
    for (std::size_t p = 0; p < spec.probes.size(); ++p) {
        auto& curve = out.probes[spec.probes[p]];
        curve = trial->curve();
        curve.y = std::move(response->probes[p]);
    }
    return out;
}

Result<std::vector<double>> simulate_train(const TrialSpec& spec) {
    auto result = run_trial(spec);
    if (!result) return result.error();
    return std::move(result->spikes);
}

}  // namespace corpuscle
