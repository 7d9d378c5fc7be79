#pragma once

#include <cstdlib>

namespace corpuscle::fuzz {

/// Ends the fuzzer with a failure unless the condition holds.
inline void require(bool holds) {
    if (!holds) std::abort();
}

}  // namespace corpuscle::fuzz
