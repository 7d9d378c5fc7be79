#pragma once
// The measured currents against those of a card: weighted residuals and their slopes.

#include "circuit/device/mos/uicm_slopes.hpp"
#include "fit/iv/iv_data.hpp"
#include "fit/transistor/card_parameter.hpp"
#include "fit/transistor/least_squares.hpp"

namespace corpuscle {

/// The standard deviation of a measured current I: sqrt((relative I)^2 + floor^2).
struct CurrentNoise {
    double relative = 0.03, floor = 1e-15;  ///< -, A
    double variance(double I) const { return relative * relative * I * I + floor * floor; }
};

/// A device's deviation from its card.
struct DeviceShift {
    double V_T = 0, log_I_S = 0;  ///< V; of the natural logarithm of I_SQ
};

/// Points of a device at one temperature: they share the constants of the transistor.
struct PointGroup {
    std::uint32_t device = 0;
    double temperature = 27;
    std::vector<std::size_t> points;
    std::vector<circuit::TerminalVoltages> voltages;
};
std::vector<PointGroup> group_points(const IvData&);

/// True if the point tells the current of a junction: its bulk current was measured, and a junction conducts.
bool has_junction_current(const IvData&, const IvPoint&);

class CurveResiduals {
    const IvData& data_;
    std::vector<PointGroup> groups_;
    std::vector<std::vector<std::size_t>> groups_of_device_;
    std::vector<std::size_t> bulk_points_;  // points whose bulk current is fitted
    circuit::UicmInstance instance(std::uint32_t device) const;

public:
    CurrentNoise drain_noise, bulk_noise;
    Vector drain_deviation, bulk_deviation;  ///< standard deviation of each point's currents, A
    std::vector<DeviceShift> shifts;         ///< of each device

    explicit CurveResiduals(const IvData&);
    std::span<const std::size_t> bulk_points() const { return bulk_points_; }
    const std::vector<PointGroup>& groups() const { return groups_; }

    /// The currents of a card at each point.
    std::vector<circuit::DrainBulkCurrents> currents(const circuit::UicmCard&) const;
    /// Sets the standard deviations from the noise and these currents.
    void set_deviations(const std::vector<circuit::DrainBulkCurrents>&);
    /// (measured - computed) / deviation: the drain currents of all points, then the bulk currents of bulk_points().
    SlopedResiduals residuals(const circuit::UicmCard& base, std::span<const CardParameter* const>, const Vector& x,
                              bool with_slopes) const;
    /// The same of the drain currents of one device, along its shift: V_T, then log_I_S.
    SlopedResiduals device_residuals(const circuit::UicmCard&, std::uint32_t device, const Vector& shift, bool with_slopes) const;
};

}  // namespace corpuscle
