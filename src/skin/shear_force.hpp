#pragma once
// The tangential force that the afferents of a class feel. Each afferent adds to its normal force the shear along its preferred direction.

#include <array>

#include "skin/field_force.hpp"

namespace corpuscle {

/// The force on afferent u of a class is F_n + g_x F_x + g_y F_y, with g_x = gain cos(phi_u) and g_y = gain sin(phi_u). F_n, F_x and F_y
/// are the weighted sums over the sites of its receptive field.
///
/// The force is not limited to positive values. Shear against the preferred direction unloads the ending of an afferent, and more shear
/// than the contact's own load leaves it with a negative force. The receptor decides what that means: the static current of a slowly
/// adapting one falls below its leak, and a rapidly adapting one follows the change. So the force is linear in all three components, and
/// shear of 0 N gives the same bits as no shear.
class ShearForce {
public:
    /// For these afferents of a class, which must be those of the FieldForce. `receptors`: of each afferent; they have the same gains.
    ShearForce(const DirectionTuning&, std::span<const SkinAfferent>, std::size_t receptors = 1);

    bool is_tuned() const { return !gains_[0].empty(); }  ///< false: the class does not feel shear
    /// The force with shear. `field_force` computes the three sums, and its tiles are replaced. The other arguments are those of
    /// FieldForce::compute(). The result is valid until the next call, for this object or `field_force`.
    ForceTiles<double> add(FieldForce& field_force, const SiteForce&, std::span<const std::uint32_t> touched, std::size_t at,
                           std::size_t steps, ThreadPool&);

private:
    std::array<std::vector<double>, 2> gains_;  // g_x and g_y of each receptor, in the order of ForceTiles; empty: the gain is 0
    lanes::AlignedBuffer<double> rows_;         // the result, as in ForceTiles; empty before the first shear
};

/// The gains g_x and g_y of an afferent.
std::array<double, 2> shear_gains(const DirectionTuning&, const SkinAfferent&);

}  // namespace corpuscle
