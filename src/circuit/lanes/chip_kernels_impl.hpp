#pragma once
// Kernels for a block of chips. T is double or a vector of lanes.

#include "circuit/lanes/transistor_kernels_impl.hpp"

namespace corpuscle::circuit::lanes {
namespace {

/// A row as an array of T.
template <class T>
struct Wide {
    static constexpr std::size_t parts = chips_per_block / width<T>();
    T part[parts];

    Wide() = default;
    [[gnu::always_inline]] explicit Wide(double x) {
        for (auto& t : part) t = T(x);
    }
    [[gnu::always_inline]] explicit Wide(const LaneRow& row) {
        for (std::size_t k = 0; k < parts; ++k) part[k] = load<T>(row.value + k * width<T>());
    }
    [[gnu::always_inline]] void to(LaneRow& row) const {
        for (std::size_t k = 0; k < parts; ++k) store(part[k], row.value + k * width<T>());
    }
    template <class F>
    [[gnu::always_inline]] static Wide for_each_part(const F& f) {
        Wide out;
        for (std::size_t k = 0; k < parts; ++k) out.part[k] = f(k);
        return out;
    }
    [[gnu::always_inline]] friend Wide operator+(const Wide& a, const Wide& b) {
        return for_each_part([&](std::size_t k) { return a.part[k] + b.part[k]; });
    }
    [[gnu::always_inline]] friend Wide operator-(const Wide& a, const Wide& b) {
        return for_each_part([&](std::size_t k) { return a.part[k] - b.part[k]; });
    }
    [[gnu::always_inline]] friend Wide operator*(const Wide& a, const Wide& b) {
        return for_each_part([&](std::size_t k) { return a.part[k] * b.part[k]; });
    }
    [[gnu::always_inline]] friend Wide operator/(const Wide& a, const Wide& b) {
        return for_each_part([&](std::size_t k) { return a.part[k] / b.part[k]; });
    }
    [[gnu::always_inline]] Wide abs() const {
        return for_each_part([&](std::size_t k) { return num::abs(part[k]); });
    }
    [[gnu::always_inline]] friend Wide max(const Wide& a, const Wide& b) {
        return for_each_part([&](std::size_t k) { return num::max(a.part[k], b.part[k]); });
    }
    [[gnu::always_inline]] friend Wide min(const Wide& a, const Wide& b) {
        return for_each_part([&](std::size_t k) { return num::min(a.part[k], b.part[k]); });
    }
    /// if_true where condition is 1, else if_false.
    [[gnu::always_inline]] static Wide where(const Wide& condition, const Wide& if_true, const Wide& if_false) {
        return for_each_part([&](std::size_t k) { return num::select(condition.part[k] > T(0.5), if_true.part[k], if_false.part[k]); });
    }
};

template <class T>
[[gnu::always_inline]] inline Wide<T> row(const LaneRow& r) {
    return Wide<T>(r);
}

template <class T>
void predict(const ChipBlock& block, const PredictCall& call) {
    const ChipBlock b = block;  // a local copy cannot alias the stores below
    const Wide<T> is_new_step(call.is_new_step);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T> x(0.0), q(0.0);
        for (std::size_t s = 0; s < b.points; ++s) {
            x = x + row<T>(call.value_weights[s]) * row<T>(b.past_x[s * b.unknowns + n]);
            q = q + row<T>(call.slope_weights[s]) * row<T>(b.past_q[s * b.unknowns + n]);
        }
        Wide<T>::where(is_new_step, x, row<T>(b.x[n])).to(b.x[n]);
        Wide<T>::where(is_new_step, q, row<T>(b.history[n])).to(b.history[n]);
    }
}

/// A bit for each lane.
inline std::uint8_t bits_of(bool m) { return m; }
#ifdef CORPUSCLE_ISA
inline std::uint8_t bits_of(xsimd::batch_bool<double> m) { return static_cast<std::uint8_t>(num::mask_bits(m)); }
#endif

template <class T>
void find_moved(const ChipBlock& block, double radius, std::uint8_t* of_device) {
    const ChipBlock b = block;  // a local copy cannot alias the stores below
    for (std::size_t d = 0; d < b.devices; ++d) {
        Wide<T> distance(0.0);
        for (std::size_t j = 0; j < 4; ++j)
            distance = max((row<T>(b.x[b.terminals[4 * d + j]]) - row<T>(b.linearized_at[4 * d + j])).abs(), distance);
        std::uint8_t bits = 0;
        for (std::size_t k = 0; k < Wide<T>::parts; ++k)
            bits = static_cast<std::uint8_t>(bits | bits_of(distance.part[k] >= T(radius)) << (k * width<T>()));
        of_device[d] = bits;
    }
}

/// Factors the matrix in the slots into L U by the elimination list. Returns the largest multiplier.
template <class T>
[[gnu::always_inline]] inline Wide<T> factor(const ChipBlock& b) {
    const EliminationList list = b.list;
    LaneRow* const s = b.slots;
    Wide<T> max_multiplier(0.0);
    const int* target = list.updates;
    for (std::size_t k = 0; k < list.size; ++k) {
        const auto p = list.pivots[k];
        const Wide<T> inverse = Wide<T>(1.0) / row<T>(s[p.u_begin - 1]);
        inverse.to(b.inverse_pivot[k]);
        for (int l = p.l_begin; l < p.l_end; ++l) {
            const Wide<T> m = row<T>(s[l]) * inverse;
            m.to(s[l]);
            max_multiplier = max(m.abs(), max_multiplier);
            for (int u = p.u_begin; u < p.u_end; ++u, ++target) (row<T>(s[*target]) - m * row<T>(s[u])).to(s[*target]);
        }
    }
    return max_multiplier;
}

/// Solves J x = v in place.
template <class T>
[[gnu::always_inline]] inline void solve_for(const ChipBlock& b, LaneRow* v) {
    const EliminationList list = b.list;
    LaneRow *const s = b.slots, *const y = b.work;
    for (std::size_t k = 0; k < list.size; ++k) (row<T>(v[list.rows[k]]) * Wide<T>(list.scale[list.rows[k]])).to(y[k]);
    for (std::size_t k = 0; k < list.size; ++k) {
        const auto p = list.pivots[k];
        const Wide<T> y_k(y[k]);
        for (int l = p.l_begin; l < p.l_end; ++l) {
            LaneRow& to = y[list.l_rows[l - list.l_first_slot]];
            (row<T>(to) - row<T>(s[l]) * y_k).to(to);
        }
    }
    for (std::size_t k = list.size; k-- > 0;) {
        const auto p = list.pivots[k];
        Wide<T> x(y[k]);
        for (int u = p.u_begin; u < p.u_end; ++u) x = x - row<T>(s[u]) * row<T>(y[list.u_columns[u]]);
        x = x * row<T>(b.inverse_pivot[k]);
        x.to(y[k]), x.to(v[list.columns[k]]);
    }
}

/// Computes the residual r and the Jacobian J at x, and solves J step + r = 0.
template <class T>
void solve(const ChipBlock& block, SolveCall& call) {
    const ChipBlock b = block;  // a local copy cannot alias the stores below
    const Wide<T> a(call.a);
    for (std::size_t n = 0; n < b.unknowns; ++n)
        (row<T>(b.source_currents[n]) + row<T>(b.history[n]) + row<T>(b.I[n]) + a * row<T>(b.Q[n])).to(b.r[n]);
    for (std::size_t e = 0; e < b.entries; ++e) {
        const Wide<T> J = row<T>(b.G[e]) + a * row<T>(b.C[e]);
        (J * Wide<T>(b.list.scale[b.row[e]])).to(b.slots[b.slot[e]]);
        (row<T>(b.r[b.row[e]]) + J * row<T>(b.x[b.column[e]])).to(b.r[b.row[e]]);
    }
    for (std::size_t k = 0; k < b.fill_count; ++k) Wide<T>(0.0).to(b.slots[b.fill[k]]);
    factor<T>(b).to(call.growth);
    for (std::size_t n = 0; n < b.unknowns; ++n) (Wide<T>(0.0) - row<T>(b.r[n])).to(b.step[n]);
    solve_for<T>(b, b.step);
}

template <class T>
void residual(const ChipBlock& block, const SolveCall& call, LaneRow& worst) {
    const ChipBlock b = block;  // a local copy cannot alias the stores below
    const Wide<T> a(call.a);
    LaneRow *const sum = b.error, *const largest = b.work;  // J step + r; largest term of each row
    for (std::size_t n = 0; n < b.unknowns; ++n) sum[n] = b.r[n], row<T>(b.r[n]).abs().to(largest[n]);
    for (std::size_t e = 0; e < b.entries; ++e) {
        const Wide<T> part = (row<T>(b.G[e]) + a * row<T>(b.C[e])) * row<T>(b.step[b.column[e]]);
        (row<T>(sum[b.row[e]]) + part).to(sum[b.row[e]]);
        max(part.abs(), row<T>(largest[b.row[e]])).to(largest[b.row[e]]);
    }
    Wide<T> max_residual(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n)
        max_residual = max(row<T>(sum[n]).abs() / max(row<T>(largest[n]), Wide<T>(1e-300)), max_residual);
    max_residual.to(worst);
}

template <class T>
void apply_step(const ChipBlock& block, StepCall& call) {
    const ChipBlock b = block;                  // a local copy cannot alias the stores below
    constexpr double max_voltage_change = 0.5;  // V
    const Wide<T> updates_x(call.updates_x), zero(0.0);
    Wide<T> size(0.0), clamped(0.0), non_finite(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T> d(b.step[n]);
        non_finite = non_finite + (d - d);  // NaN or infinite d gives NaN
        if (b.is_voltage[n]) {
            const Wide<T> cut = min(max(d, Wide<T>(-max_voltage_change)), Wide<T>(max_voltage_change));
            clamped = max((d - cut).abs(), clamped);
            d = cut;
        }
        size = max(d.abs() * row<T>(b.inverse_allowed[n]), size);
        (row<T>(b.x[n]) + Wide<T>::where(updates_x, d, zero)).to(b.x[n]);
    }
    size.to(call.size), clamped.to(call.clamped), non_finite.to(call.non_finite);
}

template <class T>
void evaluate_charges(const ChipBlock& block) {
    const ChipBlock b = block;  // a local copy cannot alias the stores below
    for (std::size_t n = 0; n < b.unknowns; ++n) row<T>(b.Q[n]).to(b.q[n]);
    for (std::size_t e = 0; e < b.entries; ++e) (row<T>(b.q[b.row[e]]) + row<T>(b.C[e]) * row<T>(b.x[b.column[e]])).to(b.q[b.row[e]]);
}

template <class T>
void estimate_error(const ChipBlock& block, ErrorCall& call) {
    const ChipBlock b = block;  // a local copy cannot alias the stores below
    const Wide<T> charge_weight(call.charge_weight), rate_weight(call.rate_weight);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T> e = charge_weight * row<T>(b.q[n]) + rate_weight * row<T>(b.rate[n]);
        for (std::size_t s = 0; s < b.points; ++s) e = e + row<T>(call.past_weights[s]) * row<T>(b.past_q[s * b.unknowns + n]);
        e.to(b.error[n]);
    }
    solve_for<T>(b, b.error);
    Wide<T> worst(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n) worst = max(row<T>(b.error[n]).abs() * row<T>(b.inverse_allowed[n]), worst);
    worst.to(call.worst);
}

template <class T>
void solve_perturbation(const ChipBlock& block) {
    solve_for<T>(block, block.error);
}

template <class T>
void accept(const ChipBlock& block, const AcceptCall& call) {
    const ChipBlock b = block;  // a local copy cannot alias the stores below
    const Wide<T> is_accepted(call.is_accepted), a(call.a), zero(0.0);
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        Wide<T>::where(is_accepted, a * row<T>(b.q[n]) + row<T>(b.history[n]), row<T>(b.rate[n])).to(b.rate[n]);
        const Wide<T> scale = Wide<T>::where(is_accepted, max(row<T>(b.x[n]).abs(), row<T>(b.scale[n])), row<T>(b.scale[n]));
        scale.to(b.scale[n]);
        const Wide<T> allowed = row<T>(b.relative[n]) * scale + row<T>(b.floor[n]);
        Wide<T>::for_each_part([&](std::size_t k) {
            return num::select(allowed.part[k] > T(0.0), T(1.0) / allowed.part[k], zero.part[k]);
        }).to(b.inverse_allowed[n]);
    }
}

template <class T, std::size_t... l>
[[gnu::always_inline]] inline T gather(const UicmConstants* const* constants, double UicmConstants::* field, std::index_sequence<l...>) {
    return T{constants[l]->*field...};
}

/// Transposes four vectors of lanes into memory: for each lane its four numbers one after another, at a distance of one Linearization from
/// those of the lane before. `first`: address for the first lane.
template <class T>
[[gnu::always_inline]] inline void store_across(const T (&x)[4], double* first) {
    constexpr std::size_t distance = sizeof(Linearization) / sizeof(double);
#if defined(__AVX2__) && !defined(__AVX512F__)
    if constexpr (width<T>() == 4) {
        const __m256d a = _mm256_unpacklo_pd(x[0], x[1]), b = _mm256_unpackhi_pd(x[0], x[1]);
        const __m256d c = _mm256_unpacklo_pd(x[2], x[3]), d = _mm256_unpackhi_pd(x[2], x[3]);
        _mm256_storeu_pd(first, _mm256_permute2f128_pd(a, c, 0x20));
        _mm256_storeu_pd(first + distance, _mm256_permute2f128_pd(b, d, 0x20));
        _mm256_storeu_pd(first + 2 * distance, _mm256_permute2f128_pd(a, c, 0x31));
        _mm256_storeu_pd(first + 3 * distance, _mm256_permute2f128_pd(b, d, 0x31));
        return;
    }
#endif
    alignas(64) double lanes[4][width<T>()];
    for (std::size_t j = 0; j < 4; ++j) store(x[j], lanes[j]);
    for (std::size_t l = 0; l < width<T>(); ++l)
        for (std::size_t j = 0; j < 4; ++j) first[l * distance + j] = lanes[j][l];
}

template <class T>
void linearize(const LinearizeCall& call) {
    const std::size_t stride = call.stride;
    const T gmin(call.gmin);
    for (std::size_t k = 0; k < call.count; k += width<T>()) {
        const UicmConstants* const* constants = call.constants + k;
        const Uicm<T> model(
            [constants](double UicmConstants::* field) { return gather<T>(constants, field, std::make_index_sequence<width<T>()>()); });
        const T v[4] = {load<T>(call.v + k), load<T>(call.v + stride + k), load<T>(call.v + 2 * stride + k),
                        load<T>(call.v + 3 * stride + k)};
        UicmEvaluation<T> a;
        model.eval(v, a);
        add_gmin(a, v, gmin);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                a.i[i] = a.i[i] - a.di[i][j] * v[j];
                a.q[i] = a.q[i] - a.dq[i][j] * v[j];
            }
        Linearization* const out = call.out + k;
        store_across(a.i, out->i), store_across(a.q, out->q);
        for (std::size_t i = 0; i < 4; ++i) store_across(a.di[i], out->g + 4 * i), store_across(a.dq[i], out->c + 4 * i);
    }
}

template <class T>
constexpr ChipKernels chip_kernels_for{width<T>(),          predict<T>,        find_moved<T>,         solve<T>,  residual<T>, apply_step<T>,
                                       evaluate_charges<T>, estimate_error<T>, solve_perturbation<T>, accept<T>, linearize<T>};

}  // namespace
}  // namespace corpuscle::circuit::lanes
