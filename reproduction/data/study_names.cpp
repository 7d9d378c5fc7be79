#include "reproduction/data/study_names.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/parameter.hpp"
#include "reproduction/claims/check_all.hpp"
#include "reproduction/data/study_functions.hpp"

namespace corpuscle {

Result<StudyValue> StudyNames::value(const LocatedText& expression, std::size_t scope) {
    return evaluate_study_expression(expression.text, expression.location, visible_in(scope));
}

Result<double> StudyNames::number(const LocatedText& expression, std::size_t scope) {
    const auto found = TRY(value(expression, scope));
    if (const auto* number = std::get_if<double>(&found)) return *number;
    return expression.error_here(fmt::format("'{}' is {}; expected a number", expression.text, kind_of(found).name));
}

Result<std::string> StudyNames::text(const LocatedText& text, std::size_t scope) {
    return fill_study_text(text.text, text.location, visible_in(scope));
}

StudyLookup StudyNames::visible_in(std::size_t scope) {
    return [this, scope](const std::string& name) { return find(name, scope); };
}

Result<StudyValue> StudyNames::find(const std::string& name, std::size_t scope) {
    for (auto s = scope; s != StudyScope::no_scope; s = file_.scopes[s].outer)
        if (const auto found = file_.scopes[s].definitions.find(name); found != file_.scopes[s].definitions.end())
            return defined_value(name, found->second, s);
    if (const auto found = globals_.find(name); found != globals_.end()) return found->second;
    if (const auto* constant = find_study_constant(name)) return *constant;
    return bad_input(fmt::format("unknown name '{}'{}", name, did_you_mean(name, known_names(scope))));
}

std::vector<std::string_view> StudyNames::known_names(std::size_t scope) const {
    std::vector<std::string_view> out;
    for (auto s = scope; s != StudyScope::no_scope; s = file_.scopes[s].outer)
        for (const auto& [name, definition] : file_.scopes[s].definitions) out.push_back(name);
    for (const auto& [name, value] : globals_) out.push_back(name);
    return out;
}

Result<StudyValue> StudyNames::defined_value(const std::string& name, const StudyDefinition& definition, std::size_t scope) {
    auto& computed = computed_[scope];
    if (const auto found = computed.find(name); found != computed.end()) return found->second;
    if (!in_progress_.insert({scope, name}).second) return bad_input(fmt::format("the value '{}' depends on itself", name));
    auto result = compute(definition, scope);
    in_progress_.erase({scope, name});
    if (result) computed[name] = *result;
    return result;
}

Result<StudyValue> StudyNames::compute(const StudyDefinition& definition, std::size_t scope) {
    if (!definition.pairs.empty()) return curve_of(definition, scope);
    if (!definition.is_text) return value(definition.expression, scope);
    auto filled = TRY(text(definition.expression, scope));
    return StudyValue(std::move(filled));
}

/// The curve of a definition with `each`, without the pairs whose y is NaN.
Result<StudyValue> StudyNames::curve_of(const StudyDefinition& definition, std::size_t scope) {
    StudyCurve out;
    for (const auto& [x_text, y_text] : definition.pairs) {
        const auto x = number(x_text, scope), y = number(y_text, scope);
        TRY(check_all(x, y));
        if (!std::isnan(*y)) out.x.push_back(*x), out.y.push_back(*y);
    }
    return StudyValue(std::move(out));
}

}  // namespace corpuscle
