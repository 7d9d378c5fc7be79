#include "circuit/measure/gauge.hpp"

namespace corpuscle::circuit {

bool Crossings::point(double x, const PlotRow& row) {
    if (!traced_.point(x, row)) return false;
    const auto& piece = *traced_.piece();
    if (!((piece.rises() && edges_.kind != Edges::Kind::fall) || (piece.falls() && edges_.kind != Edges::Kind::rise))) return false;
    const double where = piece.zero();
    if (!edges_.within.holds(where)) return false;
    ++count_;
    if (edges_.which != 0 && count_ != edges_.which) return false;
    found_ = where;
    return true;
}

void Found::point(double x, const PlotRow& row) {
    const bool later = curve_.point(x, row), came = spot_.point(x, row);
    if (!later) return;
    const auto& piece = *curve_.piece();
    if (!first_) first_ = piece;
    const bool here = spot_.crossing ? came : std::isnan(value_) && piece.holds(spot_.at);
    if (here) value_ = of(piece, spot_.found());
}

/// A place that rounding put beyond the ends is meant as the end.
double Found::value() const {
    if (!std::isnan(value_) || spot_.crossing || !curve_.piece()) return value_;
    const auto& last = *curve_.piece();
    const auto& first = first_ ? *first_ : last;
    const double slack = 1e-9 * std::abs(last.x1 - first.x0);
    if (std::abs(spot_.at - last.x1) <= slack) return of(last, last.x1);
    if (std::abs(spot_.at - first.x0) <= slack) return of(first, first.x0);
    return nothing;
}

void Summary::see(double x, double y) {
    if (!any_ || y < low_) low_ = y, low_at_ = x;
    if (!any_ || y > high_) high_ = y, high_at_ = x;
    any_ = true;
}

void Summary::point(double x, const PlotRow& row) {
    curve_.point(x, row);
    auto piece = *curve_.piece();  // of the first point: the point alone
    if (!piece.cut(stretch_.from, stretch_.to)) return;
    if (!any_) only_ = piece.y0;
    see(piece.x0, piece.y0);
    see(piece.x1, piece.y1);
    const double part = piece.integral();
    length_ += piece.length(), integral_ += part, area_ += piece.x1 < piece.x0 ? -part : part, squares_ += piece.squares();
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
