#pragma once
// From results of the modules to exceptions of the public interface.

#include <array>
#include <utility>

#include "core/parameter_override.hpp"
#include "corpuscle/error.hpp"

namespace corpuscle::api {

/// The text of an error, and of the further ones that it holds, one a line.
inline std::string complete_text(const Error& error) {
    auto text = error.text();
    if (error.further)
        for (const auto& other : *error.further) text += "\n" + other.text();
    return text;
}

[[noreturn]] inline void throw_error(const Error& error) {
    if (error.code == ErrorCode::interrupted) throw InterruptedError(error.text());
    if (error.code == ErrorCode::not_converged) throw NotConvergedError(complete_text(error));
    throw InputError(complete_text(error));
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
