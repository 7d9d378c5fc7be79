#include "circuit/netlist/settings/set_lines.hpp"

#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// Calls on_value(statement, pair, name, value) for each value of the .set lines.
Result<void> for_each_value(const ParsedNetlist& parsed, const auto& on_value) {
    for (const auto* s : parsed.set_lines) {
        if (s->words.size() > 1 || s->pairs.empty())
            return error_at(s->location(1), ".set: expected NAME=NUMBER, such as i_bias=100n or xamp.mn1.m=4");
        TRY(check_duplicates(*s));
        for (const auto& pair : s->pairs) {
            const auto number = parse_number(s->text(pair.value));
            if (!number || !std::isfinite(number->value))
                return error_at(s->location(pair.value), ".set: '{}' is not a number; write one such as 100n", s->text(pair.value));
            TRY(on_value(*s, pair, s->text(pair.name), number->value));
        }
    }
    return {};
}

/// The element with this full path, and the parameter after it ("": its value). Null if there is no such element.
std::pair<const Element*, std::string_view> element_of(const Circuit& circuit, std::string_view name) {
    const auto find = [&](std::string_view path) {
        const int k = circuit.find_element(path);
        return k < 0 ? nullptr : &circuit.elements[static_cast<std::size_t>(k)];
    };
    if (const auto* element = find(name)) return {element, ""};
    const auto dot = name.rfind('.');
    if (dot == std::string_view::npos) return {nullptr, ""};
    return {find(name.substr(0, dot)), name.substr(dot + 1)};
}

Result<void> check_element_value(const Statement& s, const NameValue& pair, const Element& e, std::string_view parameter, double value) {
    std::vector<std::string_view> known;
    for (const auto& p : kind_of(e).parameters) {
        if (e.expression && !p.works_with_expression) continue;
        if (!p.name.empty()) known.push_back(p.name);
        if (parameter.empty() ? !p.is_value : p.name != parameter) continue;
        if (value >= p.low && value <= p.high && !(p.excludes_zero && value == 0)) return {};
        return error_at(s.location(pair.value), ".set: {} is not allowed for {}", format_quantity(value, p.unit), s.text(pair.name));
    }
    if (parameter.empty()) return error_at(s.location(pair.name), ".set: {} has no single value; set one of {}", e.name, joined(known));
    return error_at(s.location(pair.name), ".set: {} has no '{}'{} (it has {})", e.name, parameter, did_you_mean(parameter, known),
                    joined(known));
}

}  // namespace

Result<ResolvedOverrides> add_set_lines(const ParsedNetlist& parsed, const ResolvedOverrides& overrides) {
    auto out = overrides;
    TRY(for_each_value(parsed, [&](const Statement&, const NameValue&, std::string_view name, double value) -> Result<void> {
        // emplace() does not replace what the overrides give. Which names are elements is not known yet: a name that is none has no effect.
        if (parsed.top.parameters.contains(name)) return out.parameters.emplace(name, value), Result<void>();
        out.numbers[std::string(name)].emplace("", value);
        if (const auto dot = name.rfind('.'); dot != std::string_view::npos)
            out.numbers[std::string(name.substr(0, dot))].emplace(name.substr(dot + 1), value);
        return {};
    }));
    return out;
}

Result<void> check_set_lines(const ParsedNetlist& parsed, const Circuit& circuit) {
    return for_each_value(parsed, [&](const Statement& s, const NameValue& pair, std::string_view name, double value) -> Result<void> {
        if (parsed.top.parameters.contains(name)) return {};
        const auto [element, parameter] = element_of(circuit, name);
        if (element) return check_element_value(s, pair, *element, parameter, value);
        std::vector<std::string_view> known;
        for (const auto& [parameter_name, text] : parsed.top.parameters) known.push_back(parameter_name);
        for (const auto& e : circuit.elements) known.push_back(e.name);
        return error_at(s.location(pair.name), ".set: there is no .param or device '{}' (a device needs its full path){}", name,
                        did_you_mean(name, known));
    });
}

}  // namespace corpuscle::circuit
