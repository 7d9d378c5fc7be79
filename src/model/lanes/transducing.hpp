#pragma once
// Force into currents: the transductions of a tile over a chunk. Included by kernel.cpp alone.

#include "model/lanes/vectors.hpp"

namespace corpuscle::lanes {
namespace {

/// The force that vectors of a tile feel. A copy of what the call says: stores of lanes may be taken for changes of anything else.
template <Feed feed, class V>
struct Force {
    const V *rows = nullptr, *profile = nullptr, *gain = nullptr;
    const std::int16_t* words = nullptr;
    V scale{};
    explicit Force(const TransductionCall<V>& c, int unit) {
        if constexpr (feed == Feed::profile)
            profile = c.profile, gain = c.gain + unit;
        else if constexpr (feed == Feed::words)
            words = c.words + unit, scale = c.scale;
        else
            rows = c.rows + unit;
    }
    [[gnu::always_inline]] Batch<V> at(int step, int unit) const {
        if constexpr (feed == Feed::profile)
            return Batch<V>(profile[step]) * load(gain + unit);
        else if constexpr (feed == Feed::words)
            return num::of_words<V>(words + step * tile_units + unit) * Batch<V>(scale);
        else
            return load(rows + step * tile_units + unit);
    }
};

template <class V, class R>
void start(const TransductionCall<V>& c) {
    for (int unit = 0; unit < tile_units; unit += width<V>) {
        const auto& r = model<R>(c.models, c.stride, unit / width<V>);
        const auto at = [&](Feed f) {
            return f == Feed::profile ? Force<Feed::profile, V>(c, unit).at(0, 0)
                   : f == Feed::words ? Force<Feed::words, V>(c, unit).at(0, 0)
                                      : Force<Feed::rows, V>(c, unit).at(0, 0);
        };
        write(r.start(at(c.feed)), c.state, unit);
    }
}

template <class R>
inline constexpr bool continuous = requires { R::continuous; };

/// J vectors of a tile at once, from `unit` on.
template <class V, class R, Feed feed, int J>
void transduce(TransductionCall<V>& c, int unit, Asking& asked) {
    constexpr int w = width<V>;
    const R* r[J];
    typename R::State s[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        r[j] = &model<R>(c.models, c.stride, unit / w + j);
        s[j] = read<typename R::State>(c.state, unit + j * w);
    });
    // Rows of force are added up, for a sum that is no number: unless the receptor's own state would become one, and stay so.
    constexpr bool looks = feed == Feed::rows && !requires { R::keeps_strays; };
    Batch<V> sum[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) { sum[j] = Batch<V>(V(0)); });
    const Force<feed, V> force(c, unit);
    V *from = c.from + unit, *to = c.to + unit;
    Asking asking = asked;
    for (int t = 0, steps = c.steps; t < steps; ++t, from += tile_units, to += tile_units) {
        if constexpr (feed != Feed::profile) asking.some();
        each_of<J>([&](auto j) __attribute__((always_inline)) {
            const auto F = force.at(t, j * w);
            if constexpr (looks) sum[j] = sum[j] + F;
            Current<Batch<V>> i[R::outputs];
            r[j]->step(s[j], F, i);
            for (int k = 0; k < R::outputs; ++k) {
                if (!continuous<R> || t == 0) i[k].from.store_aligned(from + k * current_rows<V> * tile_units + j * w);
                i[k].to.store_aligned(to + k * current_rows<V> * tile_units + j * w);
            }
        });
    }
    asked = asking;
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        write(s[j], c.state, unit + j * w);
        const auto nothing = sum[j] - sum[j];  // or no number
        if constexpr (looks) c.strange = c.strange || !num::all(nothing == Batch<V>(V(0)));
    });
}

template <class V, class R>
void transduce_tile(TransductionCall<V>& c) {
    constexpr int J = 2;
    Asking asking(c.ahead, rounds<V, J>(c));
    for (int unit = 0; unit < c.units; unit += J * width<V>) {
        if (c.feed == Feed::rows) transduce<V, R, Feed::rows, J>(c, unit, asking);
        if (c.feed == Feed::words) transduce<V, R, Feed::words, J>(c, unit, asking);
        if (c.feed == Feed::profile) transduce<V, R, Feed::profile, J>(c, unit, asking);
    }
}

}  // namespace
}  // namespace corpuscle::lanes
