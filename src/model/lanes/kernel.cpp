// The models on SIMD lanes. Compiled once for each instruction set, CORPUSCLE_ISA; what is made here must not leave this file
// but for two tables: no standard container, no double model, nothing that another file could take for its own.

#include "model/lanes/kernel.hpp"

#include <array>
#include <new>
#include <type_traits>
#include <utility>

#include "model/models.hpp"

namespace corpuscle::lanes {
namespace {

template <class V>
using Batch = num::Lanes<V>;
template <class V>
inline constexpr int width = static_cast<int>(Batch<V>::size);

/// f(0), f(1) ... f(J - 1), each with its number as a constant: unrolled, so that arrays of states are registers.
template <int J, class F>
[[gnu::always_inline]] inline void each_of(F&& f) {
    [&]<int... j>(std::integer_sequence<int, j...>) __attribute__((always_inline)) { (f(std::integral_constant<int, j>{}), ...); }
    (std::make_integer_sequence<int, J>{});
}

template <class V>
Batch<V> load(const V* at) {
    return Batch<V>::load_aligned(at);
}

/// Hands a model the values of its parameters: of one unit for all lanes, or of as many units as there are lanes.
template <class V, class P>
struct PerLane {
    const P* params;
    int count;  ///< 1: one for all; the last stands in for lanes beyond
    Batch<V> operator()(double P::* at) const {
        alignas(64) V lanes[width<V>];
        for (int l = 0; l < width<V>; ++l) lanes[l] = static_cast<V>(params[l < count ? l : count - 1].*at);
        return load(lanes);
    }
    double one(double P::* at) const { return params[0].*at; }
};

template <class V, class M>
void build(std::byte* at, const void* params, int count, double dt, Method method) {
    using P = typename M::Params;
    const auto* all = static_cast<const P*>(params);
    for (int l = 0; l < (count == 1 ? 1 : tile_units); l += width<V>, at += sizeof(M)) {
        const int from = l < count ? l : count - 1;
        new (at) M(PerLane<V, P>{all + from, count - from}, dt, method);
    }
}

template <class M>
const M& model(const std::byte* models, std::size_t stride, int vector) {
    return *reinterpret_cast<const M*>(models + stride * static_cast<std::size_t>(vector));
}

/// A state among those of its tile, value by value. Through a copy: what a loop works on has no address, so it can be registers.
template <class S, class V>
[[gnu::always_inline]] inline S read(const V* state, int unit) {
    S s;
    auto* values = reinterpret_cast<Batch<V>*>(&s);
    for (std::size_t k = 0; k < sizeof(S) / sizeof(Batch<V>); ++k) values[k] = load(state + k * tile_units + unit);
    return s;
}
template <class S, class V>
[[gnu::always_inline]] inline void write(const S& own, V* state, int unit) {
    const S s = own;
    const auto* values = reinterpret_cast<const Batch<V>*>(&s);
    for (std::size_t k = 0; k < sizeof(S) / sizeof(Batch<V>); ++k) values[k].store_aligned(state + k * tile_units + unit);
}

/// The force that a vector of units feels in a step.
template <Feed feed, class V>
[[gnu::always_inline]] inline Batch<V> force(const TransductionCall<V>& c, int step, int unit) {
    if constexpr (feed == Feed::profile)
        return Batch<V>(c.profile[step]) * load(c.gain + unit);
    else if constexpr (feed == Feed::words)
        return num::of_words<V>(c.words + step * tile_units + unit) * Batch<V>(c.scale);
    else
        return load(c.rows + step * tile_units + unit);
}

// ---- transductions ----

template <class V, class R>
void start(const TransductionCall<V>& c) {
    for (int unit = 0; unit < tile_units; unit += width<V>) {
        const auto& r = model<R>(c.models, c.stride, unit / width<V>);
        const auto at = [&](Feed f) {
            return f == Feed::profile ? force<Feed::profile>(c, 0, unit) : f == Feed::words ? force<Feed::words>(c, 0, unit) : force<Feed::rows>(c, 0, unit);
        };
        write(r.start(at(c.feed)), c.state, unit);
    }
}

/// Rows of force that are asked for ahead of their use.
inline constexpr int rows_ahead = 32;

/// J vectors of a tile at once, from `unit` on.
template <class V, class R, Feed feed, int J>
void transduce(TransductionCall<V>& c, int unit) {
    constexpr int w = width<V>;
    const R* r[J];
    typename R::State s[J];
    Batch<V> sum[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        r[j] = &model<R>(c.models, c.stride, unit / w + j);
        s[j] = read<typename R::State>(c.state, unit + j * w);
        sum[j] = Batch<V>(V(0));
    });
    V *from = c.from + unit, *to = c.to + unit;
    for (int t = 0; t < c.steps; ++t, from += tile_units, to += tile_units)
        each_of<J>([&](auto j) __attribute__((always_inline)) {
            const auto F = force<feed>(c, t, unit + j * w);
            if constexpr (feed == Feed::rows)
                if (j * w * sizeof(V) % 64 == 0) __builtin_prefetch(c.rows + (t + rows_ahead) * tile_units + unit + j * w);
            if constexpr (feed != Feed::profile) sum[j] = sum[j] + F;
            Current<Batch<V>> i[R::outputs];
            r[j]->step(s[j], F, i);
            for (int k = 0; k < R::outputs; ++k) {
                i[k].from.store_aligned(from + k * chunk_steps<V> * tile_units + j * w);
                i[k].to.store_aligned(to + k * chunk_steps<V> * tile_units + j * w);
            }
        });
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        write(s[j], c.state, unit + j * w);
        c.sum += sum[j].get(0);
        for (int l = 1; l < w; ++l) c.sum += sum[j].get(static_cast<std::size_t>(l));
    });
}

template <class V, class R>
void transduce_tile(TransductionCall<V>& c) {
    constexpr int J = 2;
    for (int unit = 0; unit < c.units; unit += J * width<V>) {
        if (c.feed == Feed::rows) transduce<V, R, Feed::rows, J>(c, unit);
        if (c.feed == Feed::words) transduce<V, R, Feed::words, J>(c, unit);
        if (c.feed == Feed::profile) transduce<V, R, Feed::profile, J>(c, unit);
    }
}

// ---- neurons ----

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

template <class V, class N, bool scaled, int J>
void fire(const NeuronCall<V>& c, int unit) {
    constexpr int w = width<V>;
    const N* n[J];
    typename N::State s[J];
    Batch<V> gain[J];
    Fired<V> fired[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        n[j] = &model<N>(c.models, c.stride, unit / w + j);
        s[j] = read<typename N::State>(c.state, unit + j * w);
        fired[j] = {c.fired, unit + j * w};
        if constexpr (scaled) gain[j] = load(c.gain + unit + j * w);
    });
    const V *from = c.from + (scaled ? 0 : unit), *to = c.to + (scaled ? 0 : unit);
    for (int t = 0; t < c.steps; ++t) {
        c.fired->step = t;
        const auto one = [&](auto j, const auto& i) __attribute__((always_inline)) {
            const auto capped = n[j]->step(s[j], i, fired[j]);
            if (num::any(capped)) fired[j].capped(capped);
        };
        if constexpr (scaled) {
            const Current<Batch<V>> shape{Batch<V>(from[t]), Batch<V>(to[t])};
            const Batch<V> middle(c.mean[t]);
            each_of<J>([&](auto j) __attribute__((always_inline)) { one(j, Scaled<Batch<V>>{gain[j], shape, middle, to[t] > from[t]}); });
        } else {
            each_of<J>([&](auto j) __attribute__((always_inline)) { one(j, Current<Batch<V>>{load(from + t * tile_units + j * w), load(to + t * tile_units + j * w)}); });
        }
    }
    each_of<J>([&](auto j) __attribute__((always_inline)) { write(s[j], c.state, unit + j * w); });
}

template <class V, class N>
void fire_tile(const NeuronCall<V>& c) {
    constexpr int J = 4;
    for (int unit = 0; unit < c.units; unit += J * width<V>) c.gain ? fire<V, N, true, J>(c, unit) : fire<V, N, false, J>(c, unit);
}

// ---- the tables ----

template <class V, class R>
constexpr ReceptorLanes<V> receptor_lanes() {
    return {R::name, R::outputs, sizeof(R), sizeof(typename R::State) / sizeof(Batch<V>), build<V, R>, start<V, R>, transduce_tile<V, R>};
}
template <class V, class N>
constexpr NeuronLanes<V> neuron_lanes() {
    return {N::name, sizeof(N), sizeof(typename N::State) / sizeof(Batch<V>), build<V, N>, start<V, N>, fire_tile<V, N>};
}

template <class V>
struct All {
    template <template <class> class... R>
    static constexpr auto receptors_of(ModelList<R...>) {
        return std::array<ReceptorLanes<V>, sizeof...(R)>{receptor_lanes<V, R<Batch<V>>>()...};
    }
    template <template <class> class... N>
    static constexpr auto neurons_of(ModelList<N...>) {
        return std::array<NeuronLanes<V>, sizeof...(N)>{neuron_lanes<V, N<Batch<V>>>()...};
    }
    static constexpr auto receptors = receptors_of(Receptors{});
    static constexpr auto neurons = neurons_of(Neurons{});
};

}  // namespace

namespace CORPUSCLE_ISA {
const LaneTable<double> doubles{width<double>, All<double>::receptors, All<double>::neurons};
const LaneTable<float> floats{width<float>, All<float>::receptors, All<float>::neurons};
}  // namespace CORPUSCLE_ISA

}  // namespace corpuscle::lanes
