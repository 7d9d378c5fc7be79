#pragma once
// The position of a contact over time.

#include "signal/clock.hpp"
#include "skin/contact/indenters.hpp"

namespace corpuscle {

class ContactPath {
    Position from_, to_;
    double start_, length_, speed_;  // length_: duration of the movement, s
    bool pattern_moves_;             // the contact rests while a pattern passes under it

public:
    explicit ContactPath(const ContactParams&);
    Position at(double t) const;
    /// The distance that a pattern has passed under the contact, m.
    double pattern_shift(double t) const { return pattern_moves_ && t > start_ ? speed_ * (t - start_) : 0; }
    double duration() const { return length_; }  ///< duration of the movement
};

}  // namespace corpuscle
