#pragma once
// Receptors of a tile over a chunk: force in, currents out. Included only by kernel.cpp.

#include "model/lanes/vectors.hpp"

namespace corpuscle::lanes {
namespace {

/// Reads the force of a tile's vectors. It copies the pointers of the call, because the compiler may assume that stores of lanes change
/// them.
template <Feed feed, class V>
struct Force {
    const V *rows = nullptr, *profile = nullptr, *gain = nullptr;
    const std::int16_t* words = nullptr;
    V scale{};
    explicit Force(const TransductionCall<V>& c, int first) {
        if constexpr (feed == Feed::profile)
            profile = c.profile, gain = c.gain + first;
        else if constexpr (feed == Feed::words)
            words = c.words + first, scale = c.scale;
        else
            rows = c.rows + first;
    }
    [[gnu::always_inline]] Batch<V> at(int step, int first) const {
        if constexpr (feed == Feed::profile)
            return Batch<V>(profile[step]) * load(gain + first);
        else if constexpr (feed == Feed::words)
            return num::load_int16<V>(words + step * tile_units + first) * Batch<V>(scale);
        else
            return load(rows + step * tile_units + first);
    }
};

template <class V, class R>
void start(const TransductionCall<V>& c) {
    for (int first = 0; first < tile_units; first += width<V>) {
        const auto& r = model<R>(c.models, c.stride, first / width<V>);
        const auto at = [&](Feed f) {
            return f == Feed::profile ? Force<Feed::profile, V>(c, first).at(0, 0)
                   : f == Feed::words ? Force<Feed::words, V>(c, first).at(0, 0)
                                      : Force<Feed::rows, V>(c, first).at(0, 0);
        };
        write(r.start(at(c.feed)), c.state, first);
    }
}

template <class R>
inline constexpr bool continuous = requires { R::continuous; };

/// J vectors of a tile at once, from `first` on.
template <class V, class R, Feed feed, int J>
void transduce(TransductionCall<V>& c, int first, Asking& prefetch) {
    constexpr int w = width<V>;
    const R* r[J];
    typename R::State s[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        r[j] = &model<R>(c.models, c.stride, first / w + j);
        s[j] = read<typename R::State>(c.state, first + j * w);
    });
    // Rows of force are summed to detect NaN and infinity. This is not needed if such a force makes the receptor's own state NaN for good.
    constexpr bool checks_force = feed == Feed::rows && !requires { R::keeps_strays; };
    Batch<V> sum[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) { sum[j] = Batch<V>(V(0)); });
    const Force<feed, V> force(c, first);
    V *from = c.from + first, *to = c.to + first;
    Asking local = prefetch;
    for (int t = 0, steps = c.steps; t < steps; ++t, from += tile_units, to += tile_units) {
        if constexpr (feed != Feed::profile) local.some();
        each_of<J>([&](auto j) __attribute__((always_inline)) {
            const auto F = force.at(t, j * w);
            if constexpr (checks_force) sum[j] = sum[j] + F;
            Current<Batch<V>> i[R::outputs];
            r[j]->step(s[j], F, i);
            for (int k = 0; k < R::outputs; ++k) {
                if (!continuous<R> || t == 0) i[k].from.store_aligned(from + k * current_rows<V> * tile_units + j * w);
                i[k].to.store_aligned(to + k * current_rows<V> * tile_units + j * w);
            }
        });
    }
    prefetch = local;
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        write(s[j], c.state, first + j * w);
        const auto zero_or_nan = sum[j] - sum[j];  // 0, or NaN
        if constexpr (checks_force) c.strange = c.strange || !num::all(zero_or_nan == Batch<V>(V(0)));
    });
}

template <class V, class R>
void transduce_tile(TransductionCall<V>& c) {
    constexpr int J = 2;
    Asking local(c.ahead, rounds<V, J>(c));
    for (int first = 0; first < c.units; first += J * width<V>) {
        if (c.feed == Feed::rows) transduce<V, R, Feed::rows, J>(c, first, local);
        if (c.feed == Feed::words) transduce<V, R, Feed::words, J>(c, first, local);
        if (c.feed == Feed::profile) transduce<V, R, Feed::profile, J>(c, first, local);
    }
}

}  // namespace
}  // namespace corpuscle::lanes
