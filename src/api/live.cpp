#include "corpuscle/live.hpp"

#include "api/result.hpp"
#include "live/live_population.hpp"
#include "live/skin_stream.hpp"
#include "skin/plan/skin_plan.hpp"
#include "skin/taxel/taxel_frames.hpp"

namespace corpuscle {

struct LiveSkin::Impl {
    std::unique_ptr<SkinStream> stream;
    EventAddressing addressing;
    TaxelFrames taxels = {};                                      // without taxels: not used
    std::vector<double> normal = {}, shear_x = {}, shear_y = {};  // at the sites in the last frame of taxels, N
    std::vector<Event> events = {};                               // result of the last respond() or finish()

    /// Places the afferents of a plan.
    static std::unique_ptr<Impl> make(SkinPlan plan, double rate) {
        const auto clock = api::value_or_throw(make_clock(rate));
        auto placed = api::value_or_throw(innervate(std::move(plan)));
        auto addressing = make_event_addressing(*placed, clock);
        auto impl = std::unique_ptr<Impl>(new Impl{api::value_or_throw(SkinStream::make(std::move(placed), clock)), std::move(addressing)});
        impl->events.reserve(8 * impl->addressing.names.size() + 64);
        return impl;
    }

    /// Simulates a frame of sites or taxels.
    Result<std::span<const Spike>> push(std::span<const double> frame) {
        if (taxels.frame_size() == 0) return stream->push(frame);
        if (frame.size() != taxels.frame_size())
            return bad_input("a frame has " + std::to_string(frame.size()) + " forces, but those of these taxels have " +
                             std::to_string(taxels.frame_size()));
        taxels.spread(frame.data(), normal.data(), shear_x.data(), shear_y.data());
        return taxels.has_shear() ? stream->push(normal, shear_x, shear_y) : stream->push(normal);
    }

    std::span<const Event> to_events(std::span<const Spike> spikes) {
        events.clear();
        for (const auto& s : spikes)
            events.push_back({addressing.clock.time(s.step, s.offset), s.afferent_index, addressing.addresses[s.afferent_index]});
        return events;
    }
};

namespace {

/// The plan of a live skin with all settings applied.
SkinPlan plan_with_settings(const std::string& population, std::size_t channels, const std::vector<std::string>& settings) {
    auto applied = api::value_or_throw(make_live_plan(population, channels, api::value_or_throw(parse_overrides(settings))));
    api::value_or_throw(check_all_used(applied.unused, override_targets(applied.result)));
    return std::move(applied.result);
}

}  // namespace

LiveSkin::LiveSkin(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
LiveSkin::LiveSkin(const std::string& population, double rate, std::size_t channels, const std::vector<std::string>& settings)
    : impl_(Impl::make(plan_with_settings(population, channels, settings), rate)) {}

LiveSkin LiveSkin::with_taxels(const std::string& population, const std::string& taxels, double rate,
                               const std::vector<std::string>& settings) {
    if (is_afferent_list(population)) throw InputError("taxels need a skin, such as hand, fingertip or \"grid 8x8\", not " + population);
    const auto layout = api::value_or_throw(read_taxel_layout(taxels));
    auto plan = plan_with_settings(population, 1, settings);
    treat_as_skin(plan);
    auto map = api::value_or_throw(map_taxels(layout, plan.sites));
    auto impl = Impl::make(std::move(plan), rate);
    for (auto* force : {&impl->normal, &impl->shear_x, &impl->shear_y}) force->resize(impl->stream->sites());
    impl->taxels = TaxelFrames(layout, std::move(map), layout.has_axes);
    return LiveSkin(std::move(impl));
}
LiveSkin::LiveSkin(LiveSkin&&) noexcept = default;
LiveSkin& LiveSkin::operator=(LiveSkin&&) noexcept = default;
LiveSkin::~LiveSkin() = default;

std::size_t LiveSkin::frame_size() const { return impl_->taxels.frame_size() > 0 ? impl_->taxels.frame_size() : sites(); }
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
    return impl_->to_events(api::value_or_throw(impl_->push(frame)));
}
std::span<const LiveSkin::Event> LiveSkin::finish() { return impl_->to_events(impl_->stream->finish()); }

std::vector<std::byte> LiveSkin::save() const { return impl_->stream->save(); }
void LiveSkin::resume(std::span<const std::byte> state) { api::value_or_throw(impl_->stream->resume(state)); }

}  // namespace corpuscle
