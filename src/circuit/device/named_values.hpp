#pragma once
// Named parameter values of an element or a model.

#include "circuit/netlist/netlist.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {

/// The value with this name; `fallback` if there is none.
inline double value_or(const Values& values, std::string_view name, double fallback) {
    const auto at = values.find(name);
    return at == values.end() ? fallback : at->second;
}

/// The value with this name of an element, else of its model, else the fallback.
inline double value_or_of_model(const Circuit& c, const Element& e, std::string_view name, double fallback) {
    const Model* model = c.model_of(e);
    return value_or(e.values, name, model ? value_or(model->values, name, fallback) : fallback);
}

/// The temperature of an element, C.
inline double celsius_of(const Circuit& c, const Element& e) {
    return value_or(e.values, "temp", c.temperature + value_or(e.values, "dtemp", 0));
}

/// Rejects a parameter name that is not in `known`. `owner`: name of the element or model.
inline Result<void> check_value_names(std::string_view owner, const Values& values, std::span<const std::string_view> known,
                                      const SourceLocation& location) {
    for (const auto& [name, value] : values)
        if (std::find(known.begin(), known.end(), name) == known.end())
            return error_at(location, "{}: unknown parameter '{}'{}", owner, name, did_you_mean(name, known));
    return {};
}

/// Sets a field of a card to a value, which must be in its range. `owner`: name of the element or model.
template <class P>
Result<void> read_field(const ParameterDef<P>& f, P& card, std::string_view owner, double value, const SourceLocation& location) {
    const ParameterInfo info{f.name, f.unit, card.*f.member, f.low, f.high, f.description, {}};
    if (const auto ok = check_range(owner, info, value); !ok) return bad_input(ok.error().message, location);
    card.*f.member = value;
    return {};
}

/// The names of the parameters in `fields`, which must be in small letters, and `others`.
template <class P, std::size_t N>
std::vector<std::string_view> model_value_names(const ParameterDef<P> (&fields)[N], std::span<const std::string_view> others) {
    std::vector<std::string_view> out(others.begin(), others.end());
    for (const auto& f : fields) out.push_back(f.name);
    return out;
}

/// Reads the parameters in `fields` from a .model line; the others keep their defaults. Names in `others` are accepted but not read here.
template <class P, std::size_t N>
Result<P> read_model_card(const ParameterDef<P> (&fields)[N], const Model& model, std::span<const std::string_view> others) {
    P card;
    std::vector<std::string_view> known(others.begin(), others.end());
    std::vector<std::string> names;
    for (const auto& f : fields) names.push_back(lower(f.name));
    known.insert(known.end(), names.begin(), names.end());
    TRY(check_value_names(model.name, model.values, known, model.location));
    for (std::size_t k = 0; k < N; ++k)
        if (const auto given = model.values.find(names[k]); given != model.values.end())
            TRY(read_field(fields[k], card, model.name, given->second, model.location));
    return card;
}

}  // namespace corpuscle::circuit
