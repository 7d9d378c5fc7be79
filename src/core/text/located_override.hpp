#pragma once
// Parameter overrides from the tables `set` and `spread` of sweep and population files.

#include "core/parameter_override.hpp"
#include "core/text/located_text.hpp"

namespace corpuscle {

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
