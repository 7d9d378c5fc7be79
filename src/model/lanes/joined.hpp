#pragma once
// Force into spikes in one loop, for pairs whose current need not rest in memory between the two. Included by kernel.cpp alone.

#include "model/lanes/firing.hpp"
#include "model/lanes/transducing.hpp"

namespace corpuscle::lanes {
namespace {

/// Pairs that go in one loop: one current, which begins where it ended, and a neuron that can tell at a glance that nothing happens.
template <class R, class N>
inline constexpr bool joins = continuous<R> && R::outputs == 1 && requires { R::keeps_strays; } && requires(const N& n) { n.may_wait(); };

/// J vectors of a tile at once, from `unit` on.
template <class V, class R, class N, Feed feed, Method method, int J>
void feel(const TransductionCall<V>& c, const NeuronCall<V>& to, int unit, Asking& asked) {
    constexpr int w = width<V>;
    using T = Batch<V>;
    const R* r[J];
    const N* n[J];
    typename R::State felt[J];
    typename N::State s[J];
    Fired<V> fired[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        r[j] = &model<R>(c.models, c.stride, unit / w + j);
        n[j] = &model<N>(to.models, to.stride, unit / w + j);
        felt[j] = read<typename R::State>(c.state, unit + j * w);
        s[j] = read<typename N::State>(to.state, unit + j * w);
        fired[j] = {to.fired, unit + j * w};
    });
    const Force<feed, V> force(c, unit);
    FiringList<V>& list = *to.fired;
    Asking asking = asked;
    for (int t = 0, steps = c.steps; t < steps; ++t) {
        list.step = t;
        if constexpr (feed != Feed::profile) asking.some();
        Current<T> i[J];
        each_of<J>([&](auto j) __attribute__((always_inline)) {
            const T before = felt[j].I;
            Current<T> own[1];
            r[j]->step(felt[j], force.at(t, j * w), own);
            i[j] = {method == Method::exact ? before : own[0].to, own[0].to};
        });
        step_all<false, J>(n, s, fired, AtHand<T, J>{i});
    }
    asked = asking;
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        write(felt[j], c.state, unit + j * w);
        write(s[j], to.state, unit + j * w);
    });
}

template <class V, class R, class N, Feed feed>
void feel_tile(const TransductionCall<V>& c, const NeuronCall<V>& to) {
    constexpr int J = 2;
    Asking asking(c.ahead, rounds<V, J>(c));
    for (int unit = 0; unit < c.units; unit += J * width<V>)
        c.method == Method::exact ? feel<V, R, N, feed, Method::exact, J>(c, to, unit, asking)
                                  : feel<V, R, N, feed, Method::backward_euler, J>(c, to, unit, asking);
}
template <class V, class R, class N>
void feel_tile(const TransductionCall<V>& c, const NeuronCall<V>& to) {
    if (c.feed == Feed::rows) feel_tile<V, R, N, Feed::rows>(c, to);
    if (c.feed == Feed::words) feel_tile<V, R, N, Feed::words>(c, to);
    if (c.feed == Feed::profile) feel_tile<V, R, N, Feed::profile>(c, to);
}

template <class N>
bool none_waits(const std::byte* neurons, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        if (model<N>(neurons, sizeof(N), static_cast<int>(k)).may_wait()) return false;
    return true;
}

}  // namespace
}  // namespace corpuscle::lanes
