#include "core/text/quantity.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

struct NamedUnit {
    std::string_view name;
    Unit unit;
};
// For each unit: the factor to SI, or to degrees, and the exponents of s, m, N, V, A and degree.
constexpr NamedUnit units[] = {
    {"s", {1, 1, 0, 0, 0, 0}},    {"min", {60, 1, 0, 0, 0, 0}},        {"Hz", {1, -1, 0, 0, 0, 0}},
    {"m", {1, 0, 1, 0, 0, 0}},    {"cm", {0.01, 0, 1, 0, 0, 0}},       {"N", {1, 0, 0, 1, 0, 0}},
    {"Pa", {1, 0, -2, 1, 0, 0}},  {"gf", {9.80665e-3, 0, 0, 1, 0, 0}}, {"lbf", {4.4482216152605, 0, 0, 1, 0, 0}},
    {"V", {1, 0, 0, 0, 1, 0}},    {"A", {1, 0, 0, 0, 0, 1}},           {"ohm", {1, 0, 0, 0, 1, -1}},
    {"Ohm", {1, 0, 0, 0, 1, -1}}, {"\u03a9", {1, 0, 0, 0, 1, -1}},     {"S", {1, 0, 0, 0, -1, 1}},
    {"F", {1, 1, 0, 0, -1, 1}},   {"H", {1, 1, 0, 0, 1, -1}},          {"W", {1, 0, 0, 0, 1, 1}},
    {"%", {0.01, 0, 0, 0, 0, 0}}, {"1", {1, 0, 0, 0, 0, 0}},           {"deg", {1, 0, 0, 0, 0, 0, 1}},
    {"\u00b0", {1, 0, 0, 0, 0, 0, 1}}, {"rad", {180 / std::numbers::pi, 0, 0, 0, 0, 0, 1}},
};

struct Prefix {
    std::string_view text;
    double factor;
};
constexpr Prefix prefixes[] = {{"f", 1e-15}, {"p", 1e-12}, {"n", 1e-9}, {"u", 1e-6}, {"\u00b5", 1e-6}, {"\u03bc", 1e-6},
                               {"m", 1e-3},  {"k", 1e3},   {"M", 1e6},  {"G", 1e9},  {"T", 1e12}};

std::optional<double> prefix_factor(std::string_view s) {
    for (const auto& p : prefixes)
        if (p.text == s) return p.factor;
    return {};
}

/// A symbol, possibly with a prefix: "mN".
std::optional<Unit> unit_of_symbol(std::string_view s) {
    for (const auto& u : units)
        if (u.name == s) return u.unit;
    constexpr std::string_view without_prefix[] = {"%", "1", "min", "lbf", "cm", "deg", "\u00b0", "rad"};
    for (const auto& p : prefixes)
        if (s.starts_with(p.text))
            for (const auto& u : units)
                if (u.name == s.substr(p.text.size()) && std::ranges::find(without_prefix, u.name) == std::end(without_prefix)) {
                    Unit scaled = u.unit;
                    scaled.factor *= p.factor;
                    return scaled;
                }
    return {};
}

/// Removes the power at the end of a symbol, such as that of "cm2", "cm^2" or "cm\u00b2", and returns it; 1 if there is none.
int strip_power(std::string_view& s) {
    for (const auto& [text, power] : {std::pair("^2", 2), {"^3", 3}, {"\u00b2", 2}, {"\u00b3", 3}, {"2", 2}, {"3", 3}})
        if (s.size() > std::string_view(text).size() && s.ends_with(text)) return s.remove_suffix(std::string_view(text).size()), power;
    return 1;
}

/// A symbol followed by its power: "cm2".
std::optional<Unit> unit_of_powered_symbol(std::string_view s) {
    const int power = strip_power(s);
    const auto base = unit_of_symbol(s);
    if (!base || power == 1) return base;
    const auto by = [power](signed char p) { return static_cast<signed char>(p * power); };
    const double factor = power == 2 ? base->factor * base->factor : base->factor * base->factor * base->factor;
    return Unit{factor, by(base->second), by(base->metre), by(base->newton), by(base->volt), by(base->ampere), by(base->degree)};
}

/// The kind of quantity that has this dimension, for messages; empty if it has no name here.
std::string_view dimension_name(const Unit& u) {
    struct Kind {
        std::string_view unit, name;
    };
    constexpr Kind kinds[] = {{"s", "a time"},
                              {"Hz", "a frequency"},
                              {"m", "a length"},
                              {"N", "a force"},
                              {"V", "a voltage"},
                              {"A", "a current"},
                              {"ohm", "a resistance"},
                              {"S", "a conductance"},
                              {"F", "a capacitance"},
                              {"H", "an inductance"},
                              {"", "a number without a unit"},
                              {"m/s", "a speed"},
                              {"W", "a power"},
                              {"m2", "an area"},
                              {"Pa", "a pressure"},
                              {"deg", "an angle"}};
    for (const auto& k : kinds)
        if (parse_unit(k.unit)->has_same_dimension(u)) return k.name;
    return {};
}

/// The error for a quantity whose unit, `found`, has not the dimension of the `wanted` unit.
Error wrong_unit(std::string_view text, std::string_view wanted, const std::optional<Unit>& found) {
    const auto name = found ? dimension_name(*found) : std::string_view{};
    const auto problem = name.empty() ? fmt::format("'{}' has another unit", text) : fmt::format("'{}' is {}", text, name);
    return bad_input(wanted.empty() ? fmt::format("{}; expected a number without a unit", problem)
                                    : fmt::format("{}; expected a value in {}, such as '2 {}'", problem, wanted, wanted));
}

}  // namespace

Result<Unit> parse_unit(std::string_view text) {
    if (text.size() > 64) return bad_input("the unit has more than 64 letters");
    Unit total;
    double power = 1;  // of the next symbol: 1, or -1 after a slash
    std::string_view rest = trimmed(text);
    if (rest.starts_with('/')) power = -1, rest = trimmed(rest.substr(1));  // "/cm2" is per square centimetre
    if (rest.empty() && power < 0) return bad_input(fmt::format("unit '{}' is incomplete: a symbol is missing at the end", text));
    while (!rest.empty()) {
        const auto end = rest.find_first_of("/* \t");
        const auto symbol = rest.substr(0, end);
        const auto u = unit_of_powered_symbol(symbol);
        if (!u) return bad_input(fmt::format("unknown unit '{}'", text));
        const auto add = [&](signed char& to, signed char by) { to = static_cast<signed char>(to + (power > 0 ? by : -by)); };
        total.factor *= power > 0 ? u->factor : 1 / u->factor;
        add(total.second, u->second), add(total.metre, u->metre), add(total.newton, u->newton), add(total.volt, u->volt),
            add(total.ampere, u->ampere), add(total.degree, u->degree);
        if (end == std::string_view::npos) return total;
        const auto next = rest.find_first_not_of(" \t", end);
        if (next == std::string_view::npos) return bad_input(fmt::format("unit '{}' is incomplete: a symbol is missing at the end", text));
        if (rest[next] == '/' || rest[next] == '*') {
            power = rest[next] == '/' ? -1 : power;  // V/s/A: each slash divides by the symbol after it
            if (rest[next] == '*') power = 1;
            rest = trimmed(rest.substr(next + 1));
            if (rest.empty()) return bad_input(fmt::format("unit '{}' is incomplete: a symbol is missing at the end", text));
        } else {
            rest = rest.substr(next);  // a blank keeps the power: in "A/N s" both N and s are divided by
        }
    }
    return total;
}

Result<double> parse_quantity(std::string_view text, std::string_view unit) {
    const auto t = trimmed(text);
    const auto example = unit.empty() ? std::string("0.5") : fmt::format("2 {}", unit);
    const auto* begin = t.data() + (t.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, status] = std::from_chars(begin, t.data() + t.size(), value);
    if (status != std::errc{} || end == begin)
        return bad_input(fmt::format("'{}' is not a quantity; write a number and a unit, such as '{}'", text, example));
    const auto written = trimmed(t.substr(static_cast<std::size_t>(end - t.data())));
    const Unit wanted = *parse_unit(unit);  // `unit` is a constant of the program, so it is valid
    double factor = 1;
    if (!written.empty()) {
        const auto found = parse_unit(written);
        if (found && found->has_same_dimension(wanted)) {
            factor = found->factor / wanted.factor;
        } else if (const auto prefix_only = prefix_factor(written)) {
            factor = *prefix_only;
        } else if (!found) {
            return bad_input(fmt::format("'{}': {}; expected {}, such as '{}'", text, found.error().message,
                                         unit.empty() ? "a number without a unit" : fmt::format("a value in {}", unit), example));
        } else {
            return wrong_unit(text, unit, *found);
        }
    }
    value *= factor;
    if (!std::isfinite(value)) return bad_input(fmt::format("'{}' is not a finite number", text));
    return value;
}

std::string format_quantity(double value, std::string_view unit) {
    const bool has_power = unit.ends_with('2') || unit.ends_with('3');  // without prefix, as the power applies to it too: 1 um2 is 1e-12 m2
    const bool prefixed = !unit.empty() && !unit.starts_with("1/") && unit != "deg" && !has_power && value != 0 && std::isfinite(value);
    constexpr std::string_view prefix_names[] = {"f", "p", "n", "u", "m", "", "k", "M", "G", "T"};
    int i = 5;  // no prefix
    if (prefixed) {
        const auto rounded = std::abs(value) * (1 + 5e-5);  // so that 999.96 is written as 1 k, not as 1000
        i = std::clamp(static_cast<int>(std::floor(std::log10(rounded) / 3)) + 5, 0, 9);
        value /= std::pow(10.0, 3 * (i - 5));
    }
    return fmt::format("{:.4g}{}{}{}", value + 0.0, unit.empty() ? "" : " ", prefix_names[i], unit);
}

}  // namespace corpuscle
