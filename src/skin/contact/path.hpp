#pragma once
// Where a contact is at a time.

#include "signal/clock.hpp"
#include "skin/contact/measures.hpp"

namespace corpuscle {

class ContactPath {
    Position from_, to_;
    double start_, length_, speed_;  // length_: s that the way takes
    bool passes_;                    // what it presses with passes under it, and it stands

public:
    explicit ContactPath(const ContactParams&);
    Position at(double t) const;
    /// How far a pattern has passed under it, m.
    double passed(double t) const { return passes_ && t > start_ ? speed_ * (t - start_) : 0; }
    double seconds() const { return length_; }
};

}  // namespace corpuscle
