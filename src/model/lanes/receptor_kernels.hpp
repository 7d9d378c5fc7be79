#pragma once
// Receptors of a tile over a chunk: force in, currents out. Included only by kernel.cpp.

#include "model/lanes/tile_vectors.hpp"

namespace corpuscle::lanes {
namespace {

/// Reads the force on vectors of a tile, from afferent `first` on. It copies the pointers out of the call: otherwise the compiler would
/// reload them after each store of currents, which might have changed them.
template <ForceInput feed, class V>
struct ForceReader {
    const V *rows = nullptr, *profile = nullptr, *gain = nullptr;
    const std::int16_t* int16_rows = nullptr;
    V scale{};
    explicit ForceReader(const ReceptorCall<V>& c, int first) {
        if constexpr (feed == ForceInput::profile)
            profile = c.profile, gain = c.gain + first;
        else if constexpr (feed == ForceInput::int16)
            int16_rows = c.int16_rows + first, scale = c.scale;
        else
            rows = c.rows + first;
    }
    /// The force at a step of the chunk on the vector that begins `offset` afferents after `first`.
    [[gnu::always_inline]] Batch<V> at(int step, int offset) const {
        if constexpr (feed == ForceInput::profile)
            return Batch<V>(profile[step]) * load(gain + offset);
        else if constexpr (feed == ForceInput::int16)
            return num::load_int16<V>(int16_rows + step * tile_size + offset) * Batch<V>(scale);
        else
            return load(rows + step * tile_size + offset);
    }
};

/// Sets the states of all receptors of a tile before the first step. The force before it is that of the first step.
template <class V, class R>
void start_states(ReceptorCall<V>& c) {
    for (int first = 0; first < tile_size; first += width<V>) {
        const auto& r = model<R>(c.models, c.stride, first / width<V>);
        const auto at = [&](ForceInput f) {
            return f == ForceInput::profile ? ForceReader<ForceInput::profile, V>(c, first).at(0, 0)
                   : f == ForceInput::int16 ? ForceReader<ForceInput::int16, V>(c, first).at(0, 0)
                                            : ForceReader<ForceInput::rows, V>(c, first).at(0, 0);
        };
        write(r.start(at(c.input)), c.state, first);
    }
}

/// True if the receptor's current at the beginning of a step is that at the end of the step before.
template <class R>
inline constexpr bool continuous = requires { R::continuous; };

/// Simulates J vectors of a tile over a chunk, from afferent `first` of the tile on.
template <class V, class R, ForceInput feed, int J>
void run_receptors(ReceptorCall<V>& c, int first, Prefetcher& prefetch) {
    constexpr int w = width<V>;
    const R* r[J];
    typename R::State s[J];
    unrolled<J>([&](auto j) __attribute__((always_inline)) {
        r[j] = &model<R>(c.models, c.stride, first / w + j);
        s[j] = read<typename R::State>(c.state, first + j * w);
    });
    // Rows of force are summed to detect NaN and infinity. This is not needed if the receptor's state stays NaN after such a force.
    constexpr bool checks_force = feed == ForceInput::rows && !requires { R::propagates_nan; };
    Batch<V> sum[J];
    unrolled<J>([&](auto j) __attribute__((always_inline)) { sum[j] = Batch<V>(V(0)); });
    const ForceReader<feed, V> force(c, first);
    V *from = c.from + first, *to = c.to + first;
    Prefetcher local = prefetch;
    for (int t = 0, steps = c.steps; t < steps; ++t, from += tile_size, to += tile_size) {
        if constexpr (feed != ForceInput::profile) local.prefetch_next();
        unrolled<J>([&](auto j) __attribute__((always_inline)) {
            const auto F = force.at(t, j * w);
            if constexpr (checks_force) sum[j] = sum[j] + F;
            Current<Batch<V>> i[R::outputs];
            r[j]->step(s[j], F, i);
            // If the receptor is continuous, row t + 1 of `from` is row t of `to`, so only the first row is stored.
            for (int k = 0; k < R::outputs; ++k) {
                if (!continuous<R> || t == 0) i[k].from.store_aligned(from + k * current_rows<V> * tile_size + j * w);
                i[k].to.store_aligned(to + k * current_rows<V> * tile_size + j * w);
            }
        });
    }
    prefetch = local;
    unrolled<J>([&](auto j) __attribute__((always_inline)) {
        write(s[j], c.state, first + j * w);
        const auto zero_or_nan = sum[j] - sum[j];  // NaN if a force was NaN or infinite
        if constexpr (checks_force) c.has_non_finite = c.has_non_finite || !num::all(zero_or_nan == Batch<V>(V(0)));
    });
}

template <class V, class R>
void run_receptor_tile(ReceptorCall<V>& c) {
    constexpr int J = 2;
    Prefetcher local(c.prefetch, iteration_count<V, J>(c));
    for (int first = 0; first < c.afferents; first += J * width<V>) {
        if (c.input == ForceInput::rows) run_receptors<V, R, ForceInput::rows, J>(c, first, local);
        if (c.input == ForceInput::int16) run_receptors<V, R, ForceInput::int16, J>(c, first, local);
        if (c.input == ForceInput::profile) run_receptors<V, R, ForceInput::profile, J>(c, first, local);
    }
}

}  // namespace
}  // namespace corpuscle::lanes
