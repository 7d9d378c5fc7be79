#pragma once
// The error type, and a result type that holds a value or an error. The library prints nothing and never ends the process.

#include <string>
#include <utility>
#include <variant>

namespace corpuscle {

/// Kinds of error. The numbers are the exit statuses of the program.
enum class ErrorCode { bad_input = 1, bad_usage = 2, not_converged = 3, interrupted = 130 };

/// A location in a text file.
struct SourceLocation {
    std::string file;
    long line = 0;    ///< 1-based; 0: unknown
    long column = 0;  ///< 1-based, in bytes; 0: unknown
};

struct Error {
    ErrorCode code = ErrorCode::bad_input;
    std::string message;  ///< states what is wrong, its value, and what is expected
    SourceLocation location = {};

    /// "file:line:column: message", without the unknown parts of the location.
    std::string text() const;
};

inline Error bad_input(std::string message, SourceLocation location = {}) {
    return {ErrorCode::bad_input, std::move(message), std::move(location)};
}
inline Error bad_usage(std::string message) { return {ErrorCode::bad_usage, std::move(message)}; }

/// A value, or the error that prevented it. Check with `if (result)` first: * and -> require a value, error() requires an error.
template <class T>
class [[nodiscard]] Result {
    std::variant<T, Error> value_or_error_;

public:
    Result(T value) : value_or_error_(std::move(value)) {}
    Result(Error error) : value_or_error_(std::move(error)) {}
    explicit operator bool() const { return value_or_error_.index() == 0; }
    T& operator*() & { return std::get<0>(value_or_error_); }
    T&& operator*() && { return std::get<0>(std::move(value_or_error_)); }
    const T& operator*() const& { return std::get<0>(value_or_error_); }
    T* operator->() { return &std::get<0>(value_or_error_); }
    const T* operator->() const { return &std::get<0>(value_or_error_); }
    const Error& error() const { return std::get<1>(value_or_error_); }
};

/// Success without a value, or the error.
template <>
class [[nodiscard]] Result<void> {
    std::variant<std::monostate, Error> value_or_error_;

public:
    Result() = default;
    Result(Error error) : value_or_error_(std::move(error)) {}
    explicit operator bool() const { return value_or_error_.index() == 0; }
    const Error& error() const { return std::get<1>(value_or_error_); }
};

/// The value of a result that holds one; for TRY.
template <class T>
T value_of(Result<T>&& result) {
    return *std::move(result);
}
inline void value_of(Result<void>&&) {}

}  // namespace corpuscle

/// TRY(call) is the value of the Result that the call returns. If it holds an error, TRY returns this error from the surrounding function.
/// Write it as a statement, as the value of a variable or an assignment, or as the only argument of a call:
/// `const auto plan = TRY(read_plan(text));`, `files.push_back(TRY(open(path)));`
#define TRY(...) CORPUSCLE_TRY_NUMBERED(__COUNTER__, __VA_ARGS__)
#define CORPUSCLE_TRY_NUMBERED(number, ...) CORPUSCLE_TRY_NAMED(number, __VA_ARGS__)
#define CORPUSCLE_TRY_NAMED(number, ...)                    \
    __extension__({                                         \
        auto tried_##number = (__VA_ARGS__);                \
        if (!tried_##number) return tried_##number.error(); \
        ::corpuscle::value_of(std::move(tried_##number));   \
    })
