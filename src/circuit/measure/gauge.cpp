#include "circuit/measure/gauge.hpp"

namespace corpuscle::circuit {

bool Crossings::point(double x, const PlotRow& row) {
    if (!traced_.point(x, row)) return false;
    const auto& segment = *traced_.piece();
    if (!((segment.rises() && edges_.kind != Edges::Kind::fall) || (segment.falls() && edges_.kind != Edges::Kind::rise))) return false;
    const double position = segment.zero();
    if (!edges_.within.holds(position)) return false;
    ++count_;
    if (edges_.which != 0 && count_ != edges_.which) return false;
    found_ = position;
    return true;
}

void Found::point(double x, const PlotRow& row) {
    const bool has_segment = curve_.point(x, row), is_crossing = spot_.point(x, row);
    if (!has_segment) return;
    const auto& segment = *curve_.piece();
    if (!first_) first_ = segment;
    const bool is_here = spot_.crossing ? is_crossing : std::isnan(value_) && segment.holds(spot_.at);
    if (is_here) value_ = of(segment, spot_.found());
}

/// A position that lies beyond an end only by rounding counts as the end.
double Found::value() const {
    if (!std::isnan(value_) || spot_.crossing || !curve_.piece()) return value_;
    const auto& last = *curve_.piece();
    const auto& first = first_ ? *first_ : last;
    const double tolerance = 1e-9 * std::abs(last.x1 - first.x0);
    if (std::abs(spot_.at - last.x1) <= tolerance) return of(last, last.x1);
    if (std::abs(spot_.at - first.x0) <= tolerance) return of(first, first.x0);
    return nothing;
}

void Summary::update_extremes(double x, double y) {
    if (!any_ || y < low_) low_ = y, low_at_ = x;
    if (!any_ || y > high_) high_ = y, high_at_ = x;
    any_ = true;
}

void Summary::point(double x, const PlotRow& row) {
    curve_.point(x, row);
    auto segment = *curve_.piece();  // at the first point a segment of length 0
    if (!segment.cut(stretch_.from, stretch_.to)) return;
    if (!any_) only_ = segment.y0;
    update_extremes(segment.x0, segment.y0);
    update_extremes(segment.x1, segment.y1);
    const double integral = segment.integral();
    length_ += segment.length(), integral_ += integral, area_ += segment.x1 < segment.x0 ? -integral : integral,
        squares_ += segment.squares();
}

double Summary::value() const {
    if (!any_) return nothing;
    switch (of_) {
        case Of::min:
            return low_;
        case Of::max:
            return high_;
        case Of::pp:
            return high_ - low_;
        case Of::min_at:
            return low_at_;
        case Of::max_at:
            return high_at_;
        case Of::avg:
            return length_ == 0 ? only_ : area_ / length_;
        case Of::rms:
            return length_ == 0 ? std::abs(only_) : std::sqrt(squares_ / length_);
        case Of::integ:
            return integral_;
    }
    return nothing;
}

}  // namespace corpuscle::circuit
