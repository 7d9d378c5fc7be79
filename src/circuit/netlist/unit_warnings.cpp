// Warnings about numbers that users often take for other ones: 1F, 5M.

#include <fmt/format.h>

#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/parsed_netlist.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The warning for a number in a line with this element letter; "" if there is nothing to warn about. `text` is the number in small
/// letters. In the file its suffix begins with a capital, unless the suffix is "a".
std::string warning_for(char element, const SpiceNumber& number, std::string_view text) {
    const auto scale = number.suffix.substr(0, 3);
    const bool is_milli = scale.starts_with('m') && scale != "meg" && scale != "mil";
    const auto digits = text.substr(0, text.size() - number.suffix.size());
    if (element != 'v' && element != 'i' && element != 'b' && equal_ignoring_case(number.suffix, "a"))
        return fmt::format("{0}{1} is {0}, since 'a' is not a scale factor; for {0} times 1e-18 write {0}e-18", digits, number.suffix);
    if (element == 'r' && is_milli) return fmt::format("{}M is {} milliohm; for a megohm write {}Meg", digits, digits, digits);
    if (element == 'c' && number.suffix == "f") return fmt::format("{}F is {} femtofarad; for a farad write {}", digits, digits, digits);
    if ((element == 'v' || element == 'i') && number.suffix == "mhz")
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
        const std::string warning = warning_for(s.line.text[0], *number, text);
        if (!warning.empty()) warnings.push_back(bad_input(fmt::format("{}: {}", s.text(std::size_t{0}), warning), s.location(w)));
    };
    for (std::size_t k = 3; k < s.words.size(); ++k) check(s.words[k]);  // after the name and two nodes
    for (const auto& pair : s.pairs)
        if (s.text(pair.name) == "r" || s.text(pair.name) == "c") check(pair.value);
}

}  // namespace corpuscle::circuit
