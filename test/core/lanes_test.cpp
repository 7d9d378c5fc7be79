// Functions on lanes equal the scalar functions bit for bit in double. In float they are the same on every instruction set, and close to
// double.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <vector>

#include "core/number/elementary.hpp"
#include "core/number/instruction_set.hpp"
#include "core/number_functions.hpp"
#include "core/number_lanes.hpp"
#include "core/random.hpp"
#include "model/lanes/aligned_buffer.hpp"

namespace corpuscle {
namespace {

using test::function_count;

constexpr std::size_t points = 4096;

template <class V>
test::NumberFunctions<V> functions_for([[maybe_unused]] InstructionSet set) {
    const auto pick = [](auto in_double, auto in_float) {
        if constexpr (sizeof(V) == 8)
            return (void)in_float, in_double;
        else
            return (void)in_double, in_float;
    };
#ifdef CORPUSCLE_AVX
    if (set == InstructionSet::avx512) return pick(test::avx512::evaluate_double, test::avx512::evaluate_float);
    if (set == InstructionSet::avx2) return pick(test::avx2::evaluate_double, test::avx2::evaluate_float);
#endif
    return pick(test::baseline::evaluate_double, test::baseline::evaluate_float);
}

/// Numbers of all sizes, and limiting cases.
template <class V>
struct Arguments {
    lanes::AlignedBuffer<V> a{points}, b{points};
    Arguments() {
        const V special[] = {0,
                             -V(0),
                             1,
                             -1,
                             V(0.5),
                             std::numeric_limits<V>::infinity(),
                             -std::numeric_limits<V>::infinity(),
                             std::numeric_limits<V>::quiet_NaN(),
                             700,
                             -700,
                             V(1e-30),
                             V(0.01)};
        for (std::size_t k = 0; k < points; ++k) {
            a.data()[k] = static_cast<V>(20 * normal(1, 0, 0, k)), b.data()[k] = static_cast<V>(normal(1, 1, 0, k));
            if (k < 144) a.data()[k] = special[k / 12], b.data()[k] = special[k % 12];
        }
    }
};

template <class V>
std::vector<lanes::AlignedBuffer<V>> values(InstructionSet set, const Arguments<V>& x) {
    std::vector<lanes::AlignedBuffer<V>> out;
    V* at[function_count];
    for (auto& p : at) p = out.emplace_back(points).data();
    functions_for<V>(set)(x.a.data(), x.b.data(), points, at);
    return out;
}

/// True for the same bits, and for two NaNs.
template <class V>
bool same(V x, V y) {
    return std::memcmp(&x, &y, sizeof x) == 0 || (std::isnan(x) && std::isnan(y));
}

TEST(Lanes, EveryFunctionInDoubleGivesTheSameBitsAsTheScalarFunction) {
    const Arguments<double> x;
    for (const auto set : instruction_sets().subspan(1)) {
        const auto found = values(set, x);
        for (std::size_t k = 0; k < points; ++k)
            test::for_each_function(x.a.data()[k], x.b.data()[k], [&](std::size_t f, double expected) {
                EXPECT_TRUE(same(found[f].data()[k], expected)) << name_of(set) << " function " << f << " of " << x.a.data()[k] << ", "
                                                                << x.b.data()[k] << ": " << found[f].data()[k] << ", not " << expected;
            });
    }
}

TEST(Lanes, EveryFunctionInFloatIsTheSameOnAllInstructionSetsAndNearDouble) {
    const Arguments<float> x;
    const auto expected = values(InstructionSet::baseline, x);
    for (const auto set : instruction_sets().subspan(1)) {
        const auto found = values(set, x);
        for (std::size_t f = 0; f < function_count; ++f)
            for (std::size_t k = 0; k < points; ++k)
                EXPECT_TRUE(same(found[f].data()[k], expected[f].data()[k]))
                    << name_of(set) << " function " << f << " of " << x.a.data()[k] << ", " << x.b.data()[k] << ": " << found[f].data()[k]
                    << ", not " << expected[f].data()[k];
    }
    for (std::size_t k = 144; k < points; ++k)  // without the special values; the relative error of exp grows with its argument
        test::for_each_function<double>(x.a.data()[k], x.b.data()[k], [&](std::size_t f, double y) {
            if (std::abs(x.a.data()[k]) > 80 && f == 0) return;
            const double scale = f == 0 ? std::abs(y) * (1 + std::abs(x.a.data()[k])) : std::abs(y) + 1;
            EXPECT_NEAR(expected[f].data()[k], y, 4e-7 * scale) << "function " << f << " of " << x.a.data()[k] << ", " << x.b.data()[k];
        });
}

TEST(Lanes, CompiledInstructionSetsThatThisProcessorLacksAreNamed) {
    const auto compiled = compiled_instruction_sets(), supported = instruction_sets();
    ASSERT_LE(supported.size(), compiled.size());
    EXPECT_TRUE(std::equal(supported.begin(), supported.end(), compiled.begin()));
    for (const auto set : compiled.subspan(supported.size()))
        std::cout << "this processor lacks " << name_of(set) << ": its lanes are compiled, but not tested here\n";
}

TEST(Lanes, TheEnvironmentVariableSelectsTheInstructionSetOrIsRefused) {
    for (const auto set : instruction_sets()) {
        setenv("CORPUSCLE_ISA", std::string(name_of(set)).c_str(), 1);
        const auto chosen = instruction_set();
        ASSERT_TRUE(static_cast<bool>(chosen));
        EXPECT_EQ(*chosen, set);
    }
    setenv("CORPUSCLE_ISA", "sse9", 1);
    const auto refused = instruction_set();
    unsetenv("CORPUSCLE_ISA");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("CORPUSCLE_ISA=sse9: this machine supports scalar, baseline"), std::string::npos);
    EXPECT_EQ(*instruction_set(), instruction_sets().back());
}

}  // namespace
}  // namespace corpuscle
