#pragma once
// Checks .options: known names and their values. Used inside circuit/netlist only.

#include <optional>
#include <string_view>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Returns an error if the name of an option or its value is invalid. The value is `number` or `word`; an option without both is a flag.
Result<void> check_option(std::string_view name, std::optional<double> number, std::optional<std::string_view> word,
                          const SourceLocation& location);

}  // namespace corpuscle::circuit
