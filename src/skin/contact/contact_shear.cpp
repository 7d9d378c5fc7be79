#include "skin/contact/contact_shear.hpp"

#include <fmt/format.h>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

double tangent(double degrees) { return num::sin_turns(degrees / 360) / num::cos_turns(degrees / 360); }

/// True if a surface, such as that of a grating, moves under a contact that rests.
bool is_passing(const ContactParams& p) { return !is_moving(p) && p.speed > 0; }

}  // namespace

ContactShear::ContactShear(const ContactParams& p, const SlidingTexture::Motion& motion)
    : tilt_ratio_(tangent(p.tilt)), friction_(p.friction), tilt_x_(num::cos_turns(p.azimuth / 360)),
      tilt_y_(num::sin_turns(p.azimuth / 360)), start_(motion.start), end_(motion.end),
      speed_(num::sqrt(motion.velocity.x * motion.velocity.x + motion.velocity.y * motion.velocity.y)) {
    if (speed_ == 0) friction_ = 0;
    move_x_ = speed_ > 0 ? motion.velocity.x / speed_ : 0, move_y_ = speed_ > 0 ? motion.velocity.y / speed_ : 0;
}

double ContactShear::distance(double t) const { return speed_ * std::max(0.0, std::min(t, end_) - start_); }

ShearTraction ContactShear::at(double t, double force, const PressureDistribution& pressure) {
    if (friction_ == 0) return {tilt_ratio_, 0, tilt_x_, tilt_y_};
    const double moved = distance(t);
    if (contact_begin_ < 0) contact_begin_ = moved;
    const double s = moved - contact_begin_;
    if (!(s > 0)) return {};
    return {friction_, pressure.stuck_force(force, s / friction_), move_x_, move_y_};
}

Result<void> check_contact_shear(const Indenter& indenter, const ContactParams& p, bool has_stiffness) {
    const bool moves = is_moving(p) || is_passing(p);
    if (p.azimuth != 0 && p.tilt == 0)
        return bad_input("contact: azimuth is the direction of a tilted force; give contact.tilt, such as contact.tilt=20");
    if (p.friction > 0 && p.tilt > 0 && moves)
        return bad_input("contact: tilt and friction both determine the shear of a moving contact; give only one of them");
    if (p.friction > 0 && tangent(p.tilt) > p.friction)
        return bad_input(
            fmt::format("contact: a force tilted by {:g} degrees slips at friction = {:g}; it needs friction of at least {:.3f}", p.tilt,
                        p.friction, std::ceil(tangent(p.tilt) * 1000) / 1000));
    if (p.friction > 0 && p.tilt == 0 && !moves)
        return bad_input(
            "contact: friction without a tilted force or a movement has no effect; give contact.tilt, or contact.x1 and speed");
    if (has_stiffness && indenter.name == "flat" && !(p.friction > 0 && moves))
        return bad_input("contact.E_star: a flat punch uses it only for friction in a movement; remove it, or give contact.friction");
    return {};
}

std::string contact_shear_note(const Indenter& indenter, const ContactParams& p) {
    if (p.tilt > 0)
        return fmt::format("the stimulus is the normal force; its tangential part, {:.3g} times as large, is spread like the pressure",
                           tangent(p.tilt));
    const bool sticks = indenter.name == "sphere" || indenter.name == "flat";
    return sticks
               ? "before it slides, the contact sticks in the middle as if the present normal force had acted all the time; the skin that "
                 "it drags along stays where it was; an indenter that stops keeps its shear"
               : fmt::format("the {} slides as soon as it moves, without sticking first, and keeps its shear when it stops", indenter.name);
}

}  // namespace corpuscle
