#pragma once
// How a force is shared out under each indenter: the part of it in each cell of a column of cells.

#include <memory>
#include <span>

#include "skin/contact/measures.hpp"

namespace corpuscle {

/// Half a box, about the contact's middle, that holds it.
struct HalfBox {
    double width, height;
};

class Pressure {
public:
    virtual ~Pressure() = default;
    /// How large the contact is under a force above 0 (N): what the other two want; m.
    virtual double size(double force) const = 0;
    virtual HalfBox box(double size) const = 0;
    /// Parts of the force, or what is in proportion to them, in the cells [x0, x0 + side] by [y[k], y[k + 1]], about the contact's middle.
    /// `shift`: how far a pattern has moved under it, m.
    virtual void column(double size, double shift, double x0, double side, std::span<const double> y, double* parts) const = 0;
};

std::unique_ptr<Pressure> make_pressure(const Indenter&, const ContactParams&, double side);

}  // namespace corpuscle
