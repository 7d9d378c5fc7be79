#include "reproduction/claims/trial.hpp"

#include <fmt/format.h>

#include "core/stimulus/stimuli.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"

namespace corpuscle {
namespace {

Result<std::vector<ParameterOverride>> trial_overrides(const TrialSpec& spec) {
    std::vector<ParameterOverride> overrides;
    for (const auto& text : spec.settings) {
        auto parsed = parse_override(text);
        if (!parsed) return parsed.error();
        overrides.push_back(std::move(*parsed));
    }
    return overrides;
}

}  // namespace

Result<TrialForce> trial_force(const TrialSpec& spec) {
    const auto overrides = trial_overrides(spec);
    if (!overrides) return overrides.error();
    auto source = make_stimulus(spec.stimulus, *overrides, spec.rate, spec.seed);
    if (!source) return source.error();
    auto force = read_channel(**source);
    if (!force) return force.error();
    return TrialForce{(*source)->clock(), std::move(*force), (*source)->phases()};
}

StudyCurve TrialForce::curve() const {
    StudyCurve out{{}, force};
    for (std::size_t k = 0; k < force.size(); ++k) out.x.push_back(clock.time(static_cast<std::int64_t>(k)));
    return out;
}

namespace {

/// The index in Afferent::probes() of each probe in the spec. The probes of a netlist may have longer names than requested ("i(xsummer.m1)"
/// for "i(m1)"); they are in the order of the request.
Result<std::vector<std::size_t>> probe_indexes(const TrialSpec& spec, const Afferent& afferent) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < spec.probes.size(); ++k) {
        std::size_t at = 0;
        const auto probes = afferent.probes();
        while (at < probes.size() && probes[at].name != spec.probes[k]) ++at;
        if (at == probes.size() && names_netlist(spec.afferent) && spec.probes.size() == probes.size()) at = k;
        if (at == probes.size()) return bad_input(fmt::format("{} has no recordable quantity '{}'", spec.afferent, spec.probes[k]));
        out.push_back(at);
    }
    return out;
}

}  // namespace

Result<TrialResult> run_trial(const TrialSpec& spec) {
    const auto trial = trial_force(spec);
    if (!trial) return trial.error();
    // trial_overrides() succeeds here, because it has succeeded in trial_force().
    const auto plan = plan_any_afferent(spec.afferent, *trial_overrides(spec), {.probes = spec.probes});
    if (!plan) return plan.error();
    const auto afferent = make_afferent(*plan, {trial->clock.T(), spec.method, spec.sampled});
    const auto indexes = probe_indexes(spec, *afferent);
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
