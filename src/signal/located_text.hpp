#pragma once
// An uninterpreted configuration value: its text and its location in the file.

#include <optional>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

struct LocatedText {
    std::string text;
    SourceLocation location;

    /// An error at this location.
    Error error_here(std::string message) const { return bad_input(std::move(message), location); }
};
using OptionalLocatedText = std::optional<LocatedText>;

/// A setting of a configuration file.
struct LocatedSetting {
    std::string name;  ///< "press.F_max"
    LocatedText value;
};

}  // namespace corpuscle
