#include "corpuscle.hpp"

#include "measure/measures.hpp"
#include "signal/stimuli.hpp"
#include "study/afferents.hpp"

namespace corpuscle {
namespace {

template <class T>
T sure(Result<T> result) {
    if (!result) throw Refused(result.error().text());
    return std::move(*result);
}

std::vector<Wish> wishes_of(const std::vector<std::string>& settings) {
    std::vector<Wish> wishes;
    for (const auto& s : settings) wishes.push_back(sure(parse_wish(s)));
    return wishes;
}

void check_used(std::span<const Wish> wishes) {
    for (const auto& w : wishes)
        if (!w.used) throw Refused(w.text() + ": nothing here is called '" + w.of + "'");
}

}  // namespace

Touch stimulus(const std::string& name, const std::vector<std::string>& settings, double rate, std::uint64_t seed) {
    const auto wishes = wishes_of(settings);
    const auto source = sure(make_stimulus(name, wishes, rate, seed));
    check_used(wishes);
    Touch touch{source->clock().rate(), {}};
    for (Frames block(1, 4096);;) {
        if (auto ok = source->read(block); !ok) throw Refused(ok.error().text());
        if (block.count == 0) return touch;
        touch.force.insert(touch.force.end(), block.force[0].begin(), block.force[0].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

Response respond(const std::string& afferent, const Touch& touch, const std::vector<std::string>& settings) {
    const auto wishes = wishes_of(settings);
    const auto plan = sure(plan_any_afferent(afferent, wishes));
    check_used(wishes);
    const auto clock = sure(clock_of(touch.rate));
    const auto made = make_afferent(plan, {clock.T()});
    auto state = made->start();
    std::vector<Spike> spikes;
    Answer answer{spikes};
    auto force = touch.force;
    if (!force.empty()) force.insert(force.end(), static_cast<std::size_t>(made->delay()), force.back());
    if (auto ok = made->respond(force, state, answer); !ok) throw Refused(ok.error().text());
    return {times(spikes, clock)};
}

std::vector<double> Response::rates() const { return instantaneous_rates(spikes); }

}  // namespace corpuscle
