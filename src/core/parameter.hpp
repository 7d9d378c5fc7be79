#pragma once
// Each parameter is declared once, in a row of a table. Command line, JSON, reference pages and checks are generated from these rows.

#include <optional>
#include <span>
#include <string>
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

/// Requires that one parameter is below another parameter of the struct P.
template <class P>
struct OrderConstraint {
    std::string_view lower_name;
    double P::* lower_member;
    std::string_view upper_name;
    double P::* upper_member;
    bool or_equal = false;  ///< true: equal values are allowed
};

/// The declaration of a parameter without the type of its struct. The members are those of ParameterDef.
struct ParameterInfo {
    std::string_view name, unit;
    double default_value;
    double low, high;
    std::string_view description;
    std::string_view source;  ///< publication of the default; "": the source of the catalogue entry
    bool is_shared_by_copies = false;
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

template <class M>  // M: a component of a model, or a stimulus, with the members name, description, source, Params and fields
CatalogEntry catalog_entry_of() {
    return {M::name, M::description, M::source, parameters_of<typename M::Params>(M::fields)};
}

/// Returns an error if the value is outside the parameter's range: "lif-b: C_m = -1 F is outside [1e-15, 1]". `owner` is the component or
/// stimulus that has the parameter.
Result<void> check_range(std::string_view owner, const ParameterInfo&, double value);

/// Returns an error if the value `lower` is not below `upper` (with `or_equal`: if it is above `upper`): "lif-b: V_reset = 0.6 must be
/// below V_th = 0.5".
Result<void> check_order(std::string_view owner, std::string_view lower_name, double lower, std::string_view upper_name, double upper,
                         bool or_equal);

template <class P>
Result<void> check_order(std::string_view owner, std::span<const OrderConstraint<P>> constraints, const P& p) {
    for (const auto& c : constraints) TRY(check_order(owner, c.lower_name, p.*c.lower_member, c.upper_name, p.*c.upper_member, c.or_equal));
    return {};
}

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
