#include "reproduction/claims/trial.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/stimulus/stimuli.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"

namespace corpuscle {

Result<TrialForce> trial_force(const TrialSpec& spec) {
    const auto overrides = TRY(parse_overrides(spec.settings));
    const auto made = TRY(make_stimulus(spec.stimulus, overrides, spec.rate, spec.seed));
    auto& source = *made.result;
    auto force = TRY(read_channel(source));
    return TrialForce{source.clock(), std::move(force), source.phases()};
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
    const auto trial = TRY(trial_force(spec));
    const auto overrides = TRY(parse_overrides(spec.settings));
    const auto planned = TRY(plan_any_afferent(spec.afferent, overrides, spec.probes));
    const auto afferent = make_afferent(planned.result, {trial.clock.T(), spec.method, spec.sampled});
    const auto indexes = TRY(probe_indexes(spec, *afferent, planned.probes));
    auto response = TRY(simulate(*afferent, trial.force, {indexes}));
    TrialResult out{spike_times(response.spikes, trial.clock), {}, {}};
    for (std::size_t k = 0; k < response.range_violations.size(); ++k)
        if (response.range_violations[k].samples > 0) out.range_warnings.emplace_back(afferent->ranges()[k].meaning);
    for (std::size_t p = 0; p < spec.probes.size(); ++p) {
        auto& curve = out.probes[spec.probes[p]];
        curve = trial.curve();
        curve.y = std::move(response.probes[p]);
    }
    return out;
}

Result<std::vector<double>> simulate_train(const TrialSpec& spec) {
    auto result = TRY(run_trial(spec));
    return std::move(result.spikes);
}

}  // namespace corpuscle
