#pragma once
// Moves the value of a result into a variable that exists already, such as a member.

#include <utility>

#include "core/error.hpp"

namespace corpuscle {

/// Returns the error of `from` if it has no value; `to` is then unchanged.
template <class To, class From>
Result<void> assign(To& to, Result<From> from) {
    if (!from) return from.error();
    to = std::move(*from);
    return {};
}

}  // namespace corpuscle
