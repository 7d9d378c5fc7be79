#pragma once
// Quantities as text: "10 ms", "0.5um", "1k", "8 uA/N". One function converts text to SI, another writes it.

#include <string>
#include <string_view>

#include "signal/error.hpp"

namespace corpuscle {

/// The SI value of a quantity. `unit` is the expected unit ("s", "Hz", "A/N", "" for a dimensionless
/// number). A number without a unit, also with a prefix ("1k", "500n"), is in the expected unit. "10%" is 0.1 if `unit` is "".
/// A power follows its symbol: "4 mm2", "241 /cm2".
/// Prefixes are f p n u (or the micro sign) m k M G T; M is mega, m is milli. Other dimensions, infinities and NaN are errors.
Result<double> parse_quantity(std::string_view text, std::string_view unit);

/// Text for people, with four significant digits and a prefix: "500 nA", "8 uA/N", "25 Hz".
std::string format_quantity(double value, std::string_view unit);

/// A physical unit as its size in SI and its dimension: "mN" has the factor 1e-3 and the dimension of a force.
struct Unit {
    double factor = 1;
    signed char second = 0, metre = 0, newton = 0, volt = 0, ampere = 0;  ///< exponents of the base units
    bool has_same_dimension(const Unit& o) const {
        return second == o.second && metre == o.metre && newton == o.newton && volt == o.volt && ampere == o.ampere;
    }
};
/// Unknown units are errors.
Result<Unit> parse_unit(std::string_view text);

}  // namespace corpuscle
