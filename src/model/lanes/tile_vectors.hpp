#pragma once
// Helpers of the loops over a tile's vectors: models and states in memory, unrolling, prefetching. Included only by kernel.cpp.

#include <new>
#include <type_traits>
#include <utility>

#include "core/parameter.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {
namespace {

/// A vector: the values of as many afferents as fit a SIMD register, and their number.
template <class V>
using Batch = num::Lanes<V>;
template <class V>
inline constexpr int width = static_cast<int>(Batch<V>::size);

/// Calls f(0), f(1) ... f(J - 1) with constant arguments: unrolled, so that arrays of states stay in registers.
template <int J, class F>
[[gnu::always_inline]] inline void unrolled(F&& f) {
    [&]<int... j>(std::integer_sequence<int, j...>)
        __attribute__((always_inline)) { (f(std::integral_constant<int, j>{}), ...); }(std::make_integer_sequence<int, J>{});
}

template <class V>
Batch<V> load(const V* at) {
    return Batch<V>::load_aligned(at);
}

/// Passes the parameters of model M to its constructor: lane l gets those of afferent l.
template <class V, class M>
struct PerLaneValues {
    static constexpr int parameters = static_cast<int>(sizeof M::parameters / sizeof M::parameters[0]);
    const double* values;  ///< those of all parameters, afferent by afferent
    int count;             ///< number of afferents in `values`; further lanes get the values of the last one
    Batch<V> operator()(ParameterName<M> name) const {
        alignas(64) V lanes[width<V>];
        for (int l = 0; l < width<V>; ++l)
            lanes[l] = static_cast<V>(values[(l < count ? l : count - 1) * parameters + static_cast<int>(name.index)]);
        return load(lanes);
    }
    /// The value of a parameter that must be the same on all lanes.
    double uniform(ParameterName<M> name) const { return values[name.index]; }
};

/// Builds the models of a tile; see ReceptorKernel::build.
template <class V, class M>
void build(std::byte* at, const double* values, int count, double dt, Method method) {
    using Values = PerLaneValues<V, M>;
    for (int l = 0; l < (count == 1 ? 1 : tile_size); l += width<V>, at += sizeof(M)) {
        const int from = l < count ? l : count - 1;
        new (at) M(Values{values + from * Values::parameters, count - from}, dt, method);
    }
}

/// The model of a vector of the tile; `stride` as in ReceptorCall.
template <class M>
const M& model(const std::byte* models, std::size_t stride, int vector) {
    return *reinterpret_cast<const M*>(models + stride * static_cast<std::size_t>(vector));
}

/// Number of state values of one afferent.
template <class S, class V>
inline constexpr std::size_t value_count = sizeof(S) / sizeof(Batch<V>);

/// All state values of a vector, for states too large for the registers.
template <class S, class V>
struct AllValues {
    Batch<V> value[value_count<S, V>];
};

/// Loads the first `stored` values of the state of a vector from its tile, at whose afferent `first` the vector begins; the others are 0.
/// The state is returned by value: a loop variable whose address is never taken can stay in registers.
template <class S, class V, std::size_t stored = value_count<S, V>>
[[gnu::always_inline]] inline S read(const V* state, int first) {
    if constexpr (value_count<S, V> > 5) {
        AllValues<S, V> all;
        for (std::size_t k = 0; k < value_count<S, V>; ++k)
            all.value[k] = k < stored ? load(state + k * tile_size + first) : Batch<V>(V(0));
        return __builtin_bit_cast(S, all);
    } else {
        return [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
            return S{(k < stored ? load(state + k * tile_size + first) : Batch<V>(V(0)))...};
        }(std::make_index_sequence<value_count<S, V>>{});
    }
}
/// Stores the first `stored` values of the state of a vector in its tile.
template <class S, class V, std::size_t stored = value_count<S, V>>
[[gnu::always_inline]] inline void write(const S& s, V* state, int first) {
    constexpr auto values = value_count<S, V>;
    const auto put = [&](const auto&... value) __attribute__((always_inline)) {
        std::size_t k = 0;
        ((k < stored ? value.store_aligned(state + k * tile_size + first) : void(), ++k), ...);
    };
    if constexpr (values == 1) {
        const auto& [a] = s;
        put(a);
    } else if constexpr (values == 2) {
        const auto& [a, b] = s;
        put(a, b);
    } else if constexpr (values == 3) {
        const auto& [a, b, c] = s;
        put(a, b, c);
    } else if constexpr (values == 4) {
        const auto& [a, b, c, d] = s;
        put(a, b, c, d);
    } else if constexpr (values == 5) {
        const auto& [a, b, c, d, e] = s;
        put(a, b, c, d, e);
    } else {
        const auto all = __builtin_bit_cast(AllValues<S, V>, s);
        for (std::size_t k = 0; k < stored; ++k) all.value[k].store_aligned(state + k * tile_size + first);
    }
}

/// Calls the model's flush_decayed(), if it has one, for all states in a tile. The tile contains the first `stored` values of each state.
template <class V, class M, std::size_t stored = value_count<typename M::State, V>>
void flush_decayed(const TileCall<V>& c) {
    if constexpr (requires(const M& m, typename M::State& s) { m.flush_decayed(s); })
        for (int first = 0; first < tile_size; first += width<V>) {
            auto s = read<typename M::State, V, stored>(c.state, first);
            model<M>(c.models, c.stride, first / width<V>).flush_decayed(s);
            write<typename M::State, V, stored>(s, c.state, first);
        }
}

/// Prefetches a range of memory: a few cache lines in each call, so that `times` calls request all of it.
class Prefetcher {
    const char *at_, *end_;
    std::size_t step_;

public:
    Prefetcher(PrefetchRange ahead, int times)
        : at_(ahead.at), end_(ahead.at + ahead.bytes), step_((ahead.bytes / static_cast<std::size_t>(times) + 63) / 64 * 64) {}
    [[gnu::always_inline]] void prefetch_next() {
        const char* const until = at_ + step_ < end_ ? at_ + step_ : end_;
        for (; at_ < until; at_ += 64) __builtin_prefetch(at_);
    }
};

/// Number of steps that the loops take together if each simulates J vectors of the tile over the chunk.
template <class V, int J>
int iteration_count(const TileCall<V>& c) {
    return (c.afferents + J * width<V> - 1) / (J * width<V>)*c.steps;
}

}  // namespace
}  // namespace corpuscle::lanes
