#pragma once
// Mismatch between devices: Pelgrom's coefficients from each device's deviation from the card.

#include "fit/transistor/curve_residuals.hpp"

namespace corpuscle {

/// A coefficient A: deviations have the standard deviation A / sqrt(W L).
struct PelgromCoefficient {
    double value = 0, low = 0, high = 0;  ///< with its 95 % interval
    double mean = 0;                      ///< weighted mean of the deviations
    double mean_half_width = 0;           ///< of its 95 % interval, from mismatch alone
};

/// From the deviation of each device, the standard error of each, and the gate areas, m^2. The errors are subtracted.
PelgromCoefficient pelgrom_coefficient(const Vector& deviations, const Vector& errors, const Vector& areas);

struct DeviceDeviations {
    Vector V_T, log_I_S;              ///< of each device
    Vector V_T_error, log_I_S_error;  ///< standard errors
};
/// Fits each device's deviation from the card.
DeviceDeviations fit_deviations(const CurveResiduals&, const circuit::UicmCard&, std::size_t devices);

}  // namespace corpuscle
