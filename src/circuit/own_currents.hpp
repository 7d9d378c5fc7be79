#pragma once
// Devices' own currents as further curves of a plot, for .save and --trace: i(x1.m1).

#include "circuit/saved.hpp"

namespace corpuscle::circuit {

class OwnCurrents {
    const System& system_;
    std::vector<Saved> of_;
    std::vector<double> row_;

    bool has_all_unknowns(const Plot&) const;

public:
    OwnCurrents(const System&, std::span<const Saved>);
    bool any() const { return !of_.empty(); }
    /// Curves without values behind those of the head, whose first is what is swept and the others all unknowns.
    void add_to(Plot& head) const;
    /// A point with them.
    std::span<const double> point(std::span<const double> row);
    /// Into a plot that is complete. False: it is of another kind, or of other temperatures.
    bool complete(Plot&) const;
};

}  // namespace corpuscle::circuit
