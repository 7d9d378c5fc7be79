#include "study/trains.hpp"

#include <fmt/format.h>

#include "signal/stimuli.hpp"
#include "study/afferents.hpp"

namespace corpuscle {
namespace {

Result<std::vector<Wish>> wishes_of(const Asked& asked) {
    std::vector<Wish> wishes;
    for (const auto& text : asked.settings) {
        auto wish = parse_wish(text);
        if (!wish) return wish.error();
        wishes.push_back(std::move(*wish));
    }
    return wishes;
}

}  // namespace

Result<Touched> touch_of(const Asked& asked) {
    const auto wishes = wishes_of(asked);
    if (!wishes) return wishes.error();
    auto source = make_stimulus(asked.stimulus, *wishes, asked.rate, asked.seed);
    if (!source) return source.error();
    Touched out{(*source)->clock(), {}, (*source)->phases()};
    for (Frames block(1, 4096);;) {
        if (auto ok = (*source)->read(block); !ok) return ok.error();
        if (block.count == 0) return out;
        out.force.insert(out.force.end(), block.force[0].begin(), block.force[0].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

Line Touched::line() const {
    Line out{{}, force};
    for (std::size_t k = 0; k < force.size(); ++k) out.x.push_back(clock.time(static_cast<std::int64_t>(k)));
    return out;
}

namespace {

/// Which of its probes, by number, each trace is; a netlist's follow the order in which they are asked for.
Result<std::vector<std::size_t>> places_of(const Asked& asked, const Afferent& afferent) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < asked.traces.size(); ++k) {
        std::size_t at = 0;
        const auto probes = afferent.probes();
        while (at < probes.size() && probes[at].name != asked.traces[k]) ++at;
        if (at == probes.size() && names_netlist(asked.afferent) && asked.traces.size() == probes.size()) at = k;
        if (at == probes.size()) return bad_input(fmt::format("{} does not show '{}'", asked.afferent, asked.traces[k]));
        out.push_back(at);
    }
    return out;
}

}  // namespace

Result<Told> told_of(const Asked& asked) {
    auto touch = touch_of(asked);
    if (!touch) return touch.error();
    const auto plan = plan_any_afferent(asked.afferent, *wishes_of(asked), {.traces = asked.traces});
    if (!plan) return plan.error();
    const auto afferent = make_afferent(*plan, {touch->clock.T(), asked.method, asked.sampled});
    const auto places = places_of(asked, *afferent);
    if (!places) return places.error();
    const auto late = static_cast<std::size_t>(afferent->delay());
    touch->force.insert(touch->force.end(), late, touch->force.back());
    auto state = afferent->start();
    std::vector<Spike> spikes;
    std::vector<Outside> outside(afferent->ranges().size());
    std::vector<std::vector<double>> seen(asked.traces.empty() ? 0 : afferent->probes().size(), std::vector<double>(touch->force.size()));
    std::vector<double*> probes;
    for (auto& values : seen) probes.push_back(values.data());
    Answer answer{spikes};
    answer.outside = outside, answer.probes = probes;
    if (auto ok = afferent->respond(touch->force, state, answer); !ok) return ok.error();
    Told out{times(spikes, touch->clock), {}, {}};
    for (std::size_t k = 0; k < outside.size(); ++k)
        if (outside[k].samples > 0) out.outside.emplace_back(afferent->ranges()[k].meaning);
    for (std::size_t k = 0; k < asked.traces.size(); ++k) {
        auto& line = out.traces[asked.traces[k]];
        const auto& values = seen[(*places)[k]];
        for (std::size_t j = late; j < values.size(); ++j)
            line.x.push_back(touch->clock.time(static_cast<std::int64_t>(j - late))), line.y.push_back(values[j]);
    }
    return out;
}

Result<std::vector<double>> train_of(const Asked& asked) {
    auto told = told_of(asked);
    if (!told) return told.error();
    return std::move(told->spikes);
}

}  // namespace corpuscle
