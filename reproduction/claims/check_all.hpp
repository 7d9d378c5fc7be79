#pragma once
// One check of several results.

#include "core/error.hpp"

namespace corpuscle {

/// Success if all of these results succeeded; otherwise the first error.
template <class... T>
Result<void> check_all(const Result<T>&... results) {
    Result<void> out;
    ((out && !results ? void(out = results.error()) : void()), ...);
    return out;
}

}  // namespace corpuscle
