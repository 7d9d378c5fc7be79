#pragma once
// The pressure distribution of each indenter, integrated over the cells of the skin: the fraction of the force on each cell.

#include "skin/contact/indenters.hpp"

namespace corpuscle {

/// Half the width (along x) and height (along y), in m, of a box that is centred on a contact and encloses it.
struct HalfBox {
    double width, height;
};

/// Describes a contact by one length, its size: the radius of a round contact or patch, half the width of an edge's contact.
class PressureDistribution {
public:
    virtual ~PressureDistribution() = default;
    /// The size of the contact under a force (N), which must be positive; m.
    virtual double size(double force) const = 0;
    virtual HalfBox box(double size) const = 0;  ///< encloses a contact of this size
    /// Writes the force on each cell of a column to `fractions`: as a fraction of the whole force or, for edge and grating, as a number
    /// proportional to it. The cells are [x0, x0 + side] by [y[k], y[k + 1]], in m relative to the contact's centre. `shift`: the distance
    /// that a pattern has moved under the contact, m.
    virtual void column(double size, double shift, double x0, double side, std::span<const double> y, double* fractions) const = 0;
};

/// The pressure distribution of an indenter on cells of this side (m).
std::unique_ptr<PressureDistribution> make_pressure_distribution(const Indenter&, const ContactParams&, double side);

}  // namespace corpuscle
