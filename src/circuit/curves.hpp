#pragma once
// Curves by the names that netlists give them: v(a,b), vdb(out), vp(out), i(v1).

#include <optional>
#include <string_view>

#include "circuit/plot.hpp"

namespace corpuscle::circuit {

/// The values along a plot of what is named: a curve, v(a,b), or a view of a complex one: vm (magnitude), vdb, vp (phase, radians, as
/// ngspice has it), vr, vi, and the same of currents: im, idb, ip ...
std::optional<std::vector<std::complex<double>>> values_of(const Plot&, std::string_view name);

}  // namespace corpuscle::circuit
