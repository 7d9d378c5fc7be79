#pragma once
// Transistor kernels: the equations applied to the arrays of a call. T is double or a vector of lanes.

#include <new>
#include <type_traits>

#include "circuit/device/uicm.hpp"
#include "circuit/lanes/kernels.hpp"

namespace corpuscle::circuit::lanes {
namespace {

/// The number of lanes of T.
template <class T>
constexpr std::size_t width() {
    if constexpr (std::is_same_v<T, double>)
        return 1;
    else
        return T::size;
}
template <class T>
[[gnu::always_inline]] inline T load(const double* from) {
    if constexpr (std::is_same_v<T, double>)
        return *from;
    else
        return T::load_aligned(from);
}
template <class T>
[[gnu::always_inline]] inline void store(const T& x, double* to) {
    if constexpr (std::is_same_v<T, double>)
        *to = x;
    else
        x.store_aligned(to);
}

// The functions of TransistorKernels.
template <class T>
void build(std::byte* to, const UicmConstants* constants) {
    new (to) Uicm<T>([constants](double UicmConstants::* field) {
        alignas(64) double lanes[width<T>()];
        for (std::size_t l = 0; l < width<T>(); ++l) lanes[l] = constants[l].*field;
        return load<T>(lanes);
    });
}

constexpr double phi_t = 0.026;  // V: smallest voltage scale of the rounding error, since the arguments of exp are relative to phi_t

/// Adds the conductance gmin in parallel with both junctions.
template <class T>
[[gnu::always_inline]] inline void add_gmin(UicmEvaluation<T>& a, const T (&v)[4], T gmin) {
    using Terminal = Terminals;
    const T i_d = gmin * (v[Terminal::B] - v[Terminal::D]), i_s = gmin * (v[Terminal::B] - v[Terminal::S]);
    a.i[Terminal::B] = a.i[Terminal::B] + i_d + i_s, a.i[Terminal::D] = a.i[Terminal::D] - i_d, a.i[Terminal::S] = a.i[Terminal::S] - i_s;
    a.di[Terminal::B][Terminal::B] = a.di[Terminal::B][Terminal::B] + gmin + gmin;
    for (const int end : {Terminal::D, Terminal::S}) {
        a.di[end][end] = a.di[end][end] + gmin;
        a.di[Terminal::B][end] = a.di[Terminal::B][end] - gmin, a.di[end][Terminal::B] = a.di[end][Terminal::B] - gmin;
    }
}

/// eval() with or without charges, as q of the call is given or null.
template <class T, bool with_charges>
[[gnu::always_inline]] inline void eval_as(const TransistorCall& call) {
    const std::size_t stride = call.stride;
    const auto* model = reinterpret_cast<const Uicm<T>*>(call.models);
    const T gmin(call.gmin), rate(call.rate);
    for (std::size_t k = 0; k < call.count; k += width<T>(), ++model) {
        const T v[4] = {load<T>(call.v + k), load<T>(call.v + stride + k), load<T>(call.v + 2 * stride + k),
                        load<T>(call.v + 3 * stride + k)};
        UicmEvaluation<T> a;
        model->eval(v, a);
        add_gmin(a, v, gmin);
        if constexpr (with_charges) {
            for (std::size_t row = 0; row < 4; ++row) {
                store(a.q[row], call.q + row * stride + k);
                a.i[row] = a.i[row] + rate * a.q[row];
                for (std::size_t column = 0; column < 4; ++column) {
                    store(a.dq[row][column], call.dq + (4 * row + column) * stride + k);
                    a.di[row][column] = a.di[row][column] + rate * a.dq[row][column];
                }
            }
        }
        for (std::size_t row = 0; row < 4; ++row) {
            store(a.i[row], call.f + row * stride + k);
            for (std::size_t column = 0; column < 4; ++column) store(a.di[row][column], call.df + (4 * row + column) * stride + k);
            if (call.max_term == nullptr) continue;
            T max_term(0.0);
            for (std::size_t column = 0; column < 4; ++column)
                max_term = num::max(max_term, num::abs(a.di[row][column]) * num::max(num::abs(v[column]), T(phi_t)));
            store(max_term, call.max_term + row * stride + k);
        }
    }
}

template <class T>
void eval(const TransistorCall& call) {
    call.q ? eval_as<T, true>(call) : eval_as<T, false>(call);
}

template <class T>
void extrapolate(std::size_t stride, const double* dv, const double* dq, double* q) {
    for (std::size_t k = 0; k < stride; k += width<T>()) {
        const T d[4] = {load<T>(dv + k), load<T>(dv + stride + k), load<T>(dv + 2 * stride + k), load<T>(dv + 3 * stride + k)};
        for (std::size_t row = 0; row < 4; ++row) {
            T sum = load<T>(q + row * stride + k);
            for (std::size_t column = 0; column < 4; ++column) sum = sum + load<T>(dq + (4 * row + column) * stride + k) * d[column];
            store(sum, q + row * stride + k);
        }
    }
}

template <class T>
constexpr TransistorKernels transistor_kernels_for{width<T>(), sizeof(Uicm<T>), build<T>, eval<T>, extrapolate<T>};

}  // namespace
}  // namespace corpuscle::circuit::lanes
