#pragma once
// A value of a configuration file before it is parsed: its text and its location in the file.

#include <optional>
#include <string>

#include "core/error.hpp"

namespace corpuscle {

struct LocatedText {
    std::string text;
    SourceLocation location;

    /// An error at the location of this value.
    Error error_here(std::string message) const { return bad_input(std::move(message), location); }
    /// The same result, but with its error, if it is one, at the location of this value. `context` begins the message.
    template <class T>
    Result<T> located(Result<T> result, const std::string& context = "") const {
        return result ? std::move(result) : Result<T>(error_here(context + result.error().message));
    }
};
using OptionalLocatedText = std::optional<LocatedText>;

/// A named value of a configuration file.
struct LocatedSetting {
    std::string name;  ///< "press.F_max"
    LocatedText value;
};

}  // namespace corpuscle
