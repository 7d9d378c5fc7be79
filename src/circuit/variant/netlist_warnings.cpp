#include "circuit/variant/netlist_warnings.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/device/named_values.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double max_gate_size = 1e-3;  // m; a larger w or l was probably meant in micrometres

/// One warning for all elements for which holds() is true, located at the first of them. Its text is message(first element).
template <class Holds, class Message>
void warn(std::vector<Error>& out, const Circuit& c, Holds&& holds, Message&& message) {
    const Element* first = nullptr;
    std::size_t count = 0;
    for (const auto& e : c.elements)
        if (holds(e) && ++count == 1) first = &e;
    if (first == nullptr) return;
    const auto others = count == 1 ? std::string() : fmt::format(" (and {} other element{})", count - 1, count == 2 ? "" : "s");
    out.push_back(error_at(first->location, "{}: {}{}", first->name, message(*first), others));
}

bool has_value(const Element& e, std::string_view name) { return e.values.contains(name); }

void warn_about_sizes(std::vector<Error>& out, const Circuit& c) {
    const auto too_long = [](const Element& e, std::string_view name) { return value_or(e.values, name, 0) > max_gate_size; };
    warn(
        out, c, [&](const Element& e) { return has_role(e, Role::transistor) && (too_long(e, "w") || too_long(e, "l")); },
        [&](const Element& e) {
            const auto name = too_long(e, "w") ? "w" : "l";
            const double size = value_or(e.values, name, 0);
            return fmt::format("{} = {} (sizes are in metres; {:g} um is written {}={:g}u)", name, format_quantity(size, "m"), size, name,
                               size);
        });
    for (const std::string_view name : {"w", "l"})
        warn(
            out, c, [&](const Element& e) { return has_role(e, Role::transistor) && !has_value(e, name); },
            [&](const Element&) {
                const UicmInstance defaults;
                return fmt::format("{}= is not given; the default is {}", name,
                                   format_quantity(name == "w" ? defaults.W : defaults.L, "m"));
            });
}

bool has_initial_value(const Element& e) { return has_role(e, Role::capacitor) || has_role(e, Role::inductor); }

void warn_about_initial_conditions(std::vector<Error>& out, const Circuit& c) {
    if (!std::ranges::all_of(c.directives_named("tran"), [](const Directive& d) { return !d.words.empty() && d.words.back() == "uic"; }))
        warn(
            out, c, [](const Element& e) { return has_value(e, "ic") && has_initial_value(e); },
            [](const Element&) {
                return "ic= has an effect only with 'uic' at the end of the .tran line; without it, .ic v(node)=... sets the initial "
                       "voltage of a node";
            });
    warn(
        out, c, [](const Element& e) { return has_value(e, "ic") && !has_initial_value(e); },
        [](const Element&) { return "ic= of a diode has no effect; use ic= of a parallel capacitor, or .ic v(node)=... with uic"; });
    warn(
        out, c, [](const Element& e) { return has_value(e, "off"); },
        [](const Element&) { return "off has no effect; .nodeset v(node)=... sets where the search for the operating point begins"; });
}

void warn_about_missing_ac(std::vector<Error>& out, const Circuit& c) {
    if (std::any_of(c.elements.begin(), c.elements.end(), [](const Element& e) { return e.waveform.ac_magnitude != 0; })) return;
    for (const auto& directive : c.directives_named("ac") | std::views::take(1))
        out.push_back(
            error_at(directive.location, ".ac: no source has an AC value, so every response is 0; add one, such as 'v1 in 0 dc 0 ac 1'"));
}

void warn_about_pulses(std::vector<Error>& out, const Circuit& c) {
    enum { rise = 3, fall = 4, width = 5, period = 6 };  // indices of the arguments of PULSE
    const auto length = [](const Element& e) { return e.waveform.numbers[rise] + e.waveform.numbers[width] + e.waveform.numbers[fall]; };
    warn(
        out, c,
        [&](const Element& e) {
            const auto& w = e.waveform;
            return w.shape == Waveform::Shape::pulse && w.numbers.size() > period && w.numbers[period] > 0 &&
                   length(e) > w.numbers[period] * (1 + 1e-9);
        },
        [&](const Element& e) {
            return fmt::format("the pulse (rise, width and fall take {}) is longer than its period of {}", format_quantity(length(e), "s"),
                               format_quantity(e.waveform.numbers[period], "s"));
        });
}

void warn_about_tran_times(std::vector<Error>& out, const Circuit& c) {
    for (const auto& directive : c.directives_named("tran")) {
        if (directive.words.size() < 2) continue;
        const auto step = parse_number(directive.words[0]), stop = parse_number(directive.words[1]);
        if (step && stop && stop->value > 0 && step->value > stop->value)
            out.push_back(error_at(directive.location, ".tran: STEP {} is longer than STOP {}; the order is .tran STEP STOP",
                                   directive.words[0], directive.words[1]));
    }
}

}  // namespace

std::vector<Error> netlist_warnings(const Circuit& c) {
    std::vector<Error> out;
    warn_about_sizes(out, c), warn_about_missing_ac(out, c), warn_about_pulses(out, c), warn_about_tran_times(out, c);
    if (c.has_directive("tran")) warn_about_initial_conditions(out, c);
    return out;
}

}  // namespace corpuscle::circuit
