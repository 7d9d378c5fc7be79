#pragma once
// Parameter settings that the user writes, such as "sa1.f_B=25Hz". The value stays text until the unit of the parameter is known.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameter.hpp"

namespace corpuscle {

/// A parsed "target.parameter=value".
struct ParameterOverride {
    std::string target;     ///< "sa1", "press"
    std::string parameter;  ///< "f_B"
    std::string value;      ///< "25Hz"
    /// True after an afferent or stimulus named `target` was found. Overrides that are not used are reported to the user.
    mutable bool is_used = false;

    std::string text() const { return target + "." + parameter + "=" + value; }
};

/// Splits "sa1.f_B=25Hz". The target is the part before the last dot.
Result<ParameterOverride> parse_override(std::string_view text);

/// The one of `parameters` that an override names. A name that is not among them is an error.
Result<const ParameterInfo*> find_parameter(const ParameterOverride&, std::span<const ParameterInfo> parameters);

/// The values of the overrides with target `name`, in the units of the parameters. Marks these overrides as used. An unknown parameter, a
/// value that cannot be read and a value outside the parameter's range are errors.
Result<std::vector<Setting>> settings_for(std::string_view name, std::span<const ParameterInfo> parameters,
                                          std::span<const ParameterOverride> overrides);

}  // namespace corpuscle
