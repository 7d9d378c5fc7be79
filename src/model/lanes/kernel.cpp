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
    [&]<int... j>(std::integer_sequence<int, j...>)
        __attribute__((always_inline)) { (f(std::integral_constant<int, j>{}), ...); }(std::make_integer_sequence<int, J>{});
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

// ---- transductions ----

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

/// Asks for memory ahead, some lines each time, so that all of it is asked for in `times`.
class Asking {
    const char *at_, *end_;
    std::size_t step_;

public:
    Asking(Ahead ahead, int times)
        : at_(ahead.at), end_(ahead.at + ahead.bytes), step_((ahead.bytes / static_cast<std::size_t>(times) + 63) / 64 * 64) {}
    [[gnu::always_inline]] void some() {
        const char* const until = at_ + step_ < end_ ? at_ + step_ : end_;
        for (; at_ < until; at_ += 64) __builtin_prefetch(at_);
    }
};

/// How often a loop over J vectors at once goes round for a tile.
template <class V, int J, class Call>
int rounds(const Call& c) {
    return (c.units + J * width<V> - 1) / (J * width<V>)*c.steps;
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

/// One step of a vector under its current, whatever happens in it.
template <class N, class S, class I, class F>
[[gnu::always_inline]] inline void step_one(const N& n, S& s, const I& i, const F& fired) {
    const auto capped = n.step(s, i, fired);
    if (num::any(capped)) fired.capped(capped);
}

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
            unsigned where = 0;
            each_of<J>([&](auto j) __attribute__((always_inline)) {
                before[j] = s[j], after[j] = next[j];
                where |= static_cast<unsigned>(num::any(something[j])) << j;
            });
            for (; where != 0; where &= where - 1) {
                const int k = __builtin_ctz(where);
                S one = before[k];
                step_one(*n[k], one, current(k), fired[k]);
                after[k] = one;
            }
            each_of<J>([&](auto j) __attribute__((always_inline)) { next[j] = after[j]; });
        }
        each_of<J>([&](auto j) __attribute__((always_inline)) { s[j] = next[j]; });
    } else {
        each_of<J>([&](auto j) __attribute__((always_inline)) { step_one(*n[j], s[j], current(j), fired[j]); });
    }
}

template <class V, class N, bool scaled, bool waits, int J>
void fire(const NeuronCall<V>& c, int unit, Asking& asked) {
    constexpr int w = width<V>;
    using T = Batch<V>;
    const N* n[J];
    typename N::State s[J];
    Fired<V> fired[J];
    each_of<J>([&](auto j) __attribute__((always_inline)) {
        n[j] = &model<N>(c.models, c.stride, unit / w + j);
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
                return [&](int j) __attribute__((always_inline)) { return Scaled<T, V, rising>{load(gain + j * w), both, from[t], to[t]}; };
            };
            if (to[t] > from[t])
                step_all<waits, J>(n, s, fired, current(std::true_type{}));
            else
                step_all<waits, J>(n, s, fired, current(std::false_type{}));
        } else {
            step_all<waits, J>(n, s, fired, [&](int j) __attribute__((always_inline)) {
                return Current<T>{load(from + t * tile_units + j * w), load(to + t * tile_units + j * w)};
            });
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
                c.gain ? fire<V, N, true, false, J>(c, unit, asking) : fire<V, N, false, false, J>(c, unit, asking);
                continue;
            }
        c.gain ? fire<V, N, true, true, J>(c, unit, asking) : fire<V, N, false, true, J>(c, unit, asking);
    }
}

// ---- the tables ----

template <class V, class R>
constexpr ReceptorLanes<V> receptor_lanes() {
    return {R::name,     R::outputs,  continuous<R>,       sizeof(R), sizeof(typename R::State) / sizeof(Batch<V>),
            build<V, R>, start<V, R>, transduce_tile<V, R>};
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
