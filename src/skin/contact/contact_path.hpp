#pragma once
// The position of a contact over time.

#include "core/clock.hpp"
#include "skin/contact/indenters.hpp"

namespace corpuscle {

/// Times t are in s on the clock of the force.
class ContactPath {
    Position from_, to_;
    double start_, duration_, speed_;  // of the movement: s, s, m/s
    bool pattern_moves_;               // true: the contact rests while a pattern, such as a grating's, passes under it

public:
    explicit ContactPath(const ContactParams&);
    /// The position of the contact's centre, m.
    Position at(double t) const;
    /// The distance that a pattern has passed under the contact since the start of its movement, m.
    double pattern_shift(double t) const { return pattern_moves_ && t > start_ ? speed_ * (t - start_) : 0; }
    double duration() const { return duration_; }  ///< of the movement to x1, y1, s
};

}  // namespace corpuscle
