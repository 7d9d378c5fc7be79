#pragma once
// The transistor's equations along the arrays of a call, T at a time: one number, or a vector of lanes.

#include <new>
#include <type_traits>

#include "circuit/device/uicm.hpp"
#include "circuit/lanes/transistors.hpp"

namespace corpuscle::circuit::lanes {
namespace {

template <class T>
constexpr std::size_t width() {
    if constexpr (std::is_same_v<T, double>)
        return 1;
    else
        return T::size;
}
template <class T>
[[gnu::always_inline]] inline T loaded(const double* at) {
    if constexpr (std::is_same_v<T, double>)
        return *at;
    else
        return T::load_aligned(at);
}
template <class T>
[[gnu::always_inline]] inline void store(const T& x, double* at) {
    if constexpr (std::is_same_v<T, double>)
        *at = x;
    else
        x.store_aligned(at);
}

template <class T>
void build(std::byte* at, const UicmConstants* of) {
    new (at) Uicm<T>([of](double UicmConstants::* field) {
        alignas(64) double lanes[width<T>()];
        for (std::size_t l = 0; l < width<T>(); ++l) lanes[l] = of[l].*field;
        return loaded<T>(lanes);
    });
}

constexpr double phi_t = 0.026;  // V: rounding is of what exponents hold, and they hold no less

/// A small conductance beside both junctions.
template <class T>
[[gnu::always_inline]] inline void add_gmin(UicmAnswer<T>& a, const T (&v)[4], T gmin) {
    using Of = Terminals;
    const T i_d = gmin * (v[Of::B] - v[Of::D]), i_s = gmin * (v[Of::B] - v[Of::S]);
    a.i[Of::B] = a.i[Of::B] + i_d + i_s, a.i[Of::D] = a.i[Of::D] - i_d, a.i[Of::S] = a.i[Of::S] - i_s;
    a.di[Of::B][Of::B] = a.di[Of::B][Of::B] + gmin + gmin;
    for (const int end : {Of::D, Of::S}) {
        a.di[end][end] = a.di[end][end] + gmin;
        a.di[Of::B][end] = a.di[Of::B][end] - gmin, a.di[end][Of::B] = a.di[end][Of::B] - gmin;
    }
}

template <class T, bool charges>
[[gnu::always_inline]] inline void eval_as(const TransistorCall& call) {
    const std::size_t room = call.room;
    const auto* model = reinterpret_cast<const Uicm<T>*>(call.models);
    const T gmin(call.gmin), rate(call.rate);
    for (std::size_t k = 0; k < call.count; k += width<T>(), ++model) {
        const T v[4] = {loaded<T>(call.v + k), loaded<T>(call.v + room + k), loaded<T>(call.v + 2 * room + k),
                        loaded<T>(call.v + 3 * room + k)};
        UicmAnswer<T> a;
        model->eval(v, a);
        add_gmin(a, v, gmin);
        if constexpr (charges) {
            for (std::size_t row = 0; row < 4; ++row) {
                store(a.q[row], call.q + row * room + k);
                a.i[row] = a.i[row] + rate * a.q[row];
                for (std::size_t column = 0; column < 4; ++column) {
                    store(a.dq[row][column], call.dq + (4 * row + column) * room + k);
                    a.di[row][column] = a.di[row][column] + rate * a.dq[row][column];
                }
            }
        }
        for (std::size_t row = 0; row < 4; ++row) {
            store(a.i[row], call.f + row * room + k);
            for (std::size_t column = 0; column < 4; ++column) store(a.di[row][column], call.df + (4 * row + column) * room + k);
            if (call.most == nullptr) continue;
            T most(0.0);
            for (std::size_t column = 0; column < 4; ++column)
                most = num::max(most, num::abs(a.di[row][column]) * num::max(num::abs(v[column]), T(phi_t)));
            store(most, call.most + row * room + k);
        }
    }
}

template <class T>
void eval(const TransistorCall& call) {
    call.q ? eval_as<T, true>(call) : eval_as<T, false>(call);
}

template <class T>
void follow(std::size_t room, const double* dv, const double* dq, double* q) {
    for (std::size_t k = 0; k < room; k += width<T>()) {
        const T d[4] = {loaded<T>(dv + k), loaded<T>(dv + room + k), loaded<T>(dv + 2 * room + k), loaded<T>(dv + 3 * room + k)};
        for (std::size_t row = 0; row < 4; ++row) {
            T sum = loaded<T>(q + row * room + k);
            for (std::size_t column = 0; column < 4; ++column) sum = sum + loaded<T>(dq + (4 * row + column) * room + k) * d[column];
            store(sum, q + row * room + k);
        }
    }
}

template <class T>
constexpr TransistorLanes transistor_lanes{width<T>(), sizeof(Uicm<T>), build<T>, eval<T>, follow<T>};

}  // namespace
}  // namespace corpuscle::circuit::lanes
