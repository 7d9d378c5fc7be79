#pragma once
// A value of a configuration file before it is parsed: its text and its location in the file. Also the parameter overrides from the tables
// `set` and `spread` of sweep and population files.

#include "core/parameter_override.hpp"

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

/// The override that one entry of a table means: "adc.bits" has a target of its own, "f_B" is for `default_target`.
inline ParameterOverride located_override(const LocatedSetting& entry, std::string_view default_target) {
    const auto dot = entry.name.rfind('.');
    const bool has_target = dot != std::string::npos;
    ParameterOverride out{has_target ? entry.name.substr(0, dot) : std::string(default_target),
                          has_target ? entry.name.substr(dot + 1) : entry.name, entry.value.text};
    out.typed = out.text(), out.location = entry.value.location;
    return out;
}

}  // namespace corpuscle
