// The library's face for robots.

#include "corpuscle.hpp"
#include "live/live_population.hpp"
#include "live/skin_stream.hpp"
#include "skin/class_settings.hpp"

namespace corpuscle {

struct LiveSkin::Held {
    std::unique_ptr<SkinStream> stream;
    EventUnits units;
    std::vector<Event> events = {};

    std::span<const Event> told(std::span<const Spike> spikes) {
        events.clear();
        for (const auto& s : spikes) events.push_back({units.clock.time(s.step, s.offset), s.unit, units.addresses[s.unit]});
        return events;
    }
};

namespace {

template <class T>
T or_throw(Result<T>&& result) {
    if (!result) throw Refused(result.error().text());
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace

LiveSkin::LiveSkin(const std::string& population, double rate, std::size_t channels, const std::vector<std::string>& settings) {
    const auto clock = or_throw(clock_of(rate));
    std::vector<Wish> wishes;
    for (const auto& text : settings) wishes.push_back(or_throw(parse_wish(text)));
    auto plan = or_throw(plan_live(population, channels, wishes));
    or_throw(check_all_used(plan, wishes));
    auto placed = or_throw(innervate(std::move(plan)));
    auto units = event_units(*placed, clock);
    held_ = std::unique_ptr<Held>(new Held{or_throw(SkinStream::make(std::move(placed), clock)), std::move(units)});
    held_->events.reserve(8 * held_->units.names.size() + 64);
}
LiveSkin::LiveSkin(LiveSkin&&) noexcept = default;
LiveSkin& LiveSkin::operator=(LiveSkin&&) noexcept = default;
LiveSkin::~LiveSkin() = default;

std::size_t LiveSkin::sites() const { return held_->stream->sites(); }
LiveSkin::Site LiveSkin::site(std::size_t number) const {
    if (number >= sites()) throw Refused("there is no site " + std::to_string(number) + "; the last is " + std::to_string(sites() - 1));
    const auto& all = held_->stream->innervation().plan.sites;
    return {all.names[number], all.at[number].x, all.at[number].y};
}
std::size_t LiveSkin::units() const { return held_->units.names.size(); }
std::int64_t LiveSkin::frames() const { return held_->stream->frames(); }
std::string LiveSkin::name(std::uint32_t unit) const {
    if (unit >= units()) throw Refused("there is no unit " + std::to_string(unit) + "; the last is " + std::to_string(units() - 1));
    return held_->units.names[unit];
}

std::span<const LiveSkin::Event> LiveSkin::answer(std::span<const double> frame) {
    return held_->told(or_throw(held_->stream->push(frame)));
}
std::span<const LiveSkin::Event> LiveSkin::last() { return held_->told(held_->stream->last()); }

std::vector<std::byte> LiveSkin::save() const { return held_->stream->save(); }
void LiveSkin::resume(std::span<const std::byte> state) { or_throw(held_->stream->resume(state)); }

}  // namespace corpuscle
