#pragma once
// Units are words at the door: "10 ms", "0.5um", "1k", "8 uA/N". One function turns them into SI, one writes them.

#include <string>
#include <string_view>

#include "signal/error.hpp"

namespace corpuscle {

/// The SI value of a quantity. `unit` says what is wanted ("s", "Hz", "A/N", "" for a plain number).
/// A bare number, or one with a bare prefix ("1k", "500n"), is in that unit; "10%" is 0.1 where a plain number is wanted.
/// A power stands behind its symbol: "4 mm2", "241 /cm2".
/// Prefixes: f p n u (or the micro sign) m k M G T; M is mega, m is milli. Refuses other dimensions, infinities and NaN.
Result<double> parse_quantity(std::string_view text, std::string_view unit);

/// For people: four significant digits with a prefix, "500 nA", "8 uA/N", "25 Hz".
std::string format_quantity(double value, std::string_view unit);

/// How many SI units one `unit` is, and its kind: the factor of "mN" is 1e-3 and it is a force. Refuses unknown units.
struct Unit {
    double factor = 1;
    signed char second = 0, metre = 0, newton = 0, volt = 0, ampere = 0;  ///< powers of the base units
    bool same_kind(const Unit& o) const {
        return second == o.second && metre == o.metre && newton == o.newton && volt == o.volt && ampere == o.ampere;
    }
};
Result<Unit> parse_unit(std::string_view text);

}  // namespace corpuscle
