#pragma once
// The functions that number_lanes.hpp evaluates on arrays, for one pair of numbers of any type. Include elementary.hpp first.

namespace corpuscle::test {

/// Calls put(index, value) with each function of a and b; there are function_count of them.
template <class T, class Put>
void for_each_function(T a, T b, const Put& put) {
    std::size_t f = 0;
    for (const T y : {num::exp(a), num::log(num::abs(a) + T(1e-3)), num::sin_turns(b), num::cos_turns(b), num::sqrt(num::abs(a)),
                      num::exprel(b), num::max(a, b), num::min(a, b), num::max(b, a), num::min(b, a), num::positive_part(b),
                      num::nearest(a), num::abs(b), num::select(a < b, a * b, a / (num::abs(b) + T(1.0))), -b})
        put(f++, y);
}

}  // namespace corpuscle::test
