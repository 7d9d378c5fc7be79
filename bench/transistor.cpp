// How long does one evaluation of a transistor take: its currents and charges, their 32 derivatives, and both junctions?
//
// Method: one NMOS of 1.5/0.5 um with every effect of the model enabled (velocity saturation, DIBL, Early voltage, junctions, overlaps), at
// 512 random voltage points between -0.2 and 1 V. The data fit the first-level cache, and no branch is predictable. All results are summed,
// so that none is left out. A lane is one transistor at one point. Output: median, minimum and maximum processor time of 15 repetitions of
// about 20 ms, for scalar code and for the SIMD lanes of each instruction set of this machine.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <vector>

#include "circuit/device/uicm.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/uicm_lanes.hpp"
#include "circuit/uicm_values.hpp"
#include "core/random.hpp"

namespace {

using namespace corpuscle;
using namespace corpuscle::circuit;

constexpr std::size_t count = 512;  // points
constexpr std::size_t rounds = 64;  // over all points, in one repetition

/// `v`: voltages of the four terminals, [terminal][point]. Returns the sum of all results.
double scalar_rounds(const UicmConstants& constants, const double* const (&v)[4], std::size_t points, std::size_t times) {
    const Uicm<double> device(constants);
    UicmEvaluation<double> evaluation;
    double sum = 0;
    for (std::size_t round = 0; round < times; ++round)
        for (std::size_t k = 0; k < points; ++k) {
            device.eval({v[0][k], v[1][k], v[2][k], v[3][k]}, evaluation);
            sum += test::sum_of_values(evaluation);
        }
    return sum;
}

/// Processor time of this process, s.
double processor() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Times `run` and prints the result. The first repetition is a warm-up.
void measure(std::string_view name, test::UicmTimingFunction run, const UicmConstants& constants, const double* const (&v)[4]) {
    std::vector<double> ns;
    volatile double result = 0;
    for (int repeat = 0; repeat < 16; ++repeat) {
        const double start = processor();
        result = run(constants, v, count, rounds);
        if (repeat > 0) ns.push_back((processor() - start) / static_cast<double>(count * rounds) * 1e9);
    }
    std::sort(ns.begin(), ns.end());
    std::printf("%-9.*s %6.1f ns a lane (%.1f ... %.1f), sum %.6g\n", static_cast<int>(name.size()), name.data(), ns[ns.size() / 2],
                ns.front(), ns.back(), static_cast<double>(result));
}

}  // namespace

int main() {
    UicmCard card;
    card.sigma_L = 5e-9, card.zeta_L = 0.02e-6, card.C_GSO = card.C_GDO = 3.7e-10, card.C_J = 1e-3, card.C_JSW = 2e-10, card.J_S = 1e-6;
    UicmInstance at;
    at.W = 1.5e-6, at.L = 0.5e-6;
    const UicmConstants constants = uicm_constants(card, at, 27, false);
    alignas(64) static double v[4][count];
    for (std::uint32_t n = 0; n < 4; ++n)
        for (std::size_t k = 0; k < count; ++k) v[n][k] = std::clamp(0.4 + 0.3 * normal(1, n, 0, k), -0.2, 1.0);
    const double* const points[4] = {v[0], v[1], v[2], v[3]};
    measure("scalar", scalar_rounds, constants, points);
    measure("baseline", test::baseline::uicm_evaluate_rounds, constants, points);
#ifdef CORPUSCLE_AVX
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        measure("avx2", test::avx2::uicm_evaluate_rounds, constants, points);
    if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        measure("avx512", test::avx512::uicm_evaluate_rounds, constants, points);
#endif
}
