// Numbers that look like one thing and are another.

#include <fmt/format.h>

#include "circuit/netlist/body.hpp"
#include "circuit/netlist/number.hpp"
#include "signal/text.hpp"

namespace corpuscle::circuit {
namespace {

std::string remark_on(char element, const SpiceNumber& number, std::string_view as_read) {
    const auto scale = number.letters.substr(0, 3);
    const bool milli = scale.starts_with('m') && scale != "meg" && scale != "mil";
    const auto digits = as_read.substr(0, as_read.size() - number.letters.size());
    if (element != 'v' && element != 'i' && element != 'b' && same_letters(number.letters, "a"))
        return fmt::format("{}{} is {}, without a scale; 1e-18 of it is written {}e-18", digits, number.letters, digits, digits);
    if (element == 'r' && milli) return fmt::format("{}M is {} milliohm; a megohm is written {}Meg", digits, digits, digits);
    if (element == 'c' && number.letters == "f") return fmt::format("{}F is {} femtofarad; a farad is written {}", digits, digits, digits);
    if ((element == 'v' || element == 'i') && number.letters == "mhz")
        return fmt::format("{}MHz is {} millihertz; a megahertz is written {}Meg", digits, digits, digits);
    return "";
}

}  // namespace

void remark_on_units(const Statement& s, std::vector<Error>& remarks) {
    const auto look_at = [&](const Word& w) {
        if (w.kind != Word::Kind::plain) return;
        const auto text = s.text(w);
        const auto number = whole_number(text);
        if (!number || number->letters.empty()) return;
        if (!same_letters(number->letters, "a") && !s.line.was_capital(w.at + text.size() - number->letters.size())) return;
        const std::string remark = remark_on(s.line.text[0], *number, text);
        if (!remark.empty()) remarks.push_back(bad_input(fmt::format("{}: {}", s.text(std::size_t{0}), remark), s.place(w)));
    };
    for (std::size_t k = 3; k < s.words.size(); ++k) look_at(s.words[k]);
    for (const auto& pair : s.named)
        if (s.text(pair.name) == "r" || s.text(pair.name) == "c") look_at(pair.value);
}

}  // namespace corpuscle::circuit
