#include "circuit/measure/xyce_measurements.hpp"

namespace corpuscle::circuit {
namespace {

/// The length of the part of a segment in which y > level.
double length_above(const LineSegment& s, double level) {
    const double a = s.y0 - level, b = s.y1 - level;
    if (a <= 0 && b <= 0) return 0;
    if (a >= 0 && b >= 0) return s.length();
    return s.length() * std::max(a, b) / std::abs(a - b);
}

/// The position, as a fraction of its length, at which a segment passes a level that is between its ends.
double fraction_at(const LineSegment& s, double level) { return (level - s.y0) / (s.y1 - s.y0); }

}  // namespace

void CycleMeasurement::enter(State state) {
    if (state_ == state) return;
    state_ = state;
    (state == State::on ? summary_.times_above : summary_.times_below) += 1;
}

void CycleMeasurement::add_point(double x, const PlotRow& row) {
    curve_.add_point(x, row);
    auto s = *curve_.segment;
    if (!s.cut(interval_.from, interval_.to)) return;
    if (s.y0 > on_) enter(State::on);
    if (s.y0 < off_) enter(State::off);
    const bool was_on = state_ == State::on, rises = !was_on && s.y1 > on_, falls = was_on && s.y1 < off_;
    summary_.length += s.length();
    summary_.above += length_above(s, on_);
    summary_.below += s.length() - length_above(s, off_);
    if (was_on) summary_.on += falls ? s.length() * fraction_at(s, off_) : s.length();
    if (rises) summary_.on += s.length() * (1 - (s.y0 < on_ ? fraction_at(s, on_) : 0));
    if (rises) enter(State::on);
    if (falls) enter(State::off);
}

void DifferenceMeasurement::add_point(double x, const PlotRow& row) {
    if (!interval_.contains(x)) return;
    const double m = measured_.measured_value(row), c = calculated_.measured_value(row);
    if (std::abs(m) < settings_.ymin || std::abs(m) > settings_.ymax) return;
    const double d = (m - c) / std::max(settings_.minval, std::abs(m));
    sum_ += settings_.is_absolute ? std::abs(d) : d * d;
    ++count_;
}

}  // namespace corpuscle::circuit
