#pragma once
// A .meas line's words, from WHAT on, as the gauge that they ask for.

#include <memory>

#include "circuit/measure/gauge.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Of a plot with these curves:
///     find CURVE at=X | find CURVE when EDGE | deriv CURVE at=X | deriv CURVE when EDGE | when EDGE | count EDGE [rise|fall|cross]
///     min|max|pp|min_at|max_at|avg|rms|integ CURVE [from=A] [to=B]
///     trig at=X | trig CURVE val=V ... targ at=X | targ CURVE val=V ...
/// with EDGE: CURVE=VALUE|CURVE [rise=N|last] [fall=N|last] [cross=N|last] [td=T] [from=A] [to=B]. Of an operating point: find CURVE.
Result<std::unique_ptr<Gauge>> gauge_of(const Command&, const Plot& head);

}  // namespace corpuscle::circuit
