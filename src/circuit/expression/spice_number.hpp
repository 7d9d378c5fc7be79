#pragma once
// Numbers in SPICE notation: 2.5, 10k, 1meg, 10pF, 1e-9, 3mil. Letters after the scale factor are a unit and are ignored.

#include <optional>
#include <string>
#include <string_view>

namespace corpuscle::circuit {

struct SpiceNumber {
    double value = 0;         ///< the double nearest to the written value; 1e999 is infinite
    std::size_t length = 0;   ///< number of characters that the number takes in the text, letters included
    std::string_view suffix;  ///< the letters after the digits and the exponent: "pF", "Meg", ""
};

/// The number at the beginning of the text, without a sign; nothing if the text does not begin with one. The scale factors are T G Meg K
/// mil m u n p f, and case is ignored. A is a unit, as in ngspice: 1A is one ampere.
std::optional<SpiceNumber> parse_leading_number(std::string_view text);

/// The number that the complete text is; a sign is allowed. Nothing if the text is not a number.
std::optional<SpiceNumber> parse_number(std::string_view text);

/// The reason why a number is rejected as ambiguous; nothing if it is not ambiguous. `text` is the number as written. "5aF" means
/// attofarads in some simulators and farads in others.
std::optional<std::string> ambiguity(const SpiceNumber&, std::string_view text);

}  // namespace corpuscle::circuit
