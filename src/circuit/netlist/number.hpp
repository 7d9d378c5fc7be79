#pragma once
// Numbers as SPICE writes them: 2.5, 10k, 1meg, 10pF, 1e-9, 3mil. Letters after the scale are a unit and ignored.

#include <optional>
#include <string>
#include <string_view>

namespace corpuscle::circuit {

struct SpiceNumber {
    double value = 0;          ///< the double nearest to what is written; 1e999 is infinite
    std::size_t length = 0;    ///< how much of the text it took, its letters included
    std::string_view letters;  ///< what stands behind the digits: "pF", "Meg", ""
};

/// The number that the text begins with: digits first, no sign. Scales: T G Meg K mil m u n p f, in letters of either case. An A is the
/// unit, as ngspice has it: 1A is one ampere.
std::optional<SpiceNumber> leading_number(std::string_view text);

/// The number, perhaps with a sign, that the whole text is.
std::optional<SpiceNumber> whole_number(std::string_view text);

/// Why a number must be refused although it can be read: "5aF" is attofarads to some simulators and farads to others.
std::optional<std::string> ambiguous(const SpiceNumber&, std::string_view text);

}  // namespace corpuscle::circuit
