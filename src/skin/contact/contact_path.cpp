#include "skin/contact/contact_path.hpp"

#include "core/number/number.hpp"
#include "core/stimulus/touch.hpp"

namespace corpuscle {

ContactPath::ContactPath(const ContactParams& p)
    : from_{p.x, p.y, 0}, to_{p.x1, p.y1, 0}, start_(p.t_start), duration_(p.t_move), speed_(p.speed),
      pattern_moves_(!is_moving(p) && p.speed > 0) {
    const double dx = p.x1 - p.x, dy = p.y1 - p.y;
    if (is_moving(p) && p.speed > 0) duration_ = num::sqrt(dx * dx + dy * dy) / p.speed;
}

Position ContactPath::at(double t) const {
    // Fraction of the way from the start to the end.
    const double fraction = duration_ > 0 ? ramp_fraction(t, start_, duration_) : 0;
    return {from_.x + (to_.x - from_.x) * fraction, from_.y + (to_.y - from_.y) * fraction, 0};
}

}  // namespace corpuscle
