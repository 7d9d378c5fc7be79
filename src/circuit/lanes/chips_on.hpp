#pragma once
// The work on a block of chips, T at a time: one number, or a vector of lanes.

#include <utility>

#include "circuit/lanes/chips.hpp"
#include "circuit/lanes/transistors_on.hpp"

namespace corpuscle::circuit::lanes {
namespace {

/// A row in as many T as it takes.
template <class T>
struct Wide {
    static constexpr std::size_t parts = chips / width<T>();
    T of[parts];

    Wide() = default;
    [[gnu::always_inline]] explicit Wide(double x) {
        for (auto& t : of) t = T(x);
    }
    [[gnu::always_inline]] explicit Wide(const Row& row) {
        for (std::size_t k = 0; k < parts; ++k) of[k] = loaded<T>(row.of + k * width<T>());
    }
    [[gnu::always_inline]] void to(Row& row) const {
        for (std::size_t k = 0; k < parts; ++k) store(of[k], row.of + k * width<T>());
    }
    template <class F>
    [[gnu::always_inline]] static Wide each(const F& f) {
        Wide out;
        for (std::size_t k = 0; k < parts; ++k) out.of[k] = f(k);
        return out;
    }
    [[gnu::always_inline]] friend Wide operator+(const Wide& a, const Wide& b) {
        return each([&](std::size_t k) { return a.of[k] + b.of[k]; });
    }
    [[gnu::always_inline]] friend Wide operator-(const Wide& a, const Wide& b) {
        return each([&](std::size_t k) { return a.of[k] - b.of[k]; });
    }
    [[gnu::always_inline]] friend Wide operator*(const Wide& a, const Wide& b) {
        return each([&](std::size_t k) { return a.of[k] * b.of[k]; });
    }
    [[gnu::always_inline]] friend Wide operator/(const Wide& a, const Wide& b) {
        return each([&](std::size_t k) { return a.of[k] / b.of[k]; });
    }
    [[gnu::always_inline]] Wide abs() const {
        return each([&](std::size_t k) { return num::abs(of[k]); });
    }
    [[gnu::always_inline]] friend Wide max(const Wide& a, const Wide& b) {
        return each([&](std::size_t k) { return num::max(a.of[k], b.of[k]); });
    }
    [[gnu::always_inline]] friend Wide min(const Wide& a, const Wide& b) {
        return each([&](std::size_t k) { return num::min(a.of[k], b.of[k]); });
    }
    /// Where which is 1, yes; else no.
    [[gnu::always_inline]] static Wide where(const Wide& which, const Wide& yes, const Wide& no) {
        return each([&](std::size_t k) { return num::select(which.of[k] > T(0.5), yes.of[k], no.of[k]); });
    }
};

template <class T>
[[gnu::always_inline]] inline Wide<T> row(const Row& r) {
    return Wide<T>(r);
}

template <class T>
void predict(const ChipBlock& block, const PredictCall& call) {
    const ChipBlock b = block;  // a copy, which no store can reach
    const Wide<T> begins(call.begins);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T> x(0.0), q(0.0);
        for (std::size_t s = 0; s < b.points; ++s) {
            x = x + row<T>(call.value[s]) * row<T>(b.past_x[s * b.unknowns + n]);
            q = q + row<T>(call.slope[s]) * row<T>(b.past_q[s * b.unknowns + n]);
        }
        Wide<T>::where(begins, x, row<T>(b.x[n])).to(b.x[n]);
        Wide<T>::where(begins, q, row<T>(b.history[n])).to(b.history[n]);
    }
}

inline std::uint8_t bits_of(bool m) { return m; }
#ifdef CORPUSCLE_ISA
inline std::uint8_t bits_of(xsimd::batch_bool<double> m) { return static_cast<std::uint8_t>(num::bits(m)); }
#endif

template <class T>
void moved(const ChipBlock& block, double far, std::uint8_t* of_device) {
    const ChipBlock b = block;  // a copy, which no store can reach
    for (std::size_t d = 0; d < b.devices; ++d) {
        Wide<T> most(0.0);
        for (std::size_t j = 0; j < 4; ++j) most = max((row<T>(b.x[b.terminals[4 * d + j]]) - row<T>(b.looked[4 * d + j])).abs(), most);
        std::uint8_t bits = 0;
        for (std::size_t k = 0; k < Wide<T>::parts; ++k)
            bits = static_cast<std::uint8_t>(bits | bits_of(most.of[k] >= T(far)) << (k * width<T>()));
        of_device[d] = bits;
    }
}

/// L U of what stands in the slots, along the list; growth.
template <class T>
[[gnu::always_inline]] inline Wide<T> factor(const ChipBlock& b) {
    const EliminationList list = b.list;
    Row* const s = b.slots;
    Wide<T> most(0.0);
    const int* target = list.updates;
    for (std::size_t k = 0; k < list.size; ++k) {
        const auto p = list.pivots[k];
        const Wide<T> per = Wide<T>(1.0) / row<T>(s[p.u_begin - 1]);
        per.to(b.per_pivot[k]);
        for (int l = p.l_begin; l < p.l_end; ++l) {
            const Wide<T> m = row<T>(s[l]) * per;
            m.to(s[l]);
            most = max(m.abs(), most);
            for (int u = p.u_begin; u < p.u_end; ++u, ++target) (row<T>(s[*target]) - m * row<T>(s[u])).to(s[*target]);
        }
    }
    return most;
}

/// x with J x = v, in place.
template <class T>
[[gnu::always_inline]] inline void solve_for(const ChipBlock& b, Row* v) {
    const EliminationList list = b.list;
    Row *const s = b.slots, *const y = b.work;
    for (std::size_t k = 0; k < list.size; ++k) (row<T>(v[list.rows[k]]) * Wide<T>(list.scale[list.rows[k]])).to(y[k]);
    for (std::size_t k = 0; k < list.size; ++k) {
        const auto p = list.pivots[k];
        const Wide<T> y_k(y[k]);
        for (int l = p.l_begin; l < p.l_end; ++l) {
            Row& to = y[list.l_rows[l - list.l_from]];
            (row<T>(to) - row<T>(s[l]) * y_k).to(to);
        }
    }
    for (std::size_t k = list.size; k-- > 0;) {
        const auto p = list.pivots[k];
        Wide<T> x(y[k]);
        for (int u = p.u_begin; u < p.u_end; ++u) x = x - row<T>(s[u]) * row<T>(y[list.u_columns[u]]);
        x = x * row<T>(b.per_pivot[k]);
        x.to(y[k]), x.to(v[list.columns[k]]);
    }
}

/// r at x and its slopes J, and step with J step + r = 0.
template <class T>
void solve(const ChipBlock& block, SolveCall& call) {
    const ChipBlock b = block;  // a copy, which no store can reach
    const Wide<T> a(call.a);
    for (std::size_t n = 0; n < b.unknowns; ++n)
        (row<T>(b.base[n]) + row<T>(b.history[n]) + row<T>(b.I[n]) + a * row<T>(b.Q[n])).to(b.r[n]);
    for (std::size_t e = 0; e < b.entries; ++e) {
        const Wide<T> J = row<T>(b.G[e]) + a * row<T>(b.C[e]);
        (J * Wide<T>(b.list.scale[b.row[e]])).to(b.slots[b.slot[e]]);
        (row<T>(b.r[b.row[e]]) + J * row<T>(b.x[b.column[e]])).to(b.r[b.row[e]]);
    }
    for (std::size_t k = 0; k < b.fills; ++k) Wide<T>(0.0).to(b.slots[b.fill[k]]);
    factor<T>(b).to(call.growth);
    for (std::size_t n = 0; n < b.unknowns; ++n) (Wide<T>(0.0) - row<T>(b.r[n])).to(b.step[n]);
    solve_for<T>(b, b.step);
}

template <class T>
void left_over(const ChipBlock& block, const SolveCall& call, Row& worst) {
    const ChipBlock b = block;  // a copy, which no store can reach
    const Wide<T> a(call.a);
    Row *const left = b.error, *const largest = b.work;
    for (std::size_t n = 0; n < b.unknowns; ++n) left[n] = b.r[n], row<T>(b.r[n]).abs().to(largest[n]);
    for (std::size_t e = 0; e < b.entries; ++e) {
        const Wide<T> part = (row<T>(b.G[e]) + a * row<T>(b.C[e])) * row<T>(b.step[b.column[e]]);
        (row<T>(left[b.row[e]]) + part).to(left[b.row[e]]);
        max(part.abs(), row<T>(largest[b.row[e]])).to(largest[b.row[e]]);
    }
    Wide<T> most(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n) most = max(row<T>(left[n]).abs() / max(row<T>(largest[n]), Wide<T>(1e-300)), most);
    most.to(worst);
}

template <class T>
void go(const ChipBlock& block, StepCall& call) {
    const ChipBlock b = block;  // a copy, which no store can reach
    constexpr double most_volts = 0.5;
    const Wide<T> moves(call.moves), zero(0.0);
    Wide<T> size(0.0), clamped(0.0), bad(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T> d(b.step[n]);
        bad = bad + (d - d);
        if (b.voltage[n]) {
            const Wide<T> cut = min(max(d, Wide<T>(-most_volts)), Wide<T>(most_volts));
            clamped = max((d - cut).abs(), clamped);
            d = cut;
        }
        size = max(d.abs() * row<T>(b.per_allowed[n]), size);
        (row<T>(b.x[n]) + Wide<T>::where(moves, d, zero)).to(b.x[n]);
    }
    size.to(call.size), clamped.to(call.clamped), bad.to(call.bad);
}

template <class T>
void charges(const ChipBlock& block) {
    const ChipBlock b = block;  // a copy, which no store can reach
    for (std::size_t n = 0; n < b.unknowns; ++n) row<T>(b.Q[n]).to(b.q[n]);
    for (std::size_t e = 0; e < b.entries; ++e) (row<T>(b.q[b.row[e]]) + row<T>(b.C[e]) * row<T>(b.x[b.column[e]])).to(b.q[b.row[e]]);
}

template <class T>
void error(const ChipBlock& block, ErrorCall& call) {
    const ChipBlock b = block;  // a copy, which no store can reach
    const Wide<T> of_q(call.of_q), of_rate(call.of_rate);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T> e = of_q * row<T>(b.q[n]) + of_rate * row<T>(b.rate[n]);
        for (std::size_t s = 0; s < b.points; ++s) e = e + row<T>(call.of_past[s]) * row<T>(b.past_q[s * b.unknowns + n]);
        e.to(b.error[n]);
    }
    solve_for<T>(b, b.error);
    Wide<T> worst(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n) worst = max(row<T>(b.error[n]).abs() * row<T>(b.per_allowed[n]), worst);
    worst.to(call.worst);
}

template <class T>
void accept(const ChipBlock& block, const AcceptCall& call) {
    const ChipBlock b = block;  // a copy, which no store can reach
    const Wide<T> taken(call.taken), a(call.a), none(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T>::where(taken, a * row<T>(b.q[n]) + row<T>(b.history[n]), row<T>(b.rate[n])).to(b.rate[n]);
        const Wide<T> scale = Wide<T>::where(taken, max(row<T>(b.x[n]).abs(), row<T>(b.scale[n])), row<T>(b.scale[n]));
        scale.to(b.scale[n]);
        const Wide<T> allowed = row<T>(b.relative[n]) * scale + row<T>(b.floor[n]);
        Wide<T>::each([&](std::size_t k) {
            return num::select(allowed.of[k] > T(0.0), T(1.0) / allowed.of[k], none.of[k]);
        }).to(b.per_allowed[n]);
    }
}

template <class T, std::size_t... l>
[[gnu::always_inline]] inline T gathered(const UicmConstants* const* of, double UicmConstants::* field, std::index_sequence<l...>) {
    return T{of[l]->*field...};
}

/// Four numbers of each lane, side by side: at `first` of the first lane, in the next StraightLine of the next.
template <class T>
[[gnu::always_inline]] inline void store_across(const T (&x)[4], double* first) {
    constexpr std::size_t far = sizeof(StraightLine) / sizeof(double);
#if defined(__AVX2__) && !defined(__AVX512F__)
    if constexpr (width<T>() == 4) {
        const __m256d a = _mm256_unpacklo_pd(x[0], x[1]), b = _mm256_unpackhi_pd(x[0], x[1]);
        const __m256d c = _mm256_unpacklo_pd(x[2], x[3]), d = _mm256_unpackhi_pd(x[2], x[3]);
        _mm256_storeu_pd(first, _mm256_permute2f128_pd(a, c, 0x20));
        _mm256_storeu_pd(first + far, _mm256_permute2f128_pd(b, d, 0x20));
        _mm256_storeu_pd(first + 2 * far, _mm256_permute2f128_pd(a, c, 0x31));
        _mm256_storeu_pd(first + 3 * far, _mm256_permute2f128_pd(b, d, 0x31));
        return;
    }
#endif
    alignas(64) double lanes[4][width<T>()];
    for (std::size_t j = 0; j < 4; ++j) store(x[j], lanes[j]);
    for (std::size_t l = 0; l < width<T>(); ++l)
        for (std::size_t j = 0; j < 4; ++j) first[l * far + j] = lanes[j][l];
}

template <class T>
void picked(const PickedCall& call) {
    const std::size_t room = call.room;
    const T gmin(call.gmin);
    for (std::size_t k = 0; k < call.count; k += width<T>()) {
        const UicmConstants* const* of = call.of + k;
        const Uicm<T> model([of](double UicmConstants::* field) { return gathered<T>(of, field, std::make_index_sequence<width<T>()>()); });
        const T v[4] = {loaded<T>(call.v + k), loaded<T>(call.v + room + k), loaded<T>(call.v + 2 * room + k),
                        loaded<T>(call.v + 3 * room + k)};
        UicmAnswer<T> a;
        model.eval(v, a);
        add_gmin(a, v, gmin);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                a.i[i] = a.i[i] - a.di[i][j] * v[j];
                a.q[i] = a.q[i] - a.dq[i][j] * v[j];
            }
        StraightLine* const out = call.out + k;
        store_across(a.i, out->i), store_across(a.q, out->q);
        for (std::size_t i = 0; i < 4; ++i) store_across(a.di[i], out->g + 4 * i), store_across(a.dq[i], out->c + 4 * i);
    }
}

template <class T>
constexpr ChipLanes chip_lanes_of{width<T>(), predict<T>, moved<T>, solve<T>,  left_over<T>,
                                  go<T>,      charges<T>, error<T>, accept<T>, picked<T>};

}  // namespace
}  // namespace corpuscle::circuit::lanes
