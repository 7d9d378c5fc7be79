#pragma once
// The tangential traction under an indenter: of a tilted force, or of friction.

#include "skin/contact/sliding_texture.hpp"

namespace corpuscle {

/// The tangential traction at one moment: q = ratio (p(P) - p(P*)) in the direction (x, y), where p(F) is the pressure under a normal force
/// F. P is the present force and P* the one whose contact is the part that sticks.
struct ShearTraction {
    double ratio = 0;        ///< tangential traction over pressure: the coefficient of friction, or the tangent of the tilt; 0: no shear
    double stuck_force = 0;  ///< P*, N; 0: the contact slips everywhere, or all of it carries its share
    double x = 0, y = 0;     ///< unit vector
};

/// A tilted force, `contact.tilt` from the normal: the tangential force is F tan(tilt), and q = p tan(tilt). That is exact for a force that
/// grows and falls at a constant angle below the angle of friction (Mindlin & Deresiewicz 1953, quoted from memory).
///
/// Friction (`contact.friction`, mu): a sliding contact pulls the skin along with q = mu p. Before it slides, it has moved by s since the
/// movement or the contact began. It then sticks in the middle and slips at its edge (Cattaneo, Mindlin): q = mu (p(P) - p(P*)). P* follows
/// from s = mu k (d(P) - d(P*)), where d is the indentation by a normal force and k = (2 - nu) / (2 - 2 nu) (Jaeger, Ciavarella). The skin
/// counts as incompressible, nu = 1/2, so k = 3/2. Under a sphere the radius c of the stuck part is c^2 = a^2 - 2 R s / (3 mu). When the
/// force falls, a shrinks and so does c: the shear is released from the edge inwards.
class ContactShear {
public:
    ContactShear(const ContactParams&, const SlidingTexture::Motion&);

    bool any() const { return tilt_ratio_ > 0 || friction_ > 0; }  ///< false: the contact never has shear
    /// The traction at time t (s) under this force (N, positive) on a contact with this pressure distribution.
    ShearTraction at(double t, double force, const PressureDistribution&);
    /// To be called for a sample without contact. The next contact begins without shear.
    void release() { contact_begin_ = -1; }

private:
    double tilt_ratio_, friction_;
    double tilt_x_, tilt_y_, move_x_, move_y_;  // unit vectors of the tilted force and of the movement
    double start_, end_, speed_;                // s, s, m/s; of the movement
    double contact_begin_ = -1;                 // distance moved at the start of the contact, m; -1: no contact

    double distance(double t) const;  // moved until t, m
};

/// Checks the parameters of tilt and friction. `has_stiffness`: true if E_star was set.
Result<void> check_contact_shear(const Indenter&, const ContactParams&, bool has_stiffness);

/// The limits of the model of shear, for the notes of a contact.
std::string contact_shear_note(const Indenter&, const ContactParams&);

}  // namespace corpuscle
