#include "circuit/variant/netlist_overrides.hpp"

#include "circuit/devices.hpp"
#include "circuit/variant/hierarchical_names.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/embedded_files.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view reserved_names[] = {"corner", "temp", "mismatch"};

template <class... Arguments>
Error error_of(const ParameterOverride& setting, fmt::format_string<Arguments...> why, Arguments&&... arguments) {
    return error_at(setting.location, "{}: {}", setting.typed, fmt::format(why, std::forward<Arguments>(arguments)...));
}

/// The parameters of an element that can be set.
std::vector<ElementParameter> parameters_of(const Element& e) {
    std::vector<ElementParameter> out;
    for (const auto& p : kind_of(e).parameters)
        if (!e.expression || p.works_with_expression) out.push_back(p);
    return out;
}

/// The parameter with this name; "" is the element's value. The end of `all` if there is none.
auto find_parameter(const std::vector<ElementParameter>& all, std::string_view name) {
    return std::find_if(all.begin(), all.end(), [&](const ElementParameter& p) { return p.name == name || (name.empty() && p.is_value); });
}

bool has_parameter(const Element& e, std::string_view name) {
    const auto all = parameters_of(e);
    return find_parameter(all, name) != all.end();
}

/// Reads "8x4", an array of 8 columns of 4 units in series, as (8, 4); nothing if the text has another form.
std::optional<std::pair<double, double>> array_of(std::string_view text) {
    const auto cross = text.find_first_of("xX");
    if (cross == std::string_view::npos) return {};
    const auto columns = parse_quantity(text.substr(0, cross), ""), units = parse_quantity(text.substr(cross + 1), "");
    if (!columns || !units) return {};
    return std::pair(*columns, *units);
}

/// Finds the devices that overrides name in a circuit, and adds their new values to `changes`.
class OverrideResolver {
    const Circuit& circuit_;
    const std::vector<std::string>& parameters_;  // names of the top level's .param lines, for error messages
    ResolvedOverrides& changes_;
    std::vector<std::string_view> names_;  // of the elements

public:
    OverrideResolver(const Circuit& circuit, const std::vector<std::string>& parameters, ResolvedOverrides& changes)
        : circuit_(circuit), parameters_(parameters), changes_(changes) {
        for (const auto& e : circuit.elements) names_.push_back(e.name);
    }

    /// A name is tried as a device first, then as a device and its parameter.
    Result<void> apply(const ParameterOverride& setting) {
        const auto elements = find_matching_names(names_, setting.parameter, LastPiece::element);
        if (elements.size() == 1) return override_device(setting, element(elements[0]), "");
        const auto dot = setting.parameter.rfind('.');
        if (dot != std::string::npos) {
            const auto owners = find_matching_names(names_, std::string_view(setting.parameter).substr(0, dot), LastPiece::element);
            if (owners.size() == 1)
                return override_device(setting, element(owners[0]), lower(std::string_view(setting.parameter).substr(dot + 1)));
            if (elements.empty() && owners.size() > 1) return ambiguous_name(setting, setting.parameter.substr(0, dot), owners);
        }
        return elements.empty() ? unknown(setting) : ambiguous_name(setting, setting.parameter, elements);
    }

private:
    const Element& element(std::size_t k) const { return circuit_.elements[k]; }

    Error ambiguous_name(const ParameterOverride& setting, std::string_view typed, const std::vector<std::size_t>& found) const {
        std::vector<std::string_view> names;
        for (const auto k : found) names.push_back(names_[k]);
        return error_of(setting, "'{}' is ambiguous: {}; write more of its path", typed, abbreviated_list(names));
    }

    /// The error for a name that is neither a parameter nor a device.
    Error unknown(const ParameterOverride& setting) const {
        const auto pieces = piece_count(setting.parameter);
        std::vector<std::string> known(std::begin(reserved_names), std::end(reserved_names));
        known.insert(known.end(), parameters_.begin(), parameters_.end());
        const auto typed = lower(setting.parameter);
        const auto dot = typed.rfind('.');
        for (const auto& e : circuit_.elements) {
            known.push_back(short_name(e.name, pieces, LastPiece::element));
            if (dot != std::string::npos && has_parameter(e, std::string_view(typed).substr(dot + 1)))
                known.push_back(short_name(e.name, pieces - 1, LastPiece::element) + typed.substr(dot));
        }
        return error_of(setting,
                        "{} has no parameter or device '{}'{} (it has {}corner, temp, mismatch, numbers of .options such as reltol, and {} "
                        "devices, such as {})",
                        circuit_.file, setting.parameter, did_you_mean(typed, known),
                        parameters_.empty() ? "" : fmt::format("{}, ", joined(parameters_)), names_.size(),
                        names_.empty() ? "none" : short_name(names_.back(), piece_count(names_.back()), LastPiece::element));
    }

    /// Overrides a parameter of a device; "" is the device's value, for a transistor its array.
    Result<void> override_device(const ParameterOverride& setting, const Element& e, std::string_view parameter) {
        if (parameter.empty() && has_role(e, Role::transistor)) return override_array(setting, e);
        const auto known = parameters_of(e);
        const auto at = find_parameter(known, parameter);
        if (at == known.end()) return unknown_parameter(setting, e, parameter, known);
        if (at->is_value)
            if (const auto shape = e.waveform.shape; shape != Waveform::Shape::none && shape != Waveform::Shape::force)
                return error_of(setting, "{} is a source with a time waveform; its value is not a single number", e.name);
        auto value = parse_quantity(setting.value, at->unit);
        if (!value) return error_of(setting, "{}", value.error().message);
        return add_change(setting, e, *at, *value);
    }

    Error unknown_parameter(const ParameterOverride& setting, const Element& e, std::string_view parameter,
                            const std::vector<ElementParameter>& known) const {
        std::vector<std::string_view> names;
        for (const auto& n : known)
            if (!n.name.empty()) names.push_back(n.name);
        if (names.empty()) return error_of(setting, "{} has an expression; its value is not a single number", e.name);
        if (parameter.empty()) return error_of(setting, "{} has no single value; set one of its parameters ({})", e.name, joined(names));
        return error_of(setting, "{} has no '{}'{} (it has {})", e.name, parameter, did_you_mean(parameter, names), joined(names));
    }

    Result<void> override_array(const ParameterOverride& setting, const Element& e) {
        const auto size = array_of(setting.value);
        if (!size || size->first != std::floor(size->first) || size->second != std::floor(size->second))
            return error_of(
                setting, "'{}' is not an array; write COLUMNSxSERIES, such as 8x4 (8 columns of 4 units in series), or set {}.w, {}.l ...",
                setting.value, setting.parameter, setting.parameter);
        for (const auto& n : parameters_of(e)) {
            if (n.name == "m" && !(size->first >= 1)) return error_of(setting, "{} columns; at least 1 is required", size->first);
            if (n.name == "stack" && !(size->second >= 1))
                return error_of(setting, "{} units in series; at least 1 is required", size->second);
            if (n.name != "m" && n.name != "stack") continue;
            TRY(add_change(setting, e, n, n.name == "m" ? size->first : size->second));
        }
        return {};
    }

    /// Adds one value to the changes.
    Result<void> add_change(const ParameterOverride& setting, const Element& e, const ElementParameter& parameter, double value) {
        if (!(value >= parameter.low && value <= parameter.high))
            return error_of(
                setting, "{}",
                parameter.high == unlimited && parameter.low >= 0
                    ? fmt::format("{} must {}", format_quantity(value, parameter.unit), parameter.low > 0 ? "be above 0" : "not be below 0")
                    : fmt::format("{} is outside [{}, {}]", format_quantity(value, parameter.unit),
                                  format_quantity(parameter.low, parameter.unit), format_quantity(parameter.high, parameter.unit)));
        if (parameter.excludes_zero && value == 0)
            return error_of(setting, "a {} must not be {}", kind_of(e).description, format_quantity(0, parameter.unit));
        changes_.numbers[e.name].insert_or_assign(parameter.is_value ? "" : std::string(parameter.name), value);
        return {};
    }
};

Result<double> temperature_of(const ParameterOverride& setting) {
    auto text = trimmed(setting.value);
    for (const std::string_view unit : {"degC", "\u00b0C", "C"})
        if (text.ends_with(unit)) {
            text.remove_suffix(unit.size());
            break;
        }
    const auto value = parse_quantity(text, "");
    if (!value) return error_of(setting, "'{}' is not a temperature; write degrees Celsius, such as 85", setting.value);
    if (!(*value > -273.15 && *value <= 500)) return error_of(setting, "{:g} C is outside (-273.15, 500]", *value);
    return *value;
}

/// Reads "7" or "7/41": a seed, and the number of the chip, counted from 0 (the default).
Result<std::pair<std::uint64_t, std::uint64_t>> chip_of(const ParameterOverride& setting) {
    const std::string_view text = setting.value;
    const auto slash = text.find('/');
    std::uint64_t out[2] = {};
    for (std::size_t k = 0; k < (slash == text.npos ? 1u : 2u); ++k) {
        const auto value = parse_quantity(k == 0 ? text.substr(0, slash) : text.substr(slash + 1), "");
        if (!value || !(*value >= 0 && *value < 0x1p53) || *value != std::floor(*value))
            return error_of(setting, "'{}' is not a seed; write an integer from 0 to 2^53, or SEED/CHIP", setting.value);
        out[k] = static_cast<std::uint64_t>(*value);
    }
    return std::pair(out[0], out[1]);
}

/// If the error says that no library has the corner, puts the override's text in front. The texts compared are those of
/// CornerSelector::check_found().
Error with_corner_override(std::span<const ParameterOverride> overrides, const std::string& corner, Error error) {
    if (error.message.find(fmt::format("no corner '{}'", corner)) == std::string::npos &&
        error.message.find(fmt::format("there is no corner '{}'", corner)) == std::string::npos)
        return error;
    for (const auto& setting : overrides)
        if (lower(setting.parameter) == "corner") error.message = fmt::format("{}: {}", setting.typed, error.message);
    return error;
}

Result<void> set_parameter(const ParameterOverride& setting, const std::string& name, ResolvedOverrides& changes) {
    const auto value = parse_number_with_unit(setting.value);
    if (!value) return error_of(setting, "{}", value.error().message);
    changes.parameters.insert_or_assign(name, value->value);
    return {};
}

Result<void> set_option(const ParameterOverride& setting, const std::string& name, ResolvedOverrides& changes) {
    const auto value = parse_number_with_unit(setting.value);
    if (!value) return error_of(setting, "{}", value.error().message);
    if (const auto ok = check_option(name, value->value, {}, setting.location); !ok) return error_of(setting, "{}", ok.error().message);
    changes.options.insert_or_assign(name, value->value);
    return {};
}

/// The overrides for this netlist, with the netlist as target (or none) and the rest of the name as parameter; and the other overrides.
Applied<std::vector<ParameterOverride>> overrides_of_netlist(std::string_view netlist, std::span<const ParameterOverride> overrides) {
    Applied<std::vector<ParameterOverride>> out;
    const bool is_embedded = find_embedded_netlist(netlist) != nullptr;
    for (auto given : overrides) {
        if (given.target.empty()) {
            out.result.push_back(std::move(given));
            continue;
        }
        const auto name = given.name();
        const auto prefix = std::string_view(name).substr(0, netlist.size());
        const bool is_own = name.size() > netlist.size() + 1 && name[netlist.size()] == '.' &&
                            (is_embedded ? equal_ignoring_case(prefix, netlist) : prefix == netlist);
        if (is_own) given.target = netlist, given.parameter = name.substr(netlist.size() + 1);
        (is_own ? out.result : out.unused).push_back(std::move(given));
    }
    return out;
}

}  // namespace

Result<NumberWithUnit> parse_number_with_unit(std::string_view text) {
    const auto plain = parse_quantity(text, "");
    if (plain) return NumberWithUnit{*plain, ""};
    for (const std::string_view unit : {"V", "A", "F", "ohm", "s", "Hz", "m", "S", "N"})
        if (const auto value = parse_quantity(text, unit)) return NumberWithUnit{*value, unit};
    const auto example = "write a number and a unit of V, A, F, ohm, s, Hz, m, S, N or none, such as 4pF (M is mega, m is milli)";
    return bad_input(fmt::format("'{}' is not a number; {}", text, example));
}

Result<ParameterOverride> parse_netlist_override(const std::string& netlist, const std::string& text, std::string_view option) {
    const auto typed = fmt::format("{}{}{}", option, option.empty() ? "" : " ", text);
    const auto equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
        return bad_usage(fmt::format("{}: write NAME=VALUE, such as 'C_u=4pF'", typed));
    return ParameterOverride{netlist, text.substr(0, equals), text.substr(equals + 1), typed};
}

Result<Applied<Netlist>> apply_overrides(const std::string& name_or_path, std::span<const ParameterOverride> overrides) {
    return apply_overrides([&](const std::string& corner) { return open_netlist(name_or_path, corner); }, name_or_path, overrides);
}

Result<Applied<Netlist>> apply_overrides(const NetlistOpener& open, const std::string& name, std::span<const ParameterOverride> all) {
    const auto [overrides, unused] = overrides_of_netlist(name, all);
    ResolvedOverrides changes;
    for (const auto& setting : overrides)
        if (lower(setting.parameter) == "corner") {
            changes.corner = lower(trimmed(setting.value));
            if (changes.corner.empty()) return error_of(setting, "the name of the corner is missing; write one, such as ss");
        }
    const auto netlist = open(changes.corner);
    if (!netlist) return with_corner_override(overrides, changes.corner, netlist.error());
    std::vector<std::string> parameters;
    for (const auto& [parameter, text] : netlist->parameters()) parameters.push_back(parameter);
    std::vector<const ParameterOverride*> device_overrides;
    for (const auto& setting : overrides) {
        const auto lower_name = lower(setting.parameter);
        if (lower_name == "corner") continue;
        if (lower_name == "temp") {
            changes.temperature = TRY(temperature_of(setting));
        } else if (lower_name == "mismatch") {
            const auto chip = TRY(chip_of(setting));
            changes.mismatch_seed = chip.first, changes.chip = chip.second;
        } else if (std::find(parameters.begin(), parameters.end(), lower_name) != parameters.end()) {
            TRY(set_parameter(setting, lower_name, changes));
        } else if (is_numeric_option(lower_name)) {
            TRY(set_option(setting, lower_name, changes));
        } else if (setting.target.empty()) {
            return error_of(setting, "{} has no .param {}{}", name, lower_name, did_you_mean(lower_name, parameters));
        } else {
            device_overrides.push_back(&setting);
        }
    }
    if (device_overrides.empty()) return Applied<Netlist>{netlist->with_overrides(std::move(changes)), unused};
    // The elements have names and values only in a flat circuit, which depends on the overrides so far.
    const auto circuit = TRY(netlist->with_overrides(changes).elaborate());
    OverrideResolver resolver(circuit, parameters, changes);
    for (const auto* setting : device_overrides) TRY(resolver.apply(*setting));
    return Applied<Netlist>{netlist->with_overrides(std::move(changes)), unused};
}

const EmbeddedNetlist* find_embedded_netlist(std::string_view name) {
    for (const auto& c : embedded_netlists)
        if (equal_ignoring_case(c.name, name)) return &c;
    return nullptr;
}

Result<Netlist> open_netlist(const std::string& name_or_path, const std::string& corner) {
    const auto* embedded = find_embedded_netlist(name_or_path);
    if (embedded == nullptr) return Netlist::read(name_or_path, corner);
    auto text = TRY(embedded_text(std::string(embedded->file)));
    return parse_embedded(std::move(text), std::string(embedded->file), corner);
}

Result<Netlist> parse_embedded(std::string text, std::string file, const std::string& corner) {
    return Netlist::parse(std::move(text), std::move(file), embedded_text, corner);
}

}  // namespace corpuscle::circuit
