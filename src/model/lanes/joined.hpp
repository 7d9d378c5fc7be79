#pragma once
// Receptor and neuron fused into one loop: force in, spikes out, without storing the current in between. Included only by kernel.cpp.

#include "model/lanes/firing.hpp"
#include "model/lanes/transducing.hpp"

namespace corpuscle::lanes {
namespace {

/// Pairs that can be fused. The receptor has one current that is continuous across steps and computed from the rest of its state. The
/// neuron has a quick test for steps without events.
template <class R, class N>
inline constexpr bool joins = continuous<R> && R::outputs == 1 && requires(const R& r, const typename R::State& s, const N& n) {
    R::keeps_strays;
    r.current(s);
    n.may_wait();
    N::values_of_waiting;
};

/// The state values that are stored: the last current is recomputed, and no afferent is refractory. A single step is limited by memory
/// traffic.
template <class V, class R>
inline constexpr std::size_t felt_values = values_of<typename R::State, V> - 1;
template <class V, class N>
inline constexpr std::size_t own_values = values_of<typename N::State, V> - N::values_of_waiting;

/// J vectors of a tile at once, from `first` on. `once`: a single step.
template <class V, class R, class N, Feed feed, Method method, int J, bool once>
[[gnu::always_inline]] inline void feel(const TransductionCall<V>& c, const NeuronCall<V>& to, int first, Asking& prefetch) {
    constexpr int w = width<V>;
    using T = Batch<V>;
    using Felt = typename R::State;
    using Own = typename N::State;
    static_assert(offsetof(Felt, I) == sizeof(Felt) - sizeof(T));
    const R* r[J];
    const N* n[J];
    Felt receptor[J];
    Own s[J];
    Fired<V> fired[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        r[j] = &model<R>(c.models, c.stride, first / w + j);
        n[j] = &model<N>(to.models, to.stride, first / w + j);
        receptor[j] = read<Felt, V, felt_values<V, R>>(c.state, first + j * w);
        receptor[j].I = r[j]->current(receptor[j]);
        s[j] = read<Own, V, own_values<V, N>>(to.state, first + j * w);
        fired[j] = {to.fired, first + j * w};
    });
    const Force<feed, V> force(c, first);
    FiringList<V>& list = *to.fired;
    Asking local = prefetch;
    for (int t = 0, steps = once ? 1 : c.steps; t < steps; ++t) {
        list.step = t;
        if constexpr (feed != Feed::profile && !once) local.some();
        Current<T> i[J];
        each_of<J>([&](auto j) __attribute__((always_inline)) {
            const T before = receptor[j].I;
            Current<T> own[1];
            r[j]->step(receptor[j], force.at(t, j * w), own);
            i[j] = {method == Method::exact ? before : own[0].to, own[0].to};
        });
        step_all<false, J>(n, s, fired, AtHand<T, J>{i});
    }
    prefetch = local;
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        write<Felt, V, felt_values<V, R>>(receptor[j], c.state, first + j * w);
        write<Own, V, own_values<V, N>>(s[j], to.state, first + j * w);
    });
}

template <class V, class R, class N, Feed feed, Method method, int J>
[[gnu::noinline]] void feel_steps(const TransductionCall<V>& c, const NeuronCall<V>& to, int first, Asking& prefetch) {
    feel<V, R, N, feed, method, J, false>(c, to, first, prefetch);
}

template <class V, class R, class N, Feed feed, Method method, bool once = false>
void feel_tile(const TransductionCall<V>& c, const NeuronCall<V>& to) {
    constexpr int J = 2;
    Asking local(c.ahead, rounds<V, J>(c));
    for (int first = 0; first < c.units; first += J * width<V>) {
        if constexpr (once)
            feel<V, R, N, feed, method, J, true>(c, to, first, local);
        else
            feel_steps<V, R, N, feed, method, J>(c, to, first, local);
    }
}
template <class V, class R, class N, Feed feed>
void feel_tile(const TransductionCall<V>& c, const NeuronCall<V>& to) {
    c.method == Method::exact ? feel_tile<V, R, N, feed, Method::exact>(c, to) : feel_tile<V, R, N, feed, Method::backward_euler>(c, to);
}
/// A single step of rows, as a live skin takes, has its own loop, because setup and teardown cost as much as the step.
template <class V, class R, class N>
void feel_tile(const TransductionCall<V>& c, const NeuronCall<V>& to) {
    if (c.feed == Feed::rows && c.steps == 1 && c.method == Method::exact)
        return feel_tile<V, R, N, Feed::rows, Method::exact, true>(c, to);
    if (c.feed == Feed::rows) feel_tile<V, R, N, Feed::rows>(c, to);
    if (c.feed == Feed::words) feel_tile<V, R, N, Feed::words>(c, to);
    if (c.feed == Feed::profile) feel_tile<V, R, N, Feed::profile>(c, to);
}

template <class V, class R>
void settle_felt(const TransductionCall<V>& c) {
    settle<V, R, TransductionCall<V>, felt_values<V, R>>(c);
}

template <class N>
bool none_waits(const std::byte* neurons, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        if (model<N>(neurons, sizeof(N), static_cast<int>(k)).may_wait()) return false;
    return true;
}

}  // namespace
}  // namespace corpuscle::lanes
