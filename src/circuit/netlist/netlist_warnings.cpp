// Warnings about likely mistakes in a valid netlist, and about numbers that users often take for other ones: 1F, 5M.

#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/parsed_netlist.hpp"
#include "circuit/similar_names.hpp"
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

/// Warns about nodes that only one terminal of one element is connected to. The circuit can be solved, but this is often a typing error.
void warn_about_dangling_nodes(std::vector<Error>& out, const Circuit& c) {
    std::vector<int> terminals(c.nodes.size());           // number of terminals, and of uses in expressions, by node
    std::vector<const Element*> element(c.nodes.size());  // the last element with a terminal at the node
    for (const auto& e : c.elements) {
        for (const int n : e.nodes) ++terminals[static_cast<std::size_t>(n)], element[static_cast<std::size_t>(n)] = &e;
        if (!e.expression) continue;
        for (const auto& in : e.expression->inputs())
            for (const auto& name : {in.name, in.minus})
                if (const int n = c.find_node(name); in.kind == ExpressionInput::Kind::voltage && n > 0)
                    ++terminals[static_cast<std::size_t>(n)];
    }
    std::vector<std::string_view> connected;  // nodes with more than one terminal, as suggestions
    for (std::size_t n = 1; n < c.nodes.size(); ++n)
        if (terminals[n] > 1) connected.push_back(c.nodes[n]);
    Suggestions similar_nodes;
    for (std::size_t n = 1; n < c.nodes.size(); ++n)
        if (terminals[n] == 1 && c.nodes[n].find('.') == std::string::npos)  // not inside a subcircuit
            out.push_back(error_at(element[n]->location, "node '{}' is connected only to {}{}", c.nodes[n], element[n]->name,
                                   similar_nodes.for_name(nullptr, c.nodes[n], [&] { return std::span(connected); })));
}

bool is_transistor(const Element& e) { return e.letter == 'm'; }

/// The value of a parameter that the line does not give.
double default_of(const Element& e, std::string_view name) {
    const auto& parameters = kind_of(e).parameters;
    return std::ranges::find(parameters, name, &ElementParameter::name)->initial;
}

void warn_about_sizes(std::vector<Error>& out, const Circuit& c) {
    const auto too_long = [](const Element& e, std::string_view name) { return value_or(e.values, name, 0) > max_gate_size; };
    warn(
        out, c, [&](const Element& e) { return is_transistor(e) && (too_long(e, "w") || too_long(e, "l")); },
        [&](const Element& e) {
            const auto name = too_long(e, "w") ? "w" : "l";
            const double size = value_or(e.values, name, 0);
            return fmt::format("{} = {} (sizes are in metres; {:g} um is written {}={:g}u)", name, format_quantity(size, "m"), size, name,
                               size);
        });
    for (const std::string_view name : {"w", "l"})
        warn(
            out, c, [&](const Element& e) { return is_transistor(e) && !has_value(e, name); },
            [&](const Element& e) {
                return fmt::format("{}= is not given; the default is {}", name, format_quantity(default_of(e, name), "m"));
            });
}

/// The first mismatch parameter in the model of a transistor that has no mismatch; "" if there is none.
std::string_view unused_mismatch(const Circuit& c, const Element& e) {
    const auto* model = c.model_of(e);
    if (!is_transistor(e) || has_role(e, Role::transistor) || model == nullptr) return "";
    for (const std::string_view name : {"avto", "akp", "agamma"})
        if (value_or(model->values, name, 0) != 0) return name;
    return "";
}

void warn_about_mismatch(std::vector<Error>& out, const Circuit& c) {
    warn(
        out, c, [&](const Element& e) { return !unused_mismatch(c, e).empty(); },
        [&](const Element& e) {
            return fmt::format("{} of its model has no effect; only UICM (level=80) has mismatch", unused_mismatch(c, e));
        });
}

void warn_about_equal_chips(std::vector<Error>& out, const Circuit& c) {
    const auto reason = reason_no_variation(c);
    if (reason.empty()) return;
    for (const auto& directive : c.directives_named("mc") | std::views::take(1))
        return out.push_back(error_at(directive.location, ".mc: {}", reason));
    out.push_back(error_at({c.file}, "--mismatch: {}", reason));
}

bool has_initial_value(const Element& e) { return has_role(e, Role::capacitor) || has_role(e, Role::inductor); }

void warn_about_initial_conditions(std::vector<Error>& out, const Circuit& c) {
    if (!std::ranges::all_of(c.directives_named("tran"), starts_from_initial_conditions))
        warn(
            out, c, [](const Element& e) { return has_value(e, "ic") && has_initial_value(e); },
            [](const Element&) {
                return "ic= has an effect only with 'uic' at the end of the .tran line; without it, .ic v(node)=... sets the initial "
                       "voltage of a node";
            });
    warn(
        out, c, [](const Element& e) { return has_value(e, "ic") && !has_initial_value(e); },
        [](const Element&) {
            return "ic= of a diode or transistor has no effect; use ic= of a parallel capacitor, or .ic v(node)=... with uic";
        });
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
        for (const auto& word : directive.words)
            if (is_modifier_of_tran(word))
                out.push_back(error_at(directive.location,
                                       ".tran: '{}' has no effect: the transient begins at the operating point, or with "
                                       "uic at the voltages of .ic, and keeps all points from START on",
                                       word));
        if (directive.words.size() < 2) continue;
        if (starts_from_initial_conditions(directive) && directive.words.back() != "uic")
            out.push_back(error_at(directive.location, ".tran: the words after uic have no effect: {}",
                                   fmt::join(std::ranges::find(directive.words, "uic") + 1, directive.words.end(), " ")));
        const auto step = parse_number(directive.words[0]), stop = parse_number(directive.words[1]);
        if (step && stop && stop->value > 0 && step->value > stop->value)
            out.push_back(error_at(directive.location, ".tran: STEP {} is longer than STOP {}; the order is .tran STEP STOP",
                                   directive.words[0], directive.words[1]));
    }
}

void warn_about_op_words(std::vector<Error>& out, const Circuit& c) {
    for (const auto& directive : c.directives_named("op"))
        if (!directive.words.empty() && directive.words[0] == "trace")
            out.push_back(error_at(directive.location_of(0), ".op: the words from 'trace' on have no effect"));
}

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
    if (equal_ignoring_case(number.suffix, "x"))
        return fmt::format("{0}{1} is {0}; HSPICE and Xyce read 'x' as mega: for {0} times 1e6 write {0}Meg", digits, number.suffix);
    if (!is_source && equal_ignoring_case(number.suffix, "a"))
        return fmt::format("{0}{1} is {0}, since 'a' is not a scale factor; for {0} times 1e-18 write {0}e-18", digits, number.suffix);
    if (unit == "ohm" && is_milli) return fmt::format("{}M is {} milliohm; for a megohm write {}Meg", digits, digits, digits);
    if (unit == "F" && number.suffix == "f") return fmt::format("{}F is {} femtofarad; for a farad write {}", digits, digits, digits);
    if (is_source && number.suffix == "mhz")
        return fmt::format("{}MHz is {} millihertz; for a megahertz write {}Meg", digits, digits, digits);
    return "";
}

}  // namespace

std::vector<Error> netlist_warnings(const Circuit& c) {
    std::vector<Error> out;
    warn_about_dangling_nodes(out, c);
    warn_about_sizes(out, c), warn_about_mismatch(out, c), warn_about_equal_chips(out, c), warn_about_missing_ac(out, c),
        warn_about_pulses(out, c), warn_about_tran_times(out, c), warn_about_op_words(out, c);
    if (c.has_directive("tran")) warn_about_initial_conditions(out, c);
    return out;
}

bool varies_with_chip(const Circuit& c) {
    const auto varies = [](const Element& e) { return has_role(e, Role::transistor) || e.waveform.shape == Waveform::Shape::noise; };
    return c.has_random_values || c.options.contains("noisefmax") || std::ranges::any_of(c.elements, varies);
}

std::string_view reason_no_variation(const Circuit& c) {
    if ((!c.mismatch_seed && !c.has_directive("mc")) || varies_with_chip(c)) return "";
    return "all chips are equal, because nothing in the netlist varies: it has no UICM transistor (level=80), no tolerance and no random "
           "value";
}

void warn_about_units(const Statement& s, std::vector<Error>& warnings) {
    const auto check = [&](const Word& w) {
        if (w.kind != Word::Kind::plain) return;
        const auto text = s.text(w);
        const auto number = parse_number(text);
        if (!number || number->suffix.empty()) return;
        if (!equal_ignoring_case(number->suffix, "a") && !equal_ignoring_case(number->suffix, "x") &&
            !s.line.was_capital(w.at + text.size() - number->suffix.size()))
            return;
        const std::string warning = warning_for(unit_of(s.line.text[0]), *number, text);
        if (!warning.empty()) warnings.push_back(error_at(s.location(w), "{}: {}", s.text(0), warning));
    };
    for (std::size_t k = 3; k < s.words.size(); ++k) check(s.words[k]);  // after the name and two nodes
    for (const auto& pair : s.pairs)
        if (s.text(pair.name) == "r" || s.text(pair.name) == "c") check(pair.value);
}

}  // namespace corpuscle::circuit
