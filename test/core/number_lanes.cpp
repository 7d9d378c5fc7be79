// Compiled once for each instruction set.

#include "core/number_lanes.hpp"

#include "core/number/elementary.hpp"
#include "core/number_functions.hpp"

namespace corpuscle::test::CORPUSCLE_ISA {

template <class V>
static void evaluate(const V* a, const V* b, std::size_t count, V* const (&out)[function_count]) {
    using T = num::Lanes<V>;
    for (std::size_t k = 0; k < count; k += T::size)
        for_each_function(T::load_aligned(a + k), T::load_aligned(b + k), [&](std::size_t f, T y) { y.store_aligned(out[f] + k); });
}

void evaluate_double(const double* a, const double* b, std::size_t count, double* const (&out)[function_count]) {
    evaluate(a, b, count, out);
}
void evaluate_float(const float* a, const float* b, std::size_t count, float* const (&out)[function_count]) { evaluate(a, b, count, out); }

}  // namespace corpuscle::test::CORPUSCLE_ISA
