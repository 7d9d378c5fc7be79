#include "fit/transistor/parameter_choice.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/ascii_text.hpp"

namespace corpuscle {

using circuit::UicmCard;

namespace {

bool is_mismatch_name(std::string_view name) {
    return std::ranges::any_of(mismatch_parameters(), [name](const MismatchParameter& m) {
        return equal_ignoring_case(name, m.name) || equal_ignoring_case(name, m.card_name);
    });
}

Error refusal(std::string_view card_name, const std::string& reason) {
    return bad_input(fmt::format("--fit {}: these data do not determine it: {}", card_name, reason));
}

}  // namespace

Result<void> ParameterChoice::check_names() const {
    for (const auto& name : request_.fit) {
        if (const auto* p = find_card_parameter(name); p && is_given(p->card_name))
            return bad_usage(fmt::format("--fit {}: but --set gives its value; leave out one of the two", name));
        if (equal_ignoring_case(name, "all") || find_card_parameter(name) || is_mismatch_name(name)) continue;
        std::vector<std::string_view> known = {"all"};
        for (const auto& p : card_parameters()) known.push_back(p.card_name);
        for (const auto& m : mismatch_parameters()) known.push_back(m.card_name);
        return bad_usage(fmt::format("--fit {}: curves do not determine such a parameter; there are {}", name, joined(known)));
    }
    return {};
}

bool ParameterChoice::is_given(std::string_view card_name) const {
    return std::ranges::find(request_.given, card_name) != request_.given.end();
}

ParameterRole ParameterChoice::role(std::string_view name, std::string_view card_name, bool is_optional) const {
    bool has_all = std::ranges::all_of(request_.fit, is_mismatch_name);  // mismatch alone is fitted beside the card
    for (const auto& one : request_.fit) {
        if (equal_ignoring_case(one, "all")) has_all = true;
        const auto* p = find_card_parameter(one);
        if (equal_ignoring_case(one, name) || equal_ignoring_case(one, card_name) || (p && p->card_name == card_name))
            return ParameterRole::required;
    }
    return has_all && !is_optional && !is_given(card_name) ? ParameterRole::if_determined : ParameterRole::left_out;
}

Result<void> ParameterChoice::leave_out(const CardParameter& p, UicmCard& card, const std::string& reason) {
    if (role(p) == ParameterRole::required) return refusal(p.card_name, reason);
    if (!std::isnan(p.no_effect) && !is_given(p.card_name)) card.*p.member = p.no_effect;
    undetermined_.push_back({.name = std::string(p.name),
                             .card_name = std::string(p.card_name),
                             .unit = std::string(p.unit),
                             .value = card.*p.member,
                             .reason = reason});
    return {};
}

Result<void> ParameterChoice::leave_out(const MismatchParameter& m, const UicmCard& card, const std::string& reason) {
    if (role(m) == ParameterRole::required) return refusal(m.card_name, reason);
    if (role(m) == ParameterRole::if_determined)
        undetermined_.push_back({.name = std::string(m.name),
                                 .card_name = std::string(m.card_name),
                                 .unit = std::string(m.unit),
                                 .value = card.*m.member,
                                 .reason = reason});
    return {};
}

Result<std::vector<const CardParameter*>> ParameterChoice::choose(const DataCoverage& coverage, UicmCard& card) {
    std::vector<const CardParameter*> out;
    for (const auto& p : card_parameters()) {
        const auto wanted = role(p);
        if (wanted == ParameterRole::left_out) continue;
        const auto reason = missing_data(coverage, p.card_name);
        // Without a size, I_SQ stands for I_SQ W / L, which the current determines.
        const bool is_only_I_S = p.card_name == "isq" && !coverage.is_geometry_known && wanted != ParameterRole::required;
        if (reason.empty() || is_only_I_S)
            out.push_back(&p);
        else
            TRY(leave_out(p, card, reason));
    }
    for (const auto& m : mismatch_parameters())
        if (const auto reason = missing_data(coverage, m.card_name); !reason.empty()) TRY(leave_out(m, card, reason));
    if (out.empty()) return bad_input("these data determine no parameter; measure a sweep of V_G from weak to strong inversion");
    return out;
}

}  // namespace corpuscle
