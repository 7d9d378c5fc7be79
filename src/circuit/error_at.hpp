#pragma once

#include <fmt/format.h>

#include "core/error.hpp"

namespace corpuscle::circuit {

/// The error for bad input at a location in a netlist. The message is formatted as by fmt::format().
template <class... Arguments>
Error error_at(SourceLocation location, fmt::format_string<Arguments...> message, Arguments&&... arguments) {
    return bad_input(fmt::format(message, std::forward<Arguments>(arguments)...), std::move(location));
}

}  // namespace corpuscle::circuit
