#pragma once
// Currents into spikes: the neurons of a tile over a chunk. Included by kernel.cpp alone.

#include "model/lanes/vectors.hpp"

namespace corpuscle::lanes {
namespace {

/// What the neurons of one vector, from `unit` of the tile on, call when they fire; rarely.
template <class V>
struct Fired {
    FiringList<V>* list;
    int unit;

    std::uint64_t valid(num::Mask<Batch<V>> who) const { return num::bits(who) & (list->valid >> unit); }
    [[gnu::noinline, gnu::cold]] void operator()(num::Mask<Batch<V>> who, Batch<V> offset) const {
        const auto bits = valid(who);
        if (bits == 0) return;
        if (list->count == record_room) list->full(*list);
        if (list->offsets) offset.store_aligned(list->offsets + list->count * width<V>);
        list->firings[list->count++] = {list->step, unit, bits};
    }
    [[gnu::noinline, gnu::cold]] void capped(num::Mask<Batch<V>> who) const { list->capped += __builtin_popcountll(valid(who)); }
};

template <class V, class N>
void start(const NeuronCall<V>& c) {
    for (int unit = 0; unit < tile_units; unit += width<V>) write(model<N>(c.models, c.stride, unit / width<V>).start(), c.state, unit);
}

/// One step of a vector under its current, whatever happens in it.
template <class N, class S, class I, class F>
[[gnu::always_inline]] inline void step_one(const N& n, S& s, const I& i, const F& fired) {
    const auto capped = n.step(s, i, fired);
    if (num::any(capped)) fired.capped(capped);
}

/// What flows into vector j, worked out where it is asked for, and so again.
template <class F>
struct Flow : F {
    [[gnu::always_inline]] const Flow& again() const { return *this; }
};
/// The same of currents at hand. Only a copy is looked into by number: they can stay in registers.
template <class T, int J>
struct AtHand {
    const Current<T> (&i)[J];
    struct Copy {
        Current<T> i[J];
        const Current<T>& operator()(int j) const { return i[j]; }
    };
    [[gnu::always_inline]] const Current<T>& operator()(int j) const { return i[j]; }
    [[gnu::always_inline]] Copy again() const {
        Copy copy;
        each_of<J>([&](auto j) __attribute__((always_inline)) { copy.i[j] = i[j]; });
        return copy;
    }
};

/// One step of J vectors; current(j) is what flows into vector j. Where a neuron can tell at a glance that nothing happens, all are
/// asked first, and those where something may are looked into one after another.
template <bool waits, int J, class N, class S, class F, class I>
[[gnu::always_inline]] inline void step_all(const N* const (&n)[J], S (&s)[J], const F (&fired)[J], const I& current) {
    if constexpr (requires(S next) { n[0]->template glance<waits>(s[0], current(0), next); }) {
        S next[J];
        decltype(n[0]->template glance<waits>(s[0], current(0), next[0])) something[J];
        each_of<J>([&](auto j) __attribute__((always_inline)) { something[j] = n[j]->template glance<waits>(s[j], current(j), next[j]); });
        if (num::any_of(something)) [[unlikely]] {
            S before[J], after[J];
            const auto again = current.again();
            unsigned where = 0;
            each_of<J>([&](auto j) __attribute__((always_inline)) {
                before[j] = s[j], after[j] = next[j];
                where |= static_cast<unsigned>(num::any(something[j])) << j;
            });
            for (; where != 0; where &= where - 1) {
                const int k = __builtin_ctz(where);
                S one = before[k];
                step_one(*n[k], one, again(k), fired[k]);
                after[k] = one;
            }
            each_of<J>([&](auto j) __attribute__((always_inline)) { next[j] = after[j]; });
        }
        each_of<J>([&](auto j) __attribute__((always_inline)) { s[j] = next[j]; });
    } else {
        each_of<J>([&](auto j) __attribute__((always_inline)) { step_one(*n[j], s[j], current(j), fired[j]); });
    }
}

template <class V, class N, bool scaled, bool waits, bool shared, int J>
void fire(const NeuronCall<V>& c, int unit, Asking& asked) {
    constexpr int w = width<V>;
    using T = Batch<V>;
    const N* n[J];
    typename N::State s[J];
    Fired<V> fired[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        n[j] = shared ? &model<N>(c.models, 0, 0) : &model<N>(c.models, c.stride, unit / w + j);
        s[j] = read<typename N::State>(c.state, unit + j * w);
        fired[j] = {c.fired, unit + j * w};
    });
    const V *from = c.from + (scaled ? 0 : unit), *to = c.to + (scaled ? 0 : unit), *gain = scaled ? c.gain + unit : nullptr;
    FiringList<V>& list = *c.fired;
    Asking asking = asked;
    const V* const both_ends = c.both;  // of a scaled current
    for (int t = 0, steps = c.steps; t < steps; ++t) {
        list.step = t;
        if constexpr (!scaled) asking.some();
        if constexpr (scaled) {
            const T both(both_ends[t]);
            const auto current = [&]<bool rising>(std::bool_constant<rising>) __attribute__((always_inline)) {
                return Flow{[&](int j)
                                __attribute__((always_inline)) { return Scaled<T, V, rising>{load(gain + j * w), both, from[t], to[t]}; }};
            };
            if (to[t] > from[t])
                step_all<waits, J>(n, s, fired, current(std::true_type{}));
            else
                step_all<waits, J>(n, s, fired, current(std::false_type{}));
        } else {
            step_all<waits, J>(n, s, fired, Flow{[&](int j) __attribute__((always_inline)) {
                                   return Current<T>{load(from + t * tile_units + j * w), load(to + t * tile_units + j * w)};
                               }});
        }
    }
    asked = asking;
    each_of<J>([&](auto j) __attribute__((always_inline)) { write(s[j], c.state, unit + j * w); });
}

/// Whether one of J models of a tile, from `unit` on, may be in a refractory time.
template <class V, class N, int J>
bool any_waits(const NeuronCall<V>& c, int unit) {
    bool any = false;
    for (int j = 0; j < J; ++j) any |= model<N>(c.models, c.stride, unit / width<V> + j).may_wait();
    return any;
}

template <class V, class N>
void fire_tile(const NeuronCall<V>& c) {
    constexpr int J = 4;
    Asking asking(c.ahead, rounds<V, J>(c));
    for (int unit = 0; unit < c.units; unit += J * width<V>) {
        if constexpr (requires(const N& n) { n.may_wait(); })
            if (!any_waits<V, N, J>(c, unit)) {
                if (c.gain)
                    c.stride == 0 ? fire<V, N, true, false, true, J>(c, unit, asking) : fire<V, N, true, false, false, J>(c, unit, asking);
                else
                    fire<V, N, false, false, false, J>(c, unit, asking);
                continue;
            }
        c.gain ? fire<V, N, true, true, false, J>(c, unit, asking) : fire<V, N, false, true, false, J>(c, unit, asking);
    }
}

}  // namespace
}  // namespace corpuscle::lanes
