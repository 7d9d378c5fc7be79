// Warnings about numbers that users often take for other ones: 1F, 5M.

#include <fmt/format.h>

#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/parsed_netlist.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The unit of an element's main value; "" if it has no unit or no such value.
std::string_view unit_of(char letter) {
    const auto* kind = find_device_kind(letter);
    return kind == nullptr || kind->parameters.empty() ? "" : kind->parameters[0].unit;
}

/// The warning for a number in the line of an element whose value has this unit; "" if there is nothing to warn about. `text` is the number
/// in small letters. In the file its suffix begins with a capital, unless the suffix is "a".
std::string warning_for(std::string_view unit, const SpiceNumber& number, std::string_view text) {
    const auto scale = number.suffix.substr(0, 3);
    const bool is_milli = scale.starts_with('m') && scale != "meg" && scale != "mil";
    const auto digits = text.substr(0, text.size() - number.suffix.size());
    const bool is_source = unit == "V" || unit == "A";
    if (!is_source && equal_ignoring_case(number.suffix, "a"))
        return fmt::format("{0}{1} is {0}, since 'a' is not a scale factor; for {0} times 1e-18 write {0}e-18", digits, number.suffix);
    if (unit == "ohm" && is_milli) return fmt::format("{}M is {} milliohm; for a megohm write {}Meg", digits, digits, digits);
    if (unit == "F" && number.suffix == "f") return fmt::format("{}F is {} femtofarad; for a farad write {}", digits, digits, digits);
    if (is_source && number.suffix == "mhz")
        return fmt::format("{}MHz is {} millihertz; for a megahertz write {}Meg", digits, digits, digits);
    return "";
}

}  // namespace

void warn_about_units(const Statement& s, std::vector<Error>& warnings) {
    const auto check = [&](const Word& w) {
        if (w.kind != Word::Kind::plain) return;
        const auto text = s.text(w);
        const auto number = parse_number(text);
        if (!number || number->suffix.empty()) return;
        if (!equal_ignoring_case(number->suffix, "a") && !s.line.was_capital(w.at + text.size() - number->suffix.size())) return;
        const std::string warning = warning_for(unit_of(s.line.text[0]), *number, text);
        if (!warning.empty()) warnings.push_back(error_at(s.location(w), "{}: {}", s.text(std::size_t{0}), warning));
    };
    for (std::size_t k = 3; k < s.words.size(); ++k) check(s.words[k]);  // after the name and two nodes
    for (const auto& pair : s.pairs)
        if (s.text(pair.name) == "r" || s.text(pair.name) == "c") check(pair.value);
}

}  // namespace corpuscle::circuit
