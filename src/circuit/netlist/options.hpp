#pragma once
// .options: the names that are known, and what each takes. Inside circuit/netlist only.

#include <optional>
#include <string_view>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// What is wrong with a name or its value, if anything is. `number` and `word` hold the value as it was read; without both it is a flag.
std::optional<Error> wrong_option(std::string_view name, std::optional<double> number, std::optional<std::string_view> word,
                                  const Place& place);

}  // namespace corpuscle::circuit
