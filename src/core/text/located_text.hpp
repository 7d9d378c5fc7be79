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
};
using OptionalLocatedText = std::optional<LocatedText>;

/// A named value of a configuration file.
struct LocatedSetting {
    std::string name;  ///< "press.F_max"
    LocatedText value;
};

}  // namespace corpuscle
