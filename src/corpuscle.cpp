#include "corpuscle.hpp"

#include <array>

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

/// The result of applied overrides; throws if one of them has another target than the thing called `name`.
template <class T>
T result_or_throw(Applied<T> applied, std::string_view name) {
    if (const auto ok = check_all_used(applied.unused, std::array{name}); !ok) throw InputError(ok.error().text());
    return std::move(applied.result);
}

}  // namespace

ForceSignal stimulus(const std::string& name, const std::vector<std::string>& settings, double rate, std::uint64_t seed) {
    const auto source = result_or_throw(value_or_throw(make_stimulus(name, value_or_throw(parse_overrides(settings)), rate, seed)), name);
    return {source->clock().rate(), value_or_throw(read_channel(*source))};
}

Response respond(const std::string& afferent, const ForceSignal& signal, const std::vector<std::string>& settings) {
    Applied<AfferentPlan> planned = value_or_throw(plan_any_afferent(afferent, value_or_throw(parse_overrides(settings))));
    const auto plan = result_or_throw(std::move(planned), afferent);
    const auto clock = value_or_throw(make_clock(signal.rate));
    const auto model = make_afferent(plan, {clock.T()});
    return {spike_times(value_or_throw(simulate(*model, signal.force)).spikes, clock)};
}

std::vector<double> Response::instantaneous_rates() const { return corpuscle::instantaneous_rates(spikes); }

}  // namespace corpuscle
