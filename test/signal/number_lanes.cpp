// Compiled once for each instruction set.

#include "signal/number_lanes.hpp"

#include "signal/elementary.hpp"
#include "signal/number_functions.hpp"

namespace corpuscle::test::CORPUSCLE_ISA {

template <class V>
static void all(const V* a, const V* b, std::size_t count, V* const (&out)[functions]) {
    using T = num::Lanes<V>;
    for (std::size_t k = 0; k < count; k += T::size)
        each_function(T::load_aligned(a + k), T::load_aligned(b + k), [&](std::size_t f, T y) { y.store_aligned(out[f] + k); });
}

void in_double(const double* a, const double* b, std::size_t count, double* const (&out)[functions]) { all(a, b, count, out); }
void in_float(const float* a, const float* b, std::size_t count, float* const (&out)[functions]) { all(a, b, count, out); }

}  // namespace corpuscle::test::CORPUSCLE_ISA
