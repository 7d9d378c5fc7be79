#pragma once
// The values that an element or a model was given by name.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/netlist/netlist.hpp"
#include "signal/field.hpp"
#include "signal/text.hpp"

namespace corpuscle::circuit {

inline double value_or(const Values& values, std::string_view name, double otherwise) {
    const auto at = values.find(name);
    return at == values.end() ? otherwise : at->second;
}

/// Refuses a name that is not among those known.
inline std::optional<Error> unknown_value(std::string_view of, const Values& values, std::span<const std::string_view> known,
                                          const Place& place) {
    for (const auto& [name, value] : values)
        if (std::find(known.begin(), known.end(), name) == known.end())
            return bad_input(fmt::format("{}: no parameter is called '{}'{}", of, name, did_you_mean(name, known)), place);
    return {};
}

/// A model's card from what its .model line says; names in `others` are known, and left to the caller.
template <class P, std::size_t N>
Result<P> card_from(const Field<P> (&fields)[N], const Model& model, std::initializer_list<std::string_view> others) {
    P card;
    std::vector<std::string_view> known(others);
    std::vector<std::string> names;
    for (const auto& f : fields) names.push_back(lower(f.name));
    known.insert(known.end(), names.begin(), names.end());
    if (auto wrong = unknown_value(model.name, model.values, known, model.place)) return *wrong;
    for (std::size_t k = 0; k < N; ++k) {
        const auto said = model.values.find(names[k]);
        if (said == model.values.end()) continue;
        const Row row{fields[k].name, fields[k].unit, card.*fields[k].at, fields[k].low, fields[k].high, fields[k].sentence, {}};
        if (auto wrong = outside(model.name, row, said->second)) return bad_input(wrong->sentence, model.place);
        card.*fields[k].at = said->second;
    }
    return card;
}

}  // namespace corpuscle::circuit
