#pragma once
// Where power comes from and where it goes.

#include <string>
#include <utility>
#include <vector>

#include "circuit/points.hpp"
#include "circuit/solve/system.hpp"
#include "signal/source.hpp"

namespace corpuscle::circuit {

/// The parts of a circuit: what stands in the same subcircuit of the top level ("ccvs", of xccvs), ideal current sources of the top level
/// ("ideal currents") and whatever else stands there ("top level").
struct Blocks {
    std::vector<std::string> names;
    std::vector<std::size_t> of;  ///< each element's
    explicit Blocks(const Circuit&);
};

/// W. Sources deliver, blocks turn into heat; what is left over goes into capacitors or comes from them, and is none on the whole.
struct Powers {
    double supplies = 0;                  ///< what all sources deliver
    double sensor = 0;                    ///< the supply's part of that for the current through the sensor: see PowerMeter
    double own = 0;                       ///< the rest
    std::vector<double> sources, blocks;  ///< of each, in the meter's order
};

/// Tells power at any point that was solved. It counts as a source what is independent and a voltage, or carries force, or delivers at the
/// operating point; a current source that does not stands for the transistor that would take its place, and heats its block.
/// The sensor is any current by a formula that reads a node of a FORCE source; its current, at the voltage of the source that delivers
/// most, is the sensor's power, wherever between the two rails it is lost.
class PowerMeter {
    const System& system_;
    double gmin_;
    Blocks blocks_;
    std::vector<std::size_t> sources_, sensors_;  // devices
    std::vector<int> role_;                       // of each device: its source's number, or -1 - its block's
    double supply_ = 0;
    mutable std::vector<double> v_, f_, q_, df_, dq_;

    double current(std::size_t device, std::span<const double> x, double t, double& power) const;

public:
    /// At its operating point x.
    PowerMeter(const System&, std::span<const double> x, double gmin);

    Powers at(std::span<const double> x, double t = 0) const;
    /// Of that what sources deliver, and of that what is the sensor's, W: for a look at every step.
    struct Delivered {
        double supplies = 0, sensor = 0;
    };
    Delivered delivered(std::span<const double> x, double t) const;
    const Blocks& blocks() const { return blocks_; }
    std::vector<std::string> sources() const;
    double supply() const { return supply_; }  ///< V: of the source that delivers most
    bool has_sensor() const { return !sensors_.empty(); }
};

/// Power over a transient: its points in, mean and peak of each part out; of the whole, and of the phases of its force.
class PowerOverTime final : public PointSink {
    const PowerMeter& meter_;
    std::vector<Phase> phases_;
    std::vector<Powers> sums_;  // J; the first of the whole
    std::vector<double> times_;
    Powers peak_, before_;
    double t_ = 0;
    bool begun_ = false;

public:
    PowerOverTime(const PowerMeter& meter, std::vector<Phase> phases) : meter_(meter), phases_(std::move(phases)) {}
    Result<void> begin(const Plot&) override;
    Result<void> point(std::span<const double> row) override;
    Result<void> end() override { return {}; }

    /// "mean", "peak", then each phase by its name; nothing if there was no transient.
    std::vector<std::pair<std::string, Powers>> told() const;
};

}  // namespace corpuscle::circuit
