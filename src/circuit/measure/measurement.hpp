#pragma once
// Measurements for .meas: each computes one number from curves, point by point and in constant memory.

#include <limits>
#include <optional>

#include "circuit/measure/line_segment.hpp"
#include "circuit/output/curve_view.hpp"

namespace corpuscle::circuit {

inline constexpr double not_found = std::numeric_limits<double>::quiet_NaN();
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A measurement of one number. Derived classes are below.
class Measurement {
public:
    virtual ~Measurement() = default;
    /// The next point of the plot; x is the swept quantity.
    virtual void add_point(double x, const PlotRow&) = 0;
    /// The result after the last point; NaN if nothing was found.
    virtual double value() const = 0;
};

/// An interval of the swept quantity.
struct Interval {
    double from = -unbounded, to = unbounded;
    bool contains(double x) const { return from <= x && x <= to; }
};

/// Follows a curve, or a curve minus another curve or a level, point by point.
class CurveFollower {
    CurveView curve_;
    std::optional<CurveView> other_;
    double level_ = 0;
    std::optional<LineSegment> segment_;  // the newest segment; after the first point a segment of length 0

public:
    explicit CurveFollower(CurveView curve) : curve_(curve) {}
    CurveFollower(CurveView curve, double level) : curve_(curve), level_(level) {}
    CurveFollower(CurveView curve, CurveView other) : curve_(curve), other_(other) {}

    const std::optional<LineSegment>& segment() const { return segment_; }
    /// Returns false at the first point, which does not complete a segment.
    bool add_point(double x, const PlotRow& row) {
        const double y = curve_.measured_value(row) - (other_ ? other_->measured_value(row) : level_);
        const bool first = !segment_;
        segment_ = first ? LineSegment{x, y, x, y} : LineSegment{segment_->x1, segment_->y1, x, y};
        return !first;
    }
};

/// Selects some zero crossings of a curve.
struct EdgeSelection {
    enum class Kind { rise, fall, cross } kind = Kind::cross;
    double number = 1;  ///< of the crossing among those that count: 1 is the first; 0 is the last
    Interval interval;  ///< only crossings in this interval count
};

/// Counts the zero crossings of a CurveFollower that count for the selection, and keeps the position of the selected one.
class CrossingCounter {
    CurveFollower follower_;
    EdgeSelection edges_;
    double count_ = 0;             // crossings so far
    double position_ = not_found;  // x of the selected one

public:
    CrossingCounter(CurveFollower follower, EdgeSelection edges) : follower_(std::move(follower)), edges_(edges) {}
    /// Returns true if the newest segment has the selected crossing. If the last crossing is selected, returns true at every crossing.
    bool add_point(double x, const PlotRow&);
    double count() const { return count_; }
    double position() const { return position_; }  ///< x of the selected crossing; NaN if it was not found yet
};

/// A position x: that of at=X, or that of a crossing.
struct EventPoint {
    double at = not_found;
    std::optional<CrossingCounter> crossing;  ///< if set, replaces `at`

    /// Returns true if the newest segment has the crossing.
    bool add_point(double x, const PlotRow& row) { return crossing && crossing->add_point(x, row); }
    double position() const { return crossing ? crossing->position() : at; }
};

/// when ...: the position of a crossing.
class PositionMeasurement final : public Measurement {
    EventPoint event_;

public:
    explicit PositionMeasurement(EventPoint event) : event_(std::move(event)) {}
    void add_point(double x, const PlotRow& row) override { event_.add_point(x, row); }
    double value() const override { return event_.position(); }
};

/// trig ... targ ...: the distance from the first position to the second.
class DistanceMeasurement final : public Measurement {
    EventPoint trigger_, target_;

public:
    DistanceMeasurement(EventPoint trigger, EventPoint target) : trigger_(std::move(trigger)), target_(std::move(target)) {}
    void add_point(double x, const PlotRow& row) override { trigger_.add_point(x, row), target_.add_point(x, row); }
    double value() const override { return target_.position() - trigger_.position(); }
};

/// count ...: the number of crossings.
class CountMeasurement final : public Measurement {
    CrossingCounter crossings_;

public:
    explicit CountMeasurement(CrossingCounter crossings) : crossings_(std::move(crossings)) {}
    void add_point(double x, const PlotRow& row) override { crossings_.add_point(x, row); }
    double value() const override { return crossings_.count(); }
};

/// find and deriv: the value or the slope of a curve at a position.
class ValueMeasurement final : public Measurement {
    CurveFollower curve_;
    bool is_slope_;  // true for deriv
    EventPoint event_;
    std::optional<LineSegment> first_segment_;
    double value_ = not_found;

    double value_in(const LineSegment& segment, double x) const { return is_slope_ ? segment.slope() : segment.at(x); }

public:
    ValueMeasurement(CurveFollower curve, bool is_slope, EventPoint event)
        : curve_(std::move(curve)), is_slope_(is_slope), event_(std::move(event)) {}
    void add_point(double x, const PlotRow&) override;
    double value() const override;
};

/// min max pp avg rms integ min_at max_at of a curve over an interval. pp is max - min; min_at and max_at are positions x.
class SummaryMeasurement final : public Measurement {
public:
    enum class Statistic { min, max, pp, min_at, max_at, avg, rms, integ };

private:
    Statistic statistic_;
    CurveFollower curve_;
    Interval interval_;
    bool any_ = false;                 // true if a point of the curve was in the interval
    double low_ = 0, high_ = 0;        // minimum and maximum so far
    double low_at_ = 0, high_at_ = 0;  // x of these
    double length_ = 0;                // of x inside the interval
    double area_ = 0;                  // integral over |dx|
    double integral_ = 0;              // integral over dx
    double squares_ = 0;               // integral of the square over |dx|
    double first_value_ = 0;           // first value in the interval, the result of avg and rms if length_ is 0

    void update_extremes(double x, double y);

public:
    SummaryMeasurement(Statistic statistic, CurveFollower curve, Interval interval)
        : statistic_(statistic), curve_(std::move(curve)), interval_(interval) {}
    void add_point(double x, const PlotRow&) override;
    double value() const override;
};

/// The value of a curve at an operating point, which has no sweep.
class OperatingPointMeasurement final : public Measurement {
    CurveView curve_;
    double value_ = not_found;

public:
    explicit OperatingPointMeasurement(CurveView curve) : curve_(curve) {}
    void add_point(double, const PlotRow& row) override { value_ = curve_.value(row).real(); }
    double value() const override { return value_; }
};

}  // namespace corpuscle::circuit
