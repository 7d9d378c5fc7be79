#pragma once
// Power delivered by sources and dissipated in blocks.

#include "circuit/output/point_sink.hpp"
#include "circuit/solve/system.hpp"
#include "core/afferent.hpp"
#include "core/force_source.hpp"

namespace corpuscle::circuit {

/// The blocks of a circuit. Each subcircuit of the top level is one ("ccvs" for xccvs). The ideal current sources of the top level form
/// another ("ideal currents"). All other elements of the top level form one more ("top level").
struct Blocks {
    std::vector<std::string> names;
    std::vector<std::size_t> block_of_element;  ///< index of the block of each element
    explicit Blocks(const Circuit&);
    /// The block of a node: its subcircuit of the top level, or "top level".
    static std::string name_of_node(std::string_view node);
};

/// Powers in W. Sources deliver power and blocks dissipate it. The difference charges capacitors; it averages to zero.
struct PowerBreakdown {
    double supplies = 0;                  ///< delivered by all sources
    double sensor = 0;                    ///< the part of `supplies` for the current through the sensor; see PowerMeter
    double without_sensor = 0;            ///< the rest of `supplies`
    std::vector<double> sources, blocks;  ///< by index in PowerMeter::sources() and in PowerMeter::blocks().names
};

/// Computes power at a solution of the circuit. Sources are independent voltage sources, FORCE sources, and current sources that deliver
/// power at the operating point. Any other current source represents the transistor that would replace it; its power is dissipated in its
/// block. A sensor is a current source with an expression that reads a node of a FORCE source. The sensor's power is its current times the
/// voltage of the source that delivers most, although a part of this power is dissipated in other elements.
class PowerMeter {
    const System& system_;
    double gmin_;  // S
    Blocks blocks_;
    std::vector<std::size_t> sources_, sensors_;  // indices of devices
    std::vector<int> role_;                       // by device: its index in sources_, or -1 - the index of its block
    double supply_ = 0;                           // V
    mutable std::vector<double> v_;               // buffers of current()
    mutable StampBuffer stamp_;

    double current(std::size_t device, std::span<const double> x, double t, double& power) const;

public:
    /// x is the operating point; gmin is in S.
    PowerMeter(const System&, std::span<const double> x, double gmin);

    /// The power at the solution x and time t, s.
    PowerBreakdown power_at(std::span<const double> x, double t = 0) const;
    /// Only the power of the sources and of the sensor, W; cheap enough for every time step.
    struct DeliveredPower {
        double supplies = 0, sensor = 0;
    };
    DeliveredPower delivered_at(std::span<const double> x, double t) const;
    const Blocks& blocks() const { return blocks_; }
    std::vector<std::string> sources() const;  ///< names of the sources
    /// The current into the first terminal of each source, A.
    std::vector<double> source_currents(std::span<const double> x, double t) const;
    /// The current (A) into the first terminal of a device that is not a source, and the index of its block.
    struct DeviceCurrent {
        std::string name;
        std::size_t block = 0;
        double current = 0;
    };
    std::vector<DeviceCurrent> device_currents(std::span<const double> x, double t) const;
    double supply() const { return supply_; }  ///< V: voltage of the voltage source that delivers the most power at the operating point
    bool has_sensor() const { return !sensors_.empty(); }
};

/// Sums the energy of the steps of a transient, by the trapezoidal rule for the power.
struct EnergyCounter {
    std::optional<PowerMeter::DeliveredPower> power{};  ///< at the end of the last step; empty until evaluated
    EnergyUse sum{};

    /// Adds a step from t0 to t, s; x is the solution at its end.
    void add(const PowerMeter& meter, std::span<const double> x, double t0, double t) {
        const double half = (t - t0) / 2;
        const auto before = *std::exchange(power, meter.delivered_at(x, t));
        sum += {t - t0, half * (before.supplies + power->supplies), half * (before.sensor + power->sensor)};
    }
};

/// Mean and peak power over a transient, and the mean in each phase of its force.
class PowerOverTime final : public PointSink {
    const PowerMeter& meter_;
    std::vector<Phase> phases_;
    // The first element is of the complete transient; the others are of the phases.
    std::vector<PowerBreakdown> sums_;  // J
    std::vector<double> times_;         // s
    PowerBreakdown peak_;               // largest value of each number
    PowerBreakdown previous_;           // at the previous point
    double t_ = 0;                      // s: time of the previous point
    bool has_points_ = false;

public:
    PowerOverTime(const PowerMeter& meter, std::vector<Phase> phases) : meter_(meter), phases_(std::move(phases)) {}
    Result<void> begin(const Plot&) override;
    Result<void> add_point(const PlotRow& row) override;

    /// "mean", "peak" (the largest value of each number), then the mean in each phase by its name; empty if there was no transient.
    std::vector<std::pair<std::string, PowerBreakdown>> averages() const;
};

}  // namespace corpuscle::circuit
