#include "study/trains.hpp"

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

Result<Told> told_of(const Asked& asked) {
    auto touch = touch_of(asked);
    if (!touch) return touch.error();
    const auto plan = plan_any_afferent(asked.afferent, *wishes_of(asked));
    if (!plan) return plan.error();
    const auto afferent = make_afferent(*plan, {touch->clock.T()});
    touch->force.insert(touch->force.end(), static_cast<std::size_t>(afferent->delay()), touch->force.back());
    auto state = afferent->start();
    std::vector<Spike> spikes;
    std::vector<Outside> outside(afferent->ranges().size());
    Answer answer{spikes};
    answer.outside = outside;
    if (auto ok = afferent->respond(touch->force, state, answer); !ok) return ok.error();
    Told out{times(spikes, touch->clock), {}};
    for (std::size_t k = 0; k < outside.size(); ++k)
        if (outside[k].samples > 0) out.outside.emplace_back(afferent->ranges()[k].meaning);
    return out;
}

Result<std::vector<double>> train_of(const Asked& asked) {
    auto told = told_of(asked);
    if (!told) return told.error();
    return std::move(told->spikes);
}

}  // namespace corpuscle
