// Compiled once per instruction set.

#include "circuit/uicm_lanes.hpp"

#include "circuit/device/uicm.hpp"
#include "circuit/uicm_values.hpp"

namespace corpuscle::circuit::test::CORPUSCLE_ISA {

using T = num::Lanes<double>;

void uicm_evaluate_batch(const UicmConstants* constants, const double* const (&v)[4], std::size_t count,
                         double* const (&out)[uicm_value_count]) {
    for (std::size_t k = 0; k < count; k += T::size) {
        const Uicm<T> device([&](double UicmConstants::* at) {
            alignas(64) double lanes[T::size];
            for (std::size_t l = 0; l < T::size; ++l) lanes[l] = constants[k + l].*at;
            return T::load_aligned(lanes);
        });
        const T at[4] = {T::load_aligned(v[0] + k), T::load_aligned(v[1] + k), T::load_aligned(v[2] + k), T::load_aligned(v[3] + k)};
        for_each_value(device, at, [&](std::size_t f, T y) { y.store_aligned(out[f] + k); });
    }
}

double uicm_evaluate_rounds(const UicmConstants& constants, const double* const (&v)[4], std::size_t count, std::size_t rounds) {
    const Uicm<T> device(constants);
    UicmEvaluation<T> result;
    T sum(0.0);
    for (std::size_t round = 0; round < rounds; ++round)
        for (std::size_t k = 0; k < count; k += T::size) {
            const T at[4] = {T::load_aligned(v[0] + k), T::load_aligned(v[1] + k), T::load_aligned(v[2] + k), T::load_aligned(v[3] + k)};
            device.eval(at, result);
            sum = sum + sum_of_values(result);
        }
    alignas(64) double lanes[T::size];
    sum.store_aligned(lanes);
    double total = 0;
    for (const double x : lanes) total += x;
    return total;
}

}  // namespace corpuscle::circuit::test::CORPUSCLE_ISA
