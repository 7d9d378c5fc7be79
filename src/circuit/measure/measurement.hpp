#pragma once
// .meas: each measurement computes one number from curves, point by point and in constant memory.

#include <algorithm>
#include <cmath>

#include "circuit/output/curve_view.hpp"

namespace corpuscle::circuit {

/// From (x0, y0) to (x1, y1). x1 may be below x0, since .dc can sweep downwards.
struct LineSegment {
    double x0, y0, x1, y1;

    /// Along x.
    double length() const { return std::abs(x1 - x0); }
    bool contains(double x) const { return (x0 <= x && x <= x1) || (x1 <= x && x <= x0); }
    double at(double x) const { return x1 == x0 || x == x1 ? y1 : y0 + (y1 - y0) * (x - x0) / (x1 - x0); }
    double slope() const { return (y1 - y0) / (x1 - x0); }

    // Crossings of y = 0.
    bool rises() const { return y0 < 0 && y1 >= 0; }
    bool falls() const { return y0 > 0 && y1 <= 0; }
    /// The x at which y = 0, if the segment rises or falls.
    double zero() const { return x0 + (x1 - x0) * (y0 / (y0 - y1)); }

    /// Over dx, so the sign is that of x1 - x0.
    double integral() const { return 0.5 * (y0 + y1) * (x1 - x0); }
    /// The integral of y^2 over |dx|.
    double integral_of_square() const { return (y0 * y0 + y0 * y1 + y1 * y1) / 3 * length(); }

    /// Cuts the segment to from <= x <= to. Returns false if no part of it lies there.
    bool cut(double from, double to) {
        const double low = std::max(from, std::min(x0, x1)), high = std::min(to, std::max(x0, x1));
        if (!(low <= high)) return false;
        const bool is_backward = x1 < x0;
        const double a = is_backward ? high : low, b = is_backward ? low : high;
        *this = {a, a == x0 ? y0 : at(a), b, at(b)};
        return true;
    }
};

inline constexpr double not_found = std::numeric_limits<double>::quiet_NaN();
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A measurement of one number. Derived classes are below.
class Measurement {
public:
    virtual ~Measurement() = default;
    /// The next point of the plot; x is the swept quantity.
    virtual void add_point(double x, const PlotRow&) = 0;
    /// The next point begins another sweep: no curve leads to it from the last point.
    virtual void begin_sweep() = 0;
    /// The result after the last point; NaN if nothing was found.
    virtual double value() const = 0;
};

/// An interval of the swept quantity.
struct Interval {
    double from = -unbounded, to = unbounded;
    bool contains(double x) const { return from <= x && x <= to; }
};

/// Follows a curve, or a curve minus another curve or a level, point by point.
struct CurveFollower {
    CurveView curve;
    double level = 0;
    std::optional<CurveView> other{};      ///< replaces the level
    std::optional<LineSegment> segment{};  ///< the newest one; after the first point of a sweep a segment of length 0

    void begin_sweep() { segment.reset(); }
    /// Returns false at the first point of a sweep, which does not complete a segment.
    bool add_point(double x, const PlotRow& row) {
        const double y = curve.measured_value(row) - (other ? other->measured_value(row) : level);
        const bool first = !segment;
        segment = first ? LineSegment{x, y, x, y} : LineSegment{segment->x1, segment->y1, x, y};
        return !first;
    }
};

/// Selects some zero crossings of a curve.
struct EdgeSelection {
    bool rising = true, falling = true;
    double number = 1;        ///< of the crossing among those that count: 1 is the first, -1 the last, -2 the one before it
    Interval interval;        ///< only crossings in this interval count
    bool is_counted = false;  ///< true: the result is the number of crossings, not the position of one
};

/// The last values of a sequence: value() is the n-th from its end.
class LastValues {
    std::vector<double> values_;  // at most n

public:
    void add(double x, double n) {
        if (static_cast<double>(values_.size()) >= n) values_.erase(values_.begin());
        values_.push_back(x);
    }
    double value(double n) const { return static_cast<double>(values_.size()) < n ? not_found : values_.front(); }
};

/// Counts the zero crossings of a CurveFollower that count for the selection, and keeps the position of the selected one.
struct CrossingCounter {
    CurveFollower follower;
    EdgeSelection edges;
    double count = 0;             ///< crossings so far
    double position = not_found;  ///< x of the newest one that may be the selected one; NaN if there was none yet
    LastValues positions{};       ///< if the number counts from the end

    /// Returns true if the newest segment has the selected crossing. If its number counts from the end, returns true at every crossing.
    bool add_point(double x, const PlotRow&);
    void begin_sweep() { follower.begin_sweep(); }
    bool is_from_end() const { return edges.number < 0; }
    double result() const { return edges.is_counted ? count : is_from_end() ? positions.value(-edges.number) : position; }
};

/// A position x: that of at=X, or that of a crossing.
struct EventPoint {
    double at = not_found;
    std::optional<CrossingCounter> crossing;  ///< if set, replaces `at`

    /// Returns true if the newest segment has the crossing.
    bool add_point(double x, const PlotRow& row) { return crossing && crossing->add_point(x, row); }
    void begin_sweep() {
        if (crossing) crossing->begin_sweep();
    }
    double position() const { return crossing ? crossing->result() : at; }
};

/// The position of a crossing (when ...), the number of crossings (count ...) or the distance from a trigger to a target (trig ...).
class DistanceMeasurement final : public Measurement {
    std::optional<EventPoint> trigger_;
    EventPoint target_;

public:
    DistanceMeasurement(std::optional<EventPoint> trigger, EventPoint target) : trigger_(std::move(trigger)), target_(std::move(target)) {}
    void add_point(double x, const PlotRow& row) override {
        if (trigger_) trigger_->add_point(x, row);
        target_.add_point(x, row);
    }
    void begin_sweep() override {
        if (trigger_) trigger_->begin_sweep();
        target_.begin_sweep();
    }
    double value() const override { return trigger_ ? target_.position() - trigger_->position() : target_.position(); }
};

/// find and deriv: the value or the slope of a curve at a position.
class ValueMeasurement final : public Measurement {
    CurveFollower curve_;
    bool is_slope_;  // true for deriv
    EventPoint event_;
    Interval interval_;  // with at=X, X must be in it
    std::optional<LineSegment> first_segment_;
    double value_ = not_found;
    LastValues values_;  // if the number of the crossing counts from the end

    double value_in(const LineSegment& segment, double x) const { return is_slope_ ? segment.slope() : segment.at(x); }

public:
    ValueMeasurement(CurveFollower curve, bool is_slope, EventPoint event, Interval interval = {})
        : curve_(std::move(curve)), is_slope_(is_slope), event_(std::move(event)), interval_(interval) {}
    void add_point(double x, const PlotRow&) override;
    void begin_sweep() override { curve_.begin_sweep(), event_.begin_sweep(); }
    double value() const override;
};

/// A summary of a curve over an interval.
struct CurveSummary {
    bool any = false;                // true if a point of the curve was in the interval
    double low = 0, high = 0;        // minimum and maximum so far
    double low_at = 0, high_at = 0;  // x of these
    double length = 0;               // of x inside the interval
    double area = 0;                 // integral over |dx|
    double integral = 0;             // integral over dx
    double squares = 0;              // integral of the square over |dx|
    double first_value = 0;          // first value in the interval, the result of avg and rms if length is 0
    double last_value = 0;           // last value in the interval

    void add(const LineSegment&);

private:
    void add_extreme(double x, double y);
};

/// min max pp avg rms integ min_at max_at of a curve over an interval, and its last value there. pp is max - min; min_at and max_at are
/// positions x.
class SummaryMeasurement final : public Measurement {
public:
    using Statistic = double (*)(const CurveSummary&);

private:
    Statistic statistic_;
    CurveFollower curve_;
    Interval interval_;
    CurveSummary summary_;

public:
    SummaryMeasurement(Statistic statistic, CurveFollower curve, Interval interval)
        : statistic_(statistic), curve_(std::move(curve)), interval_(interval) {}
    void add_point(double x, const PlotRow&) override;
    void begin_sweep() override { curve_.begin_sweep(); }
    double value() const override { return summary_.any ? statistic_(summary_) : not_found; }
};

}  // namespace corpuscle::circuit
