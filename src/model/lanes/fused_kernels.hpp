#pragma once
// Receptor and neuron fused into one loop: force in, spikes out, without storing the current in between. Included only by kernel.cpp.

#include "model/lanes/neuron_kernels.hpp"
#include "model/lanes/receptor_kernels.hpp"

namespace corpuscle::lanes {
namespace {

/// True if receptor R and neuron N can be fused. The receptor must have one current, which is continuous from step to step and which
/// R::current() computes from the other state values. The neuron must have a quick test for steps without events.
template <class R, class N>
inline constexpr bool can_fuse = continuous<R> && R::outputs == 1 && requires(const R& r, const typename R::State& s, const N& n) {
    R::propagates_nan;
    r.current(s);
    n.may_be_refractory();
    N::refractory_values;
};

/// Number of state values of an afferent that a fused loop loads and stores. The receptor's last current, its last state value, is
/// recomputed, and the neuron's refractory time is always 0 (see none_refractory()), so neither is stored. This saves memory traffic, which
/// limits the speed of a single step.
template <class V, class R>
inline constexpr std::size_t stored_receptor_values = value_count<typename R::State, V> - 1;
template <class V, class N>
inline constexpr std::size_t stored_neuron_values = value_count<typename N::State, V> - N::refractory_values;

/// Simulates J vectors of a tile over a chunk, from afferent `first` of the tile on. `once`: the chunk is a single step.
template <class V, class R, class N, ForceInput feed, Method method, int J, bool once>
[[gnu::always_inline]] inline void fused_loop(const ReceptorCall<V>& c, const NeuronCall<V>& to, int first, Prefetcher& prefetch) {
    constexpr int w = width<V>;
    using T = Batch<V>;
    using ReceptorState = typename R::State;
    using NeuronState = typename N::State;
    static_assert(offsetof(ReceptorState, I) == sizeof(ReceptorState) - sizeof(T));
    const R* r[J];
    const N* n[J];
    ReceptorState receptor[J];
    NeuronState s[J];
    FiringRecorder<V> fired[J];
    unrolled<J>([&](auto j) __attribute__((always_inline)) {
        r[j] = &model<R>(c.models, c.stride, first / w + j);
        n[j] = &model<N>(to.models, to.stride, first / w + j);
        receptor[j] = read<ReceptorState, V, stored_receptor_values<V, R>>(c.state, first + j * w);
        receptor[j].I = r[j]->current(receptor[j]);
        s[j] = read<NeuronState, V, stored_neuron_values<V, N>>(to.state, first + j * w);
        fired[j] = {to.fired, first + j * w};
    });
    const ForceReader<feed, V> force(c, first);
    FiringList<V>& list = *to.fired;
    Prefetcher local = prefetch;
    for (int t = 0, steps = once ? 1 : c.steps; t < steps; ++t) {
        list.step = t;
        if constexpr (feed != ForceInput::profile && !once) local.prefetch_next();
        Current<T> i[J];
        unrolled<J>([&](auto j) __attribute__((always_inline)) {
            const T before = receptor[j].I;
            Current<T> current[1];
            r[j]->step(receptor[j], force.at(t, j * w), current);
            i[j] = {method == Method::exact ? before : current[0].to, current[0].to};
        });
        step_all<false, J>(n, s, fired, StoredCurrents<T, J>{i});
    }
    prefetch = local;
    unrolled<J>([&](auto j) __attribute__((always_inline)) {
        write<ReceptorState, V, stored_receptor_values<V, R>>(receptor[j], c.state, first + j * w);
        write<NeuronState, V, stored_neuron_values<V, N>>(s[j], to.state, first + j * w);
    });
}

/// The loop over several steps, compiled once and not inlined.
template <class V, class R, class N, ForceInput feed, Method method, int J>
[[gnu::noinline]] void fused_loop_call(const ReceptorCall<V>& c, const NeuronCall<V>& to, int first, Prefetcher& prefetch) {
    fused_loop<V, R, N, feed, method, J, false>(c, to, first, prefetch);
}

template <class V, class R, class N, ForceInput feed, Method method, bool once = false>
void fused_tile(const ReceptorCall<V>& c, const NeuronCall<V>& to) {
    constexpr int J = 2;
    Prefetcher local(c.prefetch, iteration_count<V, J>(c));
    for (int first = 0; first < c.afferents; first += J * width<V>) {
        if constexpr (once)
            fused_loop<V, R, N, feed, method, J, true>(c, to, first, local);
        else
            fused_loop_call<V, R, N, feed, method, J>(c, to, first, local);
    }
}
template <class V, class R, class N, ForceInput feed>
void fused_tile(const ReceptorCall<V>& c, const NeuronCall<V>& to) {
    c.method == Method::exact ? fused_tile<V, R, N, feed, Method::exact>(c, to) : fused_tile<V, R, N, feed, Method::backward_euler>(c, to);
}
/// A live skin simulates single steps with ForceInput::rows. These have their own loop, because the start and the end of the general loop
/// would cost as much as the step.
template <class V, class R, class N>
void fused_tile(const ReceptorCall<V>& c, const NeuronCall<V>& to) {
    if (c.input == ForceInput::rows && c.steps == 1 && c.method == Method::exact)
        return fused_tile<V, R, N, ForceInput::rows, Method::exact, true>(c, to);
    if (c.input == ForceInput::rows) fused_tile<V, R, N, ForceInput::rows>(c, to);
    if (c.input == ForceInput::int16) fused_tile<V, R, N, ForceInput::int16>(c, to);
    if (c.input == ForceInput::profile) fused_tile<V, R, N, ForceInput::profile>(c, to);
}

/// True if t_ref is 0 in all `count` neuron models.
template <class N>
bool none_refractory(const std::byte* neurons, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        if (model<N>(neurons, sizeof(N), static_cast<int>(k)).may_be_refractory()) return false;
    return true;
}

}  // namespace
}  // namespace corpuscle::lanes
