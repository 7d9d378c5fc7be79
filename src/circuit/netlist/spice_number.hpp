#pragma once
// Numbers in SPICE notation: 2.5, 10k, 1meg, 10pF, 1e-9, 3mil. Letters after the scale are a unit and are ignored.

#include <optional>
#include <string>
#include <string_view>

namespace corpuscle::circuit {

struct SpiceNumber {
    double value = 0;         ///< the double nearest to the written value; 1e999 is infinite
    std::size_t length = 0;   ///< length of the number in the text, letters included
    std::string_view suffix;  ///< the letters after the digits: "pF", "Meg", ""
};

/// The number at the beginning of the text, without a sign. Scales are T G Meg K mil m u n p f, in letters of either case. A is a unit,
/// as in ngspice: 1A is one ampere.
std::optional<SpiceNumber> parse_leading_number(std::string_view text);

/// The real number that fills the complete text; a sign is allowed.
std::optional<SpiceNumber> parse_number(std::string_view text);

/// The reason why a readable number is rejected as ambiguous; nothing if it is not. "5aF" means attofarads in some simulators and farads
/// in others.
std::optional<std::string> ambiguity(const SpiceNumber&, std::string_view text);

}  // namespace corpuscle::circuit
