#pragma once
// Parameter settings that the user writes, such as "sa1.f_B=25Hz". The value stays text until the unit of the parameter is known.
//
// Every function that takes overrides applies those whose target it is, and returns the others beside its result (Applied). The caller
// keeps those that nothing has used, and at the end check_all_used() reports them.

#include <functional>

#include "core/parameter.hpp"

namespace corpuscle {

/// A parsed "target.parameter=value".
struct ParameterOverride {
    std::string target;            ///< "sa1", "press", "contact", "sa1-circuit"; "": every netlist of the run, as with --temp
    std::string parameter;         ///< "f_B"; of a netlist also the path of a device, "summer.N3B.w"
    std::string value;             ///< "25Hz"
    std::string typed = {};        ///< as the user wrote it, for messages: "--set sa1.f_B=25Hz"
    SourceLocation location = {};  ///< where it is written, if in a sweep or population file

    std::string name() const { return target + "." + parameter; }
    std::string text() const { return name() + "=" + value; }
    bool operator==(const ParameterOverride&) const;
};

/// A result with the overrides that are for it, and the overrides that have another target.
template <class T>
struct Applied {
    T result;
    std::vector<ParameterOverride> unused;
};

/// Splits "sa1.f_B=25Hz". The target is the part before the last dot. `option`: the option of the command line that has this text, "--set".
Result<ParameterOverride> parse_override(std::string_view text, std::string_view option = "");
Result<std::vector<ParameterOverride>> parse_overrides(std::span<const std::string> texts, std::string_view option = "");

/// The one of `parameters` that an override names. A name that is not among them is an error.
Result<const ParameterInfo*> find_parameter(const ParameterOverride&, std::span<const ParameterInfo> parameters);

/// The overrides whose target is_target() accepts, in their order.
using IsTarget = std::function<bool(std::string_view target)>;
Applied<std::vector<ParameterOverride>> select_overrides(std::span<const ParameterOverride>, const IsTarget& is_target);

/// The value of one override in the unit of its parameter. An unknown parameter, a value that cannot be read and a value outside the
/// parameter's range are errors, with the override's location.
Result<Setting> setting_of(const ParameterOverride&, std::span<const ParameterInfo> parameters);

/// The values that the overrides with the target `name` give to `parameters`; see setting_of().
Result<Applied<std::vector<Setting>>> settings_for(std::string_view name, std::span<const ParameterInfo> parameters,
                                                   std::span<const ParameterOverride> overrides);

/// Removes from `unused` the overrides that are not in `still_unused`: those that one more part of the run has used.
void keep_unused(std::vector<ParameterOverride>& unused, std::span<const ParameterOverride> still_unused);

/// The error that an override has no target in this run, with a similar name among `targets`; success if `unused` is empty.
Result<void> check_all_used(std::span<const ParameterOverride> unused, std::span<const std::string_view> targets);

}  // namespace corpuscle
