#pragma once
// The pressure distribution of each indenter, as the fraction of the force in each cell of a column.

#include <memory>
#include <span>

#include "skin/contact/indenters.hpp"

namespace corpuscle {

/// Half the sides of a box, centred on the contact, that encloses it.
struct HalfBox {
    double width, height;
};

class PressureDistribution {
public:
    virtual ~PressureDistribution() = default;
    /// The size of the contact for a positive force (N), in m. The other two functions take this size.
    virtual double size(double force) const = 0;
    virtual HalfBox box(double size) const = 0;
    /// Fractions of the force, or numbers proportional to them, in the cells [x0, x0 + side] by [y[k], y[k + 1]], relative to the contact's
    /// centre. `shift`: the distance that a pattern has moved under the contact, m.
    virtual void column(double size, double shift, double x0, double side, std::span<const double> y, double* fractions) const = 0;
};

std::unique_ptr<PressureDistribution> make_pressure_distribution(const Indenter&, const ContactParams&, double side);

}  // namespace corpuscle
