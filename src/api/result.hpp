#pragma once
// From results of the modules to exceptions of the public interface.

#include <array>
#include <utility>

#include "core/parameter_override.hpp"
#include "corpuscle/error.hpp"

namespace corpuscle::api {

[[noreturn]] inline void throw_error(const Error& error) {
    if (error.code == ErrorCode::interrupted) throw InterruptedError(error.text());
    if (error.code == ErrorCode::not_converged) throw NotConvergedError(error.text());
    throw InputError(error.text());
}

/// The value of a result; throws its error.
template <class T>
T value_or_throw(Result<T> result) {
    if (!result) throw_error(result.error());
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// The result of applied overrides; throws if one of them has another target than the thing called `name`.
template <class T>
T result_or_throw(Applied<T> applied, std::string_view name) {
    value_or_throw(check_all_used(applied.unused, std::array{name}));
    return std::move(applied.result);
}

}  // namespace corpuscle::api
