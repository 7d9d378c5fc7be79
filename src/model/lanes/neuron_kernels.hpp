#pragma once
// Neurons of a tile over a chunk: currents in, spikes out. Included only by kernel.cpp.

#include "model/lanes/tile_vectors.hpp"

namespace corpuscle::lanes {
namespace {

/// Records the spikes of one vector in the list. It is called only if a neuron fires, which is rare. The vector begins at afferent `first`
/// of the tile.
template <class V>
struct FiringRecorder {
    FiringList<V>* list;
    int first;

    /// The mask without the lanes that are padding.
    std::uint64_t valid(num::Mask<Batch<V>> mask) const { return num::mask_bits(mask) & (list->valid >> first); }
    /// Records one spike of each lane of the mask, with its offset within the step.
    [[gnu::noinline, gnu::cold]] void operator()(num::Mask<Batch<V>> mask, Batch<V> offset) const {
        const auto bits = valid(mask);
        if (bits == 0) return;
        if (list->count == firing_list_capacity) list->on_full(*list);
        if (list->offsets) offset.store_aligned(list->offsets + list->count * width<V>);
        list->firings[list->count++] = {list->step, first, bits};
    }
    /// Counts the lanes of the mask, whose step reached the limit of spikes.
    [[gnu::noinline, gnu::cold]] void truncated(num::Mask<Batch<V>> mask) const {
        list->truncated_steps += __builtin_popcountll(valid(mask));
    }
};

/// Sets the states of all neurons of a tile before the first step.
template <class V, class N>
void start_states(const NeuronCall<V>& c) {
    for (int first = 0; first < tile_size; first += width<V>) {
        const auto& n = model<N>(c.models, c.stride, first / width<V>);
        if constexpr (requires { n.start(load(c.streams)); })
            write(n.start(load(c.streams + first)), c.state, first);
        else
            write(n.start(), c.state, first);
    }
}

/// One step of a vector under its current, with all events.
template <class N, class S, class I, class F>
[[gnu::always_inline]] inline void step_one(const N& n, S& s, const I& i, const F& fired) {
    const auto truncated = n.step(s, i, fired);
    if (num::any(truncated)) fired.truncated(truncated);
}

/// The current into vector j: F is a function that computes it at each access.
template <class F>
struct ComputedCurrents : F {
    [[gnu::always_inline]] const ComputedCurrents& copy() const { return *this; }
};
template <class F>
ComputedCurrents(F) -> ComputedCurrents<F>;  // clang 14 needs it
/// The current into vector j, from an array. Only a copy() is indexed with a j that is known at run time only, so the array itself can stay
/// in registers.
template <class T, int J>
struct StoredCurrents {
    const Current<T> (&i)[J];
    struct Copy {
        Current<T> i[J];
        const Current<T>& operator()(int j) const { return i[j]; }
    };
    [[gnu::always_inline]] const Current<T>& operator()(int j) const { return i[j]; }
    [[gnu::always_inline]] Copy copy() const {
        Copy copy;
        unrolled<J>([&](auto j) __attribute__((always_inline)) { copy.i[j] = i[j]; });
        return copy;
    }
};

/// One step of J vectors; current(j) is the current into vector j. If the neuron has a quick test for steps without events, all vectors are
/// tested first. Those in which an event is possible are then simulated with all events, one after another. `check_refractory`: see
/// try_quiet_step() of the neuron.
template <bool check_refractory, int J, class N, class S, class F, class I>
[[gnu::always_inline]] inline void step_all(const N* const (&n)[J], S (&s)[J], const F (&fired)[J], const I& current) {
    if constexpr (requires(S next) { n[0]->template try_quiet_step<check_refractory>(s[0], current(0), next); }) {
        S next[J];
        decltype(n[0]->template try_quiet_step<check_refractory>(s[0], current(0), next[0])) events[J];
        unrolled<J>([&](auto j) __attribute__((always_inline)) {
            events[j] = n[j]->template try_quiet_step<check_refractory>(s[j], current(j), next[j]);
        });
        if (num::any_of(events)) [[unlikely]] {
            S before[J], after[J];
            const auto copied_current = current.copy();
            unsigned vectors = 0;  // one bit for each vector with an event
            unrolled<J>([&](auto j) __attribute__((always_inline)) {
                before[j] = s[j], after[j] = next[j];
                vectors |= static_cast<unsigned>(num::any(events[j])) << j;
            });
            for (; vectors != 0; vectors &= vectors - 1) {
                const int k = __builtin_ctz(vectors);
                S state = before[k];
                step_one(*n[k], state, copied_current(k), fired[k]);
                after[k] = state;
            }
            unrolled<J>([&](auto j) __attribute__((always_inline)) { next[j] = after[j]; });
        }
        unrolled<J>([&](auto j) __attribute__((always_inline)) { s[j] = next[j]; });
    } else {
        unrolled<J>([&](auto j) __attribute__((always_inline)) { step_one(*n[j], s[j], current(j), fired[j]); });
    }
}

/// Simulates J vectors of a tile over a chunk, from afferent `first` of the tile on. `scaled`: all afferents have the same current times
/// their gain; `shared`: all vectors have the same model.
template <class V, class N, bool scaled, bool check_refractory, bool shared, int J>
void run_neurons(const NeuronCall<V>& c, int first, Prefetcher& prefetch) {
    constexpr int w = width<V>;
    using T = Batch<V>;
    const N* n[J];
    typename N::State s[J];
    FiringRecorder<V> fired[J];
    unrolled<J>([&](auto j) __attribute__((always_inline)) {
        n[j] = shared ? &model<N>(c.models, 0, 0) : &model<N>(c.models, c.stride, first / w + j);
        s[j] = read<typename N::State>(c.state, first + j * w);
        fired[j] = {c.fired, first + j * w};
    });
    const V *from = c.from + (scaled ? 0 : first), *to = c.to + (scaled ? 0 : first), *gain = scaled ? c.gain + first : nullptr;
    FiringList<V>& list = *c.fired;
    Prefetcher local = prefetch;
    const V* const end_sum = c.end_sum;
    for (int t = 0, steps = c.steps; t < steps; ++t) {
        list.step = t;
        if constexpr (!scaled) local.prefetch_next();
        if constexpr (scaled) {
            const T sum(end_sum[t]);
            const auto current = [&]<bool rising>(std::bool_constant<rising>) __attribute__((always_inline)) {
                return ComputedCurrents{[&](int j) __attribute__((always_inline)) {
                    return ScaledCurrent<T, V, rising>{load(gain + j * w), sum, from[t], to[t]};
                }};
            };
            if (to[t] > from[t])
                step_all<check_refractory, J>(n, s, fired, current(std::true_type{}));
            else
                step_all<check_refractory, J>(n, s, fired, current(std::false_type{}));
        } else {
            step_all<check_refractory, J>(n, s, fired, ComputedCurrents{[&](int j) __attribute__((always_inline)) {
                                              return Current<T>{load(from + t * tile_size + j * w), load(to + t * tile_size + j * w)};
                                          }});
        }
    }
    prefetch = local;
    unrolled<J>([&](auto j) __attribute__((always_inline)) { write(s[j], c.state, first + j * w); });
}

/// One step of a vector with all events, for run_quiet_neurons(). The state is in the tile.
template <class V, class N>
[[gnu::noinline]] void step_in_tile(const NeuronCall<V>& c, const N& n, int first, int step) {
    auto state = read<typename N::State>(c.state, first);
    c.fired->step = step;
    const auto at = step * tile_size + first;
    step_one(n, state, Current<Batch<V>>{load(c.from + at), load(c.to + at)}, FiringRecorder<V>{c.fired, first});
    write(state, c.state, first);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-braces"  // a state is initialised value by value, and may contain structures

/// As run_neurons() for neurons that have currents of their own and quiet_values: values of the state that come first in it, and are the
/// only ones that change in a step without events. Only these are kept in registers; the others are read from the tile in each step.
template <class V, class N, bool check_refractory, int J>
void run_quiet_neurons(const NeuronCall<V>& c, int first, Prefetcher& prefetch) {
    constexpr int w = width<V>, changing = sizeof N::quiet_values / sizeof N::quiet_values[0];
    using T = Batch<V>;
    using S = typename N::State;
    const N* n[J];
    T value[J][changing];
    const auto in_tile = [&](int j, int k) { return c.state + k * tile_size + first + j * w; };
    unrolled<J>([&](auto j) __attribute__((always_inline)) {
        n[j] = &model<N>(c.models, c.stride, first / w + j);
        unrolled<changing>([&](auto k) __attribute__((always_inline)) { value[j][k] = load(in_tile(j, k)); });
    });
    const V *from = c.from + first, *to = c.to + first;
    Prefetcher local = prefetch;
    for (int t = 0, steps = c.steps; t < steps; ++t, from += tile_size, to += tile_size) {
        local.prefetch_next();
        T next[J][changing];
        num::Mask<T> events[J];
        unrolled<J>([&](auto j) __attribute__((always_inline)) {
            const auto state = [&]<int... k>(std::integer_sequence<int, k...>) __attribute__((always_inline)) {
                return S{(k < changing ? value[j][k < changing ? k : 0] : load(in_tile(j, k)))...};
            }(std::make_integer_sequence<int, static_cast<int>(value_count<S, V>)>{});
            S after;
            events[j] = n[j]->template try_quiet_step<check_refractory>(state, Current<T>{load(from + j * w), load(to + j * w)}, after);
            unrolled<changing>([&](auto k) __attribute__((always_inline)) { next[j][k] = after.*N::quiet_values[k]; });
        });
        if (num::any_of(events)) [[unlikely]] {
            unrolled<J>([&](auto j) __attribute__((always_inline)) {
                if (!num::any(events[j])) return;
                unrolled<changing>([&](auto k) __attribute__((always_inline)) { value[j][k].store_aligned(in_tile(j, k)); });
                step_in_tile<V, N>(c, *n[j], first + j * w, t);
                unrolled<changing>([&](auto k) __attribute__((always_inline)) { next[j][k] = load(in_tile(j, k)); });
            });
        }
        unrolled<J>([&](auto j) __attribute__((always_inline)) {
            unrolled<changing>([&](auto k) __attribute__((always_inline)) { value[j][k] = next[j][k]; });
        });
    }
    prefetch = local;
    unrolled<J>([&](auto j) __attribute__((always_inline)) {
        unrolled<changing>([&](auto k) __attribute__((always_inline)) { value[j][k].store_aligned(in_tile(j, k)); });
    });
}

#pragma GCC diagnostic pop

/// True if a neuron in one of J vectors of a tile, from afferent `first` on, may be refractory.
template <class V, class N, int J>
bool any_refractory(const NeuronCall<V>& c, int first) {
    bool any = false;
    for (int j = 0; j < J; ++j) any |= model<N>(c.models, c.stride, first / width<V> + j).may_be_refractory();
    return any;
}

template <class V, class N>
void run_neuron_tile(const NeuronCall<V>& c) {
    constexpr int J = 4;
    Prefetcher local(c.prefetch, iteration_count<V, J>(c));
    for (int first = 0; first < c.afferents; first += J * width<V>) {
        if constexpr (requires { N::quiet_values; })
            if (!c.gain) {
                any_refractory<V, N, J>(c, first) ? run_quiet_neurons<V, N, true, J>(c, first, local)
                                                  : run_quiet_neurons<V, N, false, J>(c, first, local);
                continue;
            }
        if constexpr (requires(const N& n) { n.may_be_refractory(); })
            if (!any_refractory<V, N, J>(c, first)) {
                if (c.gain)
                    c.stride == 0 ? run_neurons<V, N, true, false, true, J>(c, first, local)
                                  : run_neurons<V, N, true, false, false, J>(c, first, local);
                else
                    run_neurons<V, N, false, false, false, J>(c, first, local);
                continue;
            }
        c.gain ? run_neurons<V, N, true, true, false, J>(c, first, local) : run_neurons<V, N, false, true, false, J>(c, first, local);
    }
}

}  // namespace
}  // namespace corpuscle::lanes
