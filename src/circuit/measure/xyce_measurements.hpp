#pragma once
// Measurements that Xyce and HSPICE have and ngspice has not: of the cycles of a curve, and of the difference between two curves.

#include "circuit/measure/measurement.hpp"

namespace corpuscle::circuit {

/// The states of a curve over an interval. It is on from where it rises above ON until it falls below OFF.
struct CycleSummary {
    double length = 0;                        // of x inside the interval
    double on = 0;                            // length of the parts in which it is on
    double above = 0, below = 0;              // length of the parts above ON, and of those below OFF
    double times_above = 0, times_below = 0;  // number of these parts, where a part ends only in the opposite state
};

/// The measures duty, freq, on_time and off_time, as in Xyce. The duty is the fraction of x in which the curve is on. The frequency is the
/// number of cycles per x: half of times_above + times_below, over the length. The on-time is the mean length of the parts above ON, and
/// the off-time that of the parts below OFF.
class CycleMeasurement final : public Measurement {
public:
    using Statistic = double (*)(const CycleSummary&);

private:
    enum class State { unknown, on, off } state_ = State::unknown;
    Statistic statistic_;
    CurveFollower curve_;
    Interval interval_;
    double on_, off_;
    CycleSummary summary_;

    void enter(State);

public:
    CycleMeasurement(Statistic statistic, CurveFollower curve, Interval interval, double on, double off)
        : statistic_(statistic), curve_(std::move(curve)), interval_(interval), on_(on), off_(off) {}
    void add_point(double x, const PlotRow&) override;
    void begin_sweep() override { curve_.begin_sweep(), state_ = State::unknown; }
    double value() const override { return summary_.length > 0 ? statistic_(summary_) : not_found; }
};

/// err, err1 and err2 of HSPICE and Xyce. With the differences d = (M - C) / max(minval, |M|) at each point at which |M| is in the interval
/// [ymin, ymax], err and err1 are the root of the mean of d^2, and err2 is the mean of |d|. Points are not weighted by their distance.
class DifferenceMeasurement final : public Measurement {
public:
    struct Settings {
        bool is_absolute = false;  ///< true for err2
        double minval = 1e-12, ymin = 1e-15, ymax = 1e15;
    };

private:
    CurveView measured_, calculated_;
    Interval interval_;
    Settings settings_;
    double sum_ = 0, count_ = 0;

public:
    DifferenceMeasurement(CurveView measured, CurveView calculated, Interval interval, const Settings& settings)
        : measured_(std::move(measured)), calculated_(std::move(calculated)), interval_(interval), settings_(settings) {}
    void add_point(double x, const PlotRow&) override;
    void begin_sweep() override {}  // compares single points
    double value() const override {
        if (count_ == 0) return not_found;
        return settings_.is_absolute ? sum_ / count_ : std::sqrt(sum_ / count_);
    }
};

}  // namespace corpuscle::circuit
