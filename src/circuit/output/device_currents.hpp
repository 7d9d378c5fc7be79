#pragma once
// Currents of devices as additional curves of a plot, for .save and --probe: i(x1.m1).

#include "circuit/output/saved_quantities.hpp"

namespace corpuscle::circuit {

/// Computes those of the saved quantities that are device currents. The system must outlive it.
class DeviceCurrents {
    const System& system_;
    std::vector<SavedQuantity> currents_;
    std::vector<double> row_;

    bool has_all_unknowns(const Plot&) const;

public:
    DeviceCurrents(const System&, std::span<const SavedQuantity>);
    bool has_any() const { return !currents_.empty(); }
    /// Appends a curve for each current to a plot without values.
    void extend_head(Plot& head) const;
    /// Returns a point of the plot with the currents appended. `row` is the swept quantity, then all unknowns. The span is valid until the
    /// next call.
    std::span<const double> extend_point(std::span<const double> row);
    /// Appends the currents to a complete plot. Returns false if they cannot be computed, because the plot is complex, is swept over
    /// temperature, or has other curves than the unknowns.
    bool extend_plot(Plot&) const;
};

}  // namespace corpuscle::circuit
