#pragma once
// A found design as a netlist: the text of the netlist with all files that it includes, and .set lines with the values of the design. Only
// libraries with sections (.lib 'file' section) stay files of their own, so that the corner can still be chosen.

#include "optimize/problem.hpp"

namespace corpuscle::optimize {

/// The text for a file in this folder, with the values of the first condition. `comment`: lines for the head of the file.
Result<std::string> found_netlist(const OptimizationProblem&, std::span<const double> design, const std::string& folder,
                                  std::span<const std::string> comment);

/// True for a file that begins like one of found_netlist().
bool is_found_netlist(std::string_view beginning);

}  // namespace corpuscle::optimize
