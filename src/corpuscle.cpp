#include "corpuscle.hpp"

#include <array>

#include "core/stimulus/stimuli.hpp"
#include "live/live_population.hpp"
#include "live/skin_stream.hpp"
#include "measure/measures.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {
namespace {

/// The value of a result; throws its error.
template <class T>
T value_or_throw(Result<T> result) {
    if (!result) throw InputError(result.error().text());
    if constexpr (!std::is_void_v<T>) return std::move(*result);
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

struct LiveSkin::Impl {
    std::unique_ptr<SkinStream> stream;
    EventAddressing addressing;
    std::vector<Event> events = {};  // result of the last respond() or finish()

    std::span<const Event> to_events(std::span<const Spike> spikes) {
        events.clear();
        for (const auto& s : spikes)
            events.push_back({addressing.clock.time(s.step, s.offset), s.afferent_index, addressing.addresses[s.afferent_index]});
        return events;
    }
};

LiveSkin::LiveSkin(const std::string& population, double rate, std::size_t channels, const std::vector<std::string>& settings) {
    const auto clock = value_or_throw(make_clock(rate));
    auto applied = value_or_throw(make_live_plan(population, channels, value_or_throw(parse_overrides(settings))));
    value_or_throw(check_all_used(applied.unused, override_targets(applied.result)));
    auto placed = value_or_throw(innervate(std::move(applied.result)));
    auto addressing = make_event_addressing(*placed, clock);
    impl_ = std::unique_ptr<Impl>(new Impl{value_or_throw(SkinStream::make(std::move(placed), clock)), std::move(addressing)});
    impl_->events.reserve(8 * impl_->addressing.names.size() + 64);
}
LiveSkin::LiveSkin(LiveSkin&&) noexcept = default;
LiveSkin& LiveSkin::operator=(LiveSkin&&) noexcept = default;
LiveSkin::~LiveSkin() = default;

std::size_t LiveSkin::sites() const { return impl_->stream->sites(); }
LiveSkin::Site LiveSkin::site(std::size_t number) const {
    if (number >= sites()) throw InputError("there is no site " + std::to_string(number) + "; the last is " + std::to_string(sites() - 1));
    const auto& all = impl_->stream->innervation().plan.sites;
    return {all.names[number], all.positions[number].x, all.positions[number].y};
}
std::size_t LiveSkin::afferents() const { return impl_->addressing.names.size(); }
std::int64_t LiveSkin::frames() const { return impl_->stream->frames(); }
std::string LiveSkin::afferent_name(std::uint32_t index) const {
    if (index >= afferents())
        throw InputError("there is no afferent " + std::to_string(index) + "; the last is " + std::to_string(afferents() - 1));
    return impl_->addressing.names[index];
}

std::span<const LiveSkin::Event> LiveSkin::respond(std::span<const double> frame) {
    return impl_->to_events(value_or_throw(impl_->stream->push(frame)));
}
std::span<const LiveSkin::Event> LiveSkin::finish() { return impl_->to_events(impl_->stream->finish()); }

std::vector<std::byte> LiveSkin::save() const { return impl_->stream->save(); }
void LiveSkin::resume(std::span<const std::byte> state) { value_or_throw(impl_->stream->resume(state)); }

}  // namespace corpuscle
