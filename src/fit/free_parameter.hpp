#pragma once
// The parameters that a fit changes, and their search coordinates.

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// A parameter that a fit changes. The search works on its coordinate x, from 0 at `low` to 1 at `high`: logarithmic if both are positive.
struct FreeParameter {
    std::size_t index = 0;  ///< among the parameters of the plan
    std::string name, unit;
    double start = 0;                      ///< value before the fit, in `unit`
    double low = 0, high = 0;              ///< bounds of the search, in `unit`
    double range_low = 0, range_high = 0;  ///< allowed values, in `unit`

    bool is_logarithmic() const { return low > 0; }
    /// The width of the search in natural coordinates: ln(high / low), or 1 if the parameter is not logarithmic.
    double width() const;
    double value(double x) const;            ///< of a coordinate, which is limited to 0 to 1
    double unbounded_value(double x) const;  ///< of a coordinate, which may lie beyond 0 to 1, and the value beyond the bounds
    /// Bounds for the option --bounds in which the lower (or upper) end is farther out, as far as the range allows: "2.5e-09:2e-05". "":
    /// the end is that of the range.
    std::string wider_bounds(bool upper) const;
    double coordinate(double value) const;  ///< of a value, limited to 0 to 1
};

/// The parameters of the plan with these names: "f_B", or with the afferent, "sa1.f_B". `bounds` are texts such as "f_B=5Hz:50Hz"; their
/// parameters need not be among `names`, and are then added. Without bounds a positive parameter is searched from a twentieth of its value
/// to twenty times its value, within its range; any other needs bounds.
Result<std::vector<FreeParameter>> free_parameters(const AfferentPlan&, std::span<const std::string> names,
                                                   std::span<const std::string> bounds);

/// The plan with the values of these coordinates.
AfferentPlan plan_at(const AfferentPlan&, std::span<const FreeParameter>, std::span<const double> coordinates);

}  // namespace corpuscle
