#pragma once
// Terminal currents of a UICM transistor at many voltages, and their derivatives with respect to a parameter of its card.

#include <array>
#include <span>

#include "circuit/device/uicm_constants.hpp"

namespace corpuscle::circuit {

using TerminalVoltages = std::array<double, 4>;  ///< drain, gate, source, bulk

/// Currents into the drain and into the bulk, A; or their derivatives.
struct DrainBulkCurrents {
    double I_D = 0, I_B = 0;
};

/// `out` has an element for each voltage.
void uicm_currents(const UicmConstants&, std::span<const TerminalVoltages>, std::span<DrainBulkCurrents> out);

/// The derivatives along a line on which the constants are `below`, `at` and `above`, where the last is `distance` from the first. The
/// constants are smooth functions of a card's parameters, so their difference gives their derivatives; those of the currents follow by dual
/// numbers.
void uicm_slopes(const UicmConstants& below, const UicmConstants& at, const UicmConstants& above, double distance,
                 std::span<const TerminalVoltages>, std::span<DrainBulkCurrents> out);

}  // namespace corpuscle::circuit
