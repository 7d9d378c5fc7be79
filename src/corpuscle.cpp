#include "corpuscle.hpp"

#include "core/stimulus/stimuli.hpp"
#include "measure/measures.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"

namespace corpuscle {
namespace {

template <class T>
T value_or_throw(Result<T> result) {
    if (!result) throw InputError(result.error().text());
    return std::move(*result);
}

std::vector<ParameterOverride> parse_overrides(const std::vector<std::string>& settings) {
    std::vector<ParameterOverride> overrides;
    for (const auto& s : settings) overrides.push_back(value_or_throw(parse_override(s)));
    return overrides;
}

void check_used(std::span<const ParameterOverride> overrides) {
    for (const auto& o : overrides)
        if (!o.is_used) throw InputError(o.text() + ": no model or stimulus in use is named '" + o.target + "'");
}

}  // namespace

ForceSignal stimulus(const std::string& name, const std::vector<std::string>& settings, double rate, std::uint64_t seed) {
    const auto overrides = parse_overrides(settings);
    const auto source = value_or_throw(make_stimulus(name, overrides, rate, seed));
    check_used(overrides);
    return {source->clock().rate(), value_or_throw(read_channel(*source))};
}

Response respond(const std::string& afferent, const ForceSignal& signal, const std::vector<std::string>& settings) {
    const auto overrides = parse_overrides(settings);
    const auto plan = value_or_throw(plan_any_afferent(afferent, overrides));
    check_used(overrides);
    const auto clock = value_or_throw(make_clock(signal.rate));
    const auto model = make_afferent(plan, {clock.T()});
    return {spike_times(value_or_throw(simulate(*model, signal.force)).spikes, clock)};
}

std::vector<double> Response::instantaneous_rates() const { return corpuscle::instantaneous_rates(spikes); }

}  // namespace corpuscle
