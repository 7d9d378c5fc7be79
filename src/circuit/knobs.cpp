#include "circuit/knobs.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "circuit/device/uicm_card.hpp"
#include "circuit/path_names.hpp"
#include "signal/quantity.hpp"
#include "signal/text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view own_words[] = {"corner", "temp", "mismatch"};

Error refused(const Knob& knob, std::string_view why) { return bad_input(fmt::format("{}: {}", knob.said, why)); }

/// One number that can be set of an element: w of an M, dtemp of an R; "" is its value.
struct Number {
    std::string_view name, unit;
    double low, high;
};

constexpr double any = std::numeric_limits<double>::max();

std::vector<Number> numbers_of(const Element& e) {
    if (e.letter == 'm') {
        std::vector<Number> out;
        for (const auto& f : UicmInstance::fields) out.push_back({f.name, f.unit, f.low, f.high});
        out.push_back({"temp", "", -273, 500}), out.push_back({"dtemp", "", -500, 500});
        return out;
    }
    constexpr double above_zero = std::numeric_limits<double>::min();
    const Number m{"m", "", above_zero, any}, tc1{"tc1", "", -any, any}, tc2{"tc2", "", -any, any}, temp{"temp", "", -273, 500},
        dtemp{"dtemp", "", -500, 500};
    switch (e.letter) {
        case 'r':
            return {{"", "ohm", -any, any}, {"r", "ohm", -any, any}, m, tc1, tc2, temp, dtemp};
        case 'c':
            if (e.formula) return {m};
            return {{"", "F", 0, any}, {"c", "F", 0, any}, m, tc1, tc2, temp, dtemp};
        case 'l':
            return {{"", "", 0, any}, {"l", "", 0, any}, m, tc1, tc2, temp, dtemp};
        case 'v':
            return {{"", "V", -any, any}, {"dc", "V", -any, any}};
        case 'i':
            return {{"", "A", -any, any}, {"dc", "A", -any, any}};
        case 'd':
            return {{"area", "", above_zero, any}, m, temp, dtemp};
        case 'b':
            return {};
        default:
            if (e.formula) return {};
            return {{"", "", -any, any}};
    }
}

bool has_number(const Element& e, std::string_view name) {
    const auto all = numbers_of(e);
    return std::any_of(all.begin(), all.end(), [&](const Number& n) { return n.name == name; });
}

/// "8x4" as 8 and 4.
std::optional<std::pair<double, double>> array_of(std::string_view text) {
    const auto cross = text.find_first_of("xX");
    if (cross == std::string_view::npos) return {};
    const auto columns = parse_quantity(text.substr(0, cross), ""), units = parse_quantity(text.substr(cross + 1), "");
    if (!columns || !units) return {};
    return std::pair(*columns, *units);
}

/// Finds what knobs mean in one circuit, and writes it into changes.
class Tuning {
    const Circuit& circuit_;
    const std::vector<std::string>& parameters_;
    Changes& changes_;
    std::vector<std::string_view> names_;  // of the elements

public:
    Tuning(const Circuit& circuit, const std::vector<std::string>& parameters, Changes& changes)
        : circuit_(circuit), parameters_(parameters), changes_(changes) {
        for (const auto& e : circuit.elements) names_.push_back(e.name);
    }

    Result<void> turn(const Knob& knob) {
        const auto whole = meant(names_, knob.name, Last::element);
        if (whole.size() == 1) return device(knob, element(whole[0]), "");
        const auto dot = knob.name.rfind('.');
        if (dot != std::string::npos) {
            const auto of = meant(names_, std::string_view(knob.name).substr(0, dot), Last::element);
            if (of.size() == 1) return device(knob, element(of[0]), lower(std::string_view(knob.name).substr(dot + 1)));
            if (whole.empty() && of.size() > 1) return several(knob, knob.name.substr(0, dot), of);
        }
        return whole.empty() ? unknown(knob) : several(knob, knob.name, whole);
    }

private:
    const Element& element(std::size_t k) const { return circuit_.elements[k]; }

    Error several(const Knob& knob, std::string_view typed, const std::vector<std::size_t>& found) const {
        std::vector<std::string_view> names;
        for (const auto k : found) names.push_back(names_[k]);
        return refused(knob, fmt::format("'{}' may be {}; write more of its path", typed, some_of(names)));
    }

    Error unknown(const Knob& knob) const {
        const auto pieces = pieces_in(knob.name);
        std::vector<std::string> known(std::begin(own_words), std::end(own_words));
        known.insert(known.end(), parameters_.begin(), parameters_.end());
        const auto typed = lower(knob.name);
        const auto dot = typed.rfind('.');
        for (const auto& e : circuit_.elements) {
            known.push_back(short_name(e.name, pieces, Last::element));
            if (dot != std::string::npos && has_number(e, std::string_view(typed).substr(dot + 1)))
                known.push_back(short_name(e.name, pieces - 1, Last::element) + typed.substr(dot));
        }
        const std::vector<std::string_view> views(known.begin(), known.end());
        const std::vector<std::string_view> params(parameters_.begin(), parameters_.end());
        return refused(
            knob,
            fmt::format("{} has no parameter or device '{}'{} (it has {}corner, temp, mismatch, and {} devices, such as {})", circuit_.file,
                        knob.name, did_you_mean(typed, views), params.empty() ? "" : fmt::format("{}, ", fmt::join(params, ", ")),
                        names_.size(), names_.empty() ? "none" : short_name(names_.back(), pieces_in(names_.back()), Last::element)));
    }

    Result<void> device(const Knob& knob, const Element& e, std::string_view number) {
        if (number.empty() && e.letter == 'm') return array(knob, e);
        const auto known = numbers_of(e);
        const auto at = std::find_if(known.begin(), known.end(), [&](const Number& n) { return n.name == number; });
        if (at == known.end()) return no_such(knob, e, number, known);
        if (at->name.empty() || at->name == "dc")
            if (const auto shape = e.waveform.shape; shape != Waveform::Shape::none && shape != Waveform::Shape::force)
                return refused(knob, fmt::format("{} goes a course in time, which has more than one number", e.name));
        auto value = parse_quantity(knob.value, at->unit);
        if (!value) return refused(knob, value.error().sentence);
        return put(knob, e, *at, *value);
    }

    Error no_such(const Knob& knob, const Element& e, std::string_view number, const std::vector<Number>& known) const {
        std::vector<std::string_view> names;
        for (const auto& n : known)
            if (!n.name.empty()) names.push_back(n.name);
        if (number.empty() || names.empty())
            return refused(knob,
                           fmt::format("{} is {}; no one number is its value", e.name, e.formula ? "a formula" : "not of one number"));
        return refused(knob,
                       fmt::format("{} has no '{}'{} (it has {})", e.name, number, did_you_mean(number, names), fmt::join(names, ", ")));
    }

    Result<void> array(const Knob& knob, const Element& e) {
        const auto size = array_of(knob.value);
        if (!size || size->first != std::floor(size->first) || size->second != std::floor(size->second))
            return refused(knob, fmt::format("'{}' is no array; write columns x units in series, such as 8x4, or set {}.w, {}.l ...",
                                             knob.value, knob.name, knob.name));
        for (const auto& n : numbers_of(e)) {
            if (n.name == "m" && !(size->first >= 1)) return refused(knob, fmt::format("{} columns; there is at least one", size->first));
            if (n.name == "stack" && !(size->second >= 1))
                return refused(knob, fmt::format("{} units in series; there is at least one", size->second));
            if (n.name != "m" && n.name != "stack") continue;
            if (auto ok = put(knob, e, n, n.name == "m" ? size->first : size->second); !ok) return ok;
        }
        return {};
    }

    /// r of an R is its value, under another name.
    Result<void> put(const Knob& knob, const Element& e, const Number& number, double value) {
        const bool own = number.name == "dc" || number.name == std::string_view(&e.letter, 1);
        if (!(value >= number.low && value <= number.high))
            return refused(
                knob, number.high == any && number.low >= 0
                          ? fmt::format("{} must {}", format_quantity(value, number.unit), number.low > 0 ? "be above 0" : "not be below 0")
                          : fmt::format("{} is outside [{}, {}]", format_quantity(value, number.unit),
                                        format_quantity(number.low, number.unit), format_quantity(number.high, number.unit)));
        if (e.letter == 'r' && (own || number.name.empty()) && value == 0) return refused(knob, "a resistor of 0 ohm");
        changes_.numbers[e.name].insert_or_assign(own && e.letter != 'm' ? "" : std::string(number.name), value);
        return {};
    }
};

Result<double> temperature_of(const Knob& knob) {
    auto text = trimmed(knob.value);
    for (const std::string_view unit : {"degC", "\u00b0C", "C"})
        if (text.ends_with(unit)) {
            text.remove_suffix(unit.size());
            break;
        }
    const auto value = parse_quantity(text, "");
    if (!value) return refused(knob, fmt::format("'{}' is no temperature; write degrees Celsius, such as 85", knob.value));
    if (!(*value > -273.15 && *value <= 500)) return refused(knob, fmt::format("{:g} C is outside (-273.15, 500]", *value));
    return *value;
}

/// "7", or "7/41": a seed, and the number of the chip, from 0.
Result<std::pair<std::uint64_t, std::uint64_t>> chip_of(const Knob& knob) {
    const std::string_view text = knob.value;
    const auto slash = text.find('/');
    std::uint64_t out[2] = {};
    for (std::size_t k = 0; k < (slash == text.npos ? 1u : 2u); ++k) {
        const auto value = parse_quantity(k == 0 ? text.substr(0, slash) : text.substr(slash + 1), "");
        if (!value || !(*value >= 0 && *value < 0x1p53) || *value != std::floor(*value))
            return refused(knob, fmt::format("'{}' is no seed; write a whole number from 0 to 2^53, or SEED/CHIP", knob.value));
        out[k] = static_cast<std::uint64_t>(*value);
    }
    return std::pair(out[0], out[1]);
}

/// The error of a corner that no library has, under the knob's own name.
Error of_corner(std::span<const Knob> knobs, const std::string& corner, Error error) {
    if (error.sentence.find(fmt::format("no corner '{}'", corner)) == std::string::npos &&
        error.sentence.find(fmt::format("there is no corner '{}'", corner)) == std::string::npos)
        return error;
    for (const auto& knob : knobs)
        if (lower(knob.name) == "corner") error.sentence = fmt::format("{}: {}", knob.said, error.sentence);
    return error;
}

Result<void> set_parameter(const Knob& knob, const std::string& name, Changes& changes) {
    const auto value = number_with_unit(knob.value);
    if (!value) return refused(knob, value.error().sentence);
    changes.parameters.insert_or_assign(name, value->value);
    return {};
}

}  // namespace

Result<Measured> number_with_unit(std::string_view text) {
    const auto plain = parse_quantity(text, "");
    if (plain) return Measured{*plain, ""};
    for (const std::string_view unit : {"V", "A", "F", "ohm", "s", "Hz", "m", "S", "N"})
        if (const auto value = parse_quantity(text, unit)) return Measured{*value, unit};
    const auto example = "write a number and a unit of V, A, F, ohm, s, Hz or none, such as 4pF (M is mega, m milli)";
    return bad_input(fmt::format("'{}' is no number; {}", text, example));
}

Result<Netlist> tuned(const std::string& name_or_path, std::span<const Knob> knobs) {
    return tuned([&](const std::string& corner) { return open_netlist(name_or_path, corner); }, name_or_path, knobs);
}

Result<Netlist> tuned(const NetlistOpener& open, const std::string& name, std::span<const Knob> knobs) {
    Changes changes;
    for (const auto& knob : knobs)
        if (lower(knob.name) == "corner") {
            changes.corner = lower(trimmed(knob.value));
            if (changes.corner.empty()) return refused(knob, "no corner is named, such as ss");
        }
    const auto netlist = open(changes.corner);
    if (!netlist) return of_corner(knobs, changes.corner, netlist.error());
    std::vector<std::string> parameters;
    for (const auto& [own, text] : netlist->parameters()) parameters.push_back(own);
    std::vector<const Knob*> devices;
    for (const auto& knob : knobs) {
        const auto what = lower(knob.name);
        if (what == "corner") continue;
        if (what == "temp") {
            const auto value = temperature_of(knob);
            if (!value) return value.error();
            changes.temperature = *value;
        } else if (what == "mismatch") {
            const auto chip = chip_of(knob);
            if (!chip) return chip.error();
            changes.mismatch = chip->first, changes.chip = chip->second;
        } else if (std::find(parameters.begin(), parameters.end(), what) != parameters.end()) {
            if (auto ok = set_parameter(knob, what, changes); !ok) return ok.error();
        } else if (knob.parameter_alone) {
            const std::vector<std::string_view> known(parameters.begin(), parameters.end());
            return refused(knob, fmt::format("{} has no .param {}{}", name, what, did_you_mean(what, known)));
        } else {
            devices.push_back(&knob);
        }
    }
    if (devices.empty()) return netlist->with(std::move(changes));
    const auto circuit = netlist->with(changes).elaborate();
    if (!circuit) return circuit.error();
    Tuning tuning(*circuit, parameters, changes);
    for (const auto* knob : devices)
        if (auto ok = tuning.turn(*knob); !ok) return ok.error();
    return netlist->with(std::move(changes));
}

}  // namespace corpuscle::circuit
