#pragma once
// All values of an evaluation of the transistor model UICM in a fixed order, for any number type. Include uicm.hpp first.

#include <cstddef>

namespace corpuscle::circuit::test {

/// Evaluates a device at its terminal voltages v and calls put(index, value) for each value: 4 currents, 4 charges, the 16 derivatives of
/// the currents, the 16 of the charges, and the 4 noise densities.
template <class T, class Put>
void for_each_value(const Uicm<T>& device, const T (&v)[4], const Put& put) {
    UicmEvaluation<T> result;
    device.eval(v, result);
    std::size_t f = 0;
    for (const T& y : result.i) put(f++, y);
    for (const T& y : result.q) put(f++, y);
    for (const auto& row : result.di)
        for (const T& y : row) put(f++, y);
    for (const auto& row : result.dq)
        for (const T& y : row) put(f++, y);
    const auto noise = device.noise(v);
    for (const T& y : {noise.thermal, noise.flicker, noise.shot_s, noise.shot_d}) put(f++, y);
}

/// The sum of all currents, charges and derivatives.
template <class T>
T sum_of_values(const UicmEvaluation<T>& evaluation) {
    T sum(0.0);
    for (int a = 0; a < 4; ++a) {
        sum = sum + evaluation.i[a] + evaluation.q[a];
        for (int b = 0; b < 4; ++b) sum = sum + evaluation.di[a][b] + evaluation.dq[a][b];
    }
    return sum;
}

}  // namespace corpuscle::circuit::test
