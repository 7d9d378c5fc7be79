#pragma once
// Quantities as text: "10 ms", "0.5um", "1k", "8 uA/N".

#include <string_view>

#include "core/error.hpp"

namespace corpuscle {

/// Reads a quantity and returns its value in `unit`, the expected unit ("s", "Hz", "A/N", "" for a dimensionless number). The text can have
/// any unit of the same dimension. A number without a unit, also with a prefix ("1k", "500n"), is in the expected unit. "10%" is 0.1 if
/// `unit` is "". A power follows the symbol of its unit: "4 mm2" (also mm^2), "241 /cm2". Prefixes are f p n u (or the micro sign) m k M G T; M is
/// mega, m is milli. A unit of another dimension, infinity and NaN are errors.
Result<double> parse_quantity(std::string_view text, std::string_view unit);

/// The quantity as text with four significant digits and a prefix: "500 nA", "8 uA/N", "25 Hz". `value` is in `unit`, which has no prefix.
std::string format_quantity(double value, std::string_view unit);

/// A physical unit: its size in SI units, and its dimension. "mN" has the factor 1e-3 and the dimension of a force.
struct Unit {
    double factor = 1;                                                    ///< size in SI units; of an angle, in degrees
    signed char second = 0, metre = 0, newton = 0, volt = 0, ampere = 0, degree = 0;  ///< exponents of these units
    bool has_same_dimension(const Unit& o) const {
        return second == o.second && metre == o.metre && newton == o.newton && volt == o.volt && ampere == o.ampere &&
               degree == o.degree;
    }
};
/// Parses a unit such as "uA/N" or "/cm2". An unknown unit is an error.
Result<Unit> parse_unit(std::string_view text);

}  // namespace corpuscle
