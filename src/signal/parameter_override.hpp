#pragma once
// Settings by the user, such as "sa1.f_B=25Hz". The value stays text until the parameter's unit is known.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/parameter.hpp"

namespace corpuscle {

/// A parsed "target.parameter=value".
struct ParameterOverride {
    std::string target;     ///< "sa1", "press"
    std::string parameter;  ///< "f_B"
    std::string value;      ///< "25Hz"
    mutable bool is_used = false;

    std::string text() const { return target + "." + parameter + "=" + value; }
};

/// Splits "sa1.f_B=25Hz". The target is the part before the last dot.
Result<ParameterOverride> parse_override(std::string_view text);

/// The parameter that an override names. An unknown name is an error.
Result<const ParameterInfo*> find_parameter(const ParameterOverride&, std::span<const ParameterInfo> parameters);

/// The overrides with target `name`, as settings in SI, checked against the parameters. Marks them used.
Result<std::vector<Setting>> settings_for(std::string_view name, std::span<const ParameterInfo> parameters,
                                          std::span<const ParameterOverride> overrides);

}  // namespace corpuscle
