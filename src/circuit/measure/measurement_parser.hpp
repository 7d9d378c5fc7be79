#pragma once
// Parses a .meas line into a measurement.

#include <memory>

#include "circuit/measure/measurement.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Parses the words of a .meas line that follow NAME, for a plot with the curves of `head`, which needs no values:
///
///     find CURVE at=X | find CURVE when EDGE | deriv CURVE at=X | deriv CURVE when EDGE | when EDGE | count EDGE [rise|fall|cross]
///
///     min|max|pp|min_at|max_at|avg|rms|integ CURVE [from=A] [to=B]
///
///     trig POSITION targ POSITION
///
/// EDGE is CURVE=VALUE or CURVE=CURVE, then SELECTION: [rise=N|last] [fall=N|last] [cross=N|last] [td=T] [from=A] [to=B]. POSITION is at=X,
/// CURVE val=V SELECTION, or EDGE. For an operating point, only `find CURVE` is possible.
Result<std::unique_ptr<Measurement>> parse_measurement(const Directive&, const Plot& head);

}  // namespace corpuscle::circuit
