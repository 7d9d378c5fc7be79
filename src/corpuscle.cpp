#include "corpuscle.hpp"

#include "measure/measures.hpp"
#include "core/stimulus/stimuli.hpp"
#include "run/afferent_plan.hpp"

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
    ForceSignal signal{source->clock().rate(), {}};
    for (Frames block(1, 4096);;) {
        if (auto ok = source->read(block); !ok) throw InputError(ok.error().text());
        if (block.count == 0) return signal;
        signal.force.insert(signal.force.end(), block.force[0].begin(), block.force[0].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

Response respond(const std::string& afferent, const ForceSignal& signal, const std::vector<std::string>& settings) {
    const auto overrides = parse_overrides(settings);
    const auto plan = value_or_throw(plan_any_afferent(afferent, overrides));
    check_used(overrides);
    const auto clock = value_or_throw(make_clock(signal.rate));
    const auto model = make_afferent(plan, {clock.T()});
    auto state = model->start();
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    auto force = signal.force;
    // Hold the last force for the delay of the model, so that the response to the last sample is complete.
    if (!force.empty()) force.insert(force.end(), static_cast<std::size_t>(model->delay()), force.back());
    if (auto ok = model->respond(force, state, response); !ok) throw InputError(ok.error().text());
    return {spike_times(spikes, clock)};
}

std::vector<double> Response::instantaneous_rates() const { return corpuscle::instantaneous_rates(spikes); }

}  // namespace corpuscle
