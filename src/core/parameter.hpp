#pragma once
// Each parameter is declared once, in a row of a table. Command line, JSON, reference pages and checks are generated from these rows.

#include <iterator>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// Declares one parameter: a member of the struct P. Its default is the member's initial value in P.
template <class P>
struct ParameterDef {
    std::string_view name;
    double P::* member;
    std::string_view unit;  ///< an SI unit; "" for a dimensionless number
    double low, high;       ///< the allowed range in `unit`, ends included
    std::string_view description;
    std::string_view source = {};      ///< publication of the default; "": the source of the model or stimulus
    bool is_shared_by_copies = false;  ///< true if all copies of an afferent must have the same value, as for numerical options
};

/// The declaration of a parameter. The members are those of ParameterDef.
struct ParameterInfo {
    std::string_view name, unit;
    double default_value;
    double low, high;
    std::string_view description;
    std::string_view source = {};  ///< publication of the default; "": the source of the catalogue entry
    bool is_shared_by_copies = false;
};

/// A parameter of M, a component of a model, by its name. The compiler refuses a name that M::parameters does not contain.
template <class M>
struct ParameterName {
    std::size_t index = 0;  ///< in M::parameters
    consteval ParameterName(const char* name) {
        while (M::parameters[index].name != name) ++index;
    }
};

/// A constraint on the parameters of a model: the value of `lower` must be below the value of `upper`.
struct ParameterOrder {
    std::string_view lower, upper;  ///< names of parameters
    bool or_equal = false;          ///< true: the two values may also be equal
};

/// An entry of a catalogue, for example of the stimuli.
struct CatalogEntry {
    std::string_view name, description, source;  ///< source: publication of the model or stimulus
    std::vector<ParameterInfo> parameters;
};

/// The name of a parameter and its new value, in the parameter's unit.
struct Setting {
    std::string_view name;
    double value;
};

template <class P>
std::vector<ParameterInfo> parameters_of(std::span<const ParameterDef<P>> fields) {
    const P initial;
    std::vector<ParameterInfo> rows;
    for (const auto& f : fields)
        rows.push_back({f.name, f.unit, initial.*f.member, f.low, f.high, f.description, f.source, f.is_shared_by_copies});
    return rows;
}

/// M: a component of a model, with the members name, description, source and parameters; or a stimulus, with Params and fields instead of
/// the last.
template <class M>
CatalogEntry catalog_entry_of() {
    if constexpr (requires { M::parameters; })
        return {M::name, M::description, M::source, {std::begin(M::parameters), std::end(M::parameters)}};
    else
        return {M::name, M::description, M::source, parameters_of<typename M::Params>(M::fields)};
}

/// Returns an error if the value is outside the parameter's range: "lif-b: C_m = -1 F is outside [1e-15, 1]". `owner` is the component or
/// stimulus that has the parameter.
Result<void> check_range(std::string_view owner, const ParameterInfo&, double value);

/// Returns an error if the values of two parameters violate a constraint: "lif-b: V_reset = 0.6 must be below V_th = 0.5".
Result<void> check_order(std::string_view owner, const ParameterOrder&, double lower, double upper);

/// The end of an error message that suggests the one of `names` that is most similar to the mistyped name: "; did you mean 'out'?". "" if
/// none is similar.
std::string did_you_mean(std::string_view typed, std::span<const std::string_view> names);

/// The default parameters with the settings applied. Settings of parameters that P does not have are ignored: they may belong to the other
/// component of the model.
template <class P>
P with_settings(std::span<const ParameterDef<P>> fields, std::span<const Setting> settings) {
    P p;
    for (const auto& s : settings)
        for (const auto& f : fields)
            if (f.name == s.name) p.*f.member = s.value;
    return p;
}

}  // namespace corpuscle
