#pragma once
// Currents of devices as additional curves of a plot, for .save and --probe: i(x1.m1).

#include "circuit/saved_quantities.hpp"

namespace corpuscle::circuit {

/// The device currents among some saved quantities. The system must outlive it.
class DeviceCurrents {
    const System& system_;
    std::vector<SavedQuantity> currents_;
    std::vector<double> row_;

    bool has_all_unknowns(const Plot&) const;

public:
    DeviceCurrents(const System&, std::span<const SavedQuantity>);
    bool has_any() const { return !currents_.empty(); }
    /// Appends the curves, without values, to a plot without values. Its first curve must be the swept quantity, followed by all unknowns.
    void extend_head(Plot& head) const;
    /// Returns the point with the currents appended; valid until the next call.
    std::span<const double> extend_point(std::span<const double> row);
    /// Appends the curves to a complete plot. Returns false if the plot is complex, lacks an unknown, or is swept over temperature.
    bool extend_plot(Plot&) const;
};

}  // namespace corpuscle::circuit
