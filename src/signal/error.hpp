#pragma once
// One kind of error, and a result that holds a value or an error. The library prints nothing and never ends the process.

#include <string>
#include <utility>
#include <variant>

namespace corpuscle {

/// The numbers are the program's exit status.
enum class Code { bad_input = 1, bad_usage = 2, not_converged = 3, interrupted = 130 };

struct Place {
    std::string file;
    long line = 0;    ///< 1-based; 0: no line
    long column = 0;  ///< 1-based, in bytes; 0: no column
};

struct Error {
    Code code = Code::bad_input;
    std::string sentence;  ///< names the thing, the value and what would be right
    Place place = {};

    /// "file:line:column: sentence", as compilers write it.
    std::string text() const;
};

inline Error bad_input(std::string sentence, Place place = {}) { return {Code::bad_input, std::move(sentence), std::move(place)}; }
inline Error bad_usage(std::string sentence) { return {Code::bad_usage, std::move(sentence)}; }

/// A value or the error that stood in its way.
template <class T>
class [[nodiscard]] Result {
    std::variant<T, Error> held_;

public:
    Result(T value) : held_(std::move(value)) {}
    Result(Error error) : held_(std::move(error)) {}
    explicit operator bool() const { return held_.index() == 0; }
    T& operator*() & { return std::get<0>(held_); }
    T&& operator*() && { return std::get<0>(std::move(held_)); }
    const T& operator*() const& { return std::get<0>(held_); }
    T* operator->() { return &std::get<0>(held_); }
    const T* operator->() const { return &std::get<0>(held_); }
    const Error& error() const { return std::get<1>(held_); }
};

/// Success without a value, or the error.
template <>
class [[nodiscard]] Result<void> {
    std::variant<std::monostate, Error> held_;

public:
    Result() = default;
    Result(Error error) : held_(std::move(error)) {}
    explicit operator bool() const { return held_.index() == 0; }
    const Error& error() const { return std::get<1>(held_); }
};

}  // namespace corpuscle
