#include "circuit/measure/measurement.hpp"

namespace corpuscle::circuit {
bool CrossingCounter::add_point(double x, const PlotRow& row) {
    if (!follower.add_point(x, row)) return false;
    const auto& segment = *follower.segment;
    if (!(segment.rises() && edges.rising) && !(segment.falls() && edges.falling)) return false;
    const double zero = segment.zero();
    if (!edges.interval.contains(zero)) return false;
    ++count;
    if (is_from_end())
        positions.add(zero, -edges.number);
    else if (count != edges.number)
        return false;
    position = zero;
    return true;
}

void ValueMeasurement::add_point(double x, const PlotRow& row) {
    const bool has_segment = curve_.add_point(x, row), is_crossing = event_.add_point(x, row);
    if (!has_segment) return;
    const auto& segment = *curve_.segment;
    if (!first_segment_) first_segment_ = segment;
    // With at=X, the first segment that contains X counts.
    const bool is_here = event_.crossing ? is_crossing : std::isnan(value_) && segment.contains(event_.at);
    if (!is_here) return;
    value_ = value_in(segment, event_.crossing ? event_.crossing->position : event_.at);
    if (event_.crossing && event_.crossing->is_from_end()) values_.add(value_, -event_.crossing->edges.number);
}

/// at=X that lies beyond an end of the curve only by rounding counts as that end.
double ValueMeasurement::value() const {
    if (event_.crossing) return event_.crossing->is_from_end() ? values_.value(-event_.crossing->edges.number) : value_;
    if (!interval_.contains(event_.at)) return not_found;
    if (!std::isnan(value_) || !curve_.segment) return value_;
    const auto& last = *curve_.segment;
    const auto& first = first_segment_ ? *first_segment_ : last;
    const double tolerance = 1e-9 * std::abs(last.x1 - first.x0);
    if (std::abs(event_.at - last.x1) <= tolerance) return value_in(last, last.x1);
    if (std::abs(event_.at - first.x0) <= tolerance) return value_in(first, first.x0);
    return not_found;
}

void CurveSummary::add_extreme(double x, double y) {
    if (!any || y < low) low = y, low_at = x;
    if (!any || y > high) high = y, high_at = x;
    any = true;
}

void CurveSummary::add(const LineSegment& segment) {
    if (!any) first_value = segment.y0;
    add_extreme(segment.x0, segment.y0);
    add_extreme(segment.x1, segment.y1);
    const double over_x = segment.integral();
    length += segment.length(), integral += over_x, area += segment.x1 < segment.x0 ? -over_x : over_x;
    squares += segment.integral_of_square();
    last_value = segment.y1;
}

void SummaryMeasurement::add_point(double x, const PlotRow& row) {
    curve_.add_point(x, row);
    auto segment = *curve_.segment;  // at the first point a segment of length 0
    if (segment.cut(interval_.from, interval_.to)) summary_.add(segment);
}

}  // namespace corpuscle::circuit
