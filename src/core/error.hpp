#pragma once
// The error type, and a result type that holds a value or an error. The library prints nothing and never ends the process.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
    ErrorCode code;
    std::string message;  ///< states what is wrong, its value, and what is expected
    SourceLocation location;
    std::shared_ptr<const std::vector<Error>> further;  ///< more errors of the same input, less important than this one; null if none

    Error(ErrorCode code = ErrorCode::bad_input, std::string message = "", SourceLocation location = {});
    // Not defined here: each TRY would contain the copying of two strings.
    Error(const Error&);
    Error(Error&&) noexcept;
    Error& operator=(const Error&);
    Error& operator=(Error&&) noexcept;
    ~Error();

    /// "file:line:column: message", without the unknown parts of the location.
    std::string text() const;
};

Error bad_input(std::string message, SourceLocation location = {});
Error bad_usage(std::string message);
Error interrupted_error();  ///< of work that the user, or a caller, has stopped

/// A value, or the error that prevented it. Check with `if (result)` first: * and -> require a value, error() requires an error.
/// Not a std::variant: that takes the compiler twice as long for each type of value, of which there are hundreds.
template <class T>
class [[nodiscard]] Result {
    union {
        T value_;
        Error error_;
    };
    bool has_value_;

    template <class Other>
    void take(Other&& other) {
        if (has_value_)
            std::construct_at(&value_, std::forward<Other>(other).value_);
        else
            std::construct_at(&error_, std::forward<Other>(other).error_);
    }

public:
    Result(T value) : value_(std::move(value)), has_value_(true) {}
    Result(Error error) : error_(std::move(error)), has_value_(false) {}
    Result(Result&& other) noexcept : has_value_(other.has_value_) { take(std::move(other)); }
    Result(const Result& other) : has_value_(other.has_value_) { take(other); }
    Result& operator=(Result other) noexcept {
        std::destroy_at(this);
        return *std::construct_at(this, std::move(other));
    }
    ~Result() {
        if (has_value_)
            value_.~T();
        else
            error_.~Error();
    }
    explicit operator bool() const { return has_value_; }
    T& operator*() & { return value_; }
    T&& operator*() && { return std::move(value_); }
    const T& operator*() const& { return value_; }
    T* operator->() { return &value_; }
    const T* operator->() const { return &value_; }
    const Error& error() const { return error_; }
};

/// Success without a value, or the error.
template <>
class [[nodiscard]] Result<void> {
    std::optional<Error> error_;

public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}
    explicit operator bool() const { return !error_; }
    const Error& error() const { return *error_; }
};

/// The value of a result that holds one; for TRY.
template <class T>
T value_of(Result<T>&& result) {
    return *std::move(result);
}
inline void value_of(Result<void>&&) {}

}  // namespace corpuscle

/// TRY(call) is the value of the Result that the call returns. If it holds an error, TRY returns this error from the surrounding function.
/// Write it as a statement, as a condition, as the value of a variable or an assignment, or as the only argument of a call:
/// `const auto plan = TRY(read_plan(text));`, `files.push_back(TRY(open(path)));`
#define TRY(...) CORPUSCLE_TRY_NUMBERED(__COUNTER__, __VA_ARGS__)
#define CORPUSCLE_TRY_NUMBERED(number, ...) CORPUSCLE_TRY_NAMED(number, __VA_ARGS__)
#define CORPUSCLE_TRY_NAMED(number, ...)                    \
    __extension__({                                         \
        auto tried_##number = (__VA_ARGS__);                \
        if (!tried_##number) return tried_##number.error(); \
        ::corpuscle::value_of(std::move(tried_##number));   \
    })
