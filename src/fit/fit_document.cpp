#include "fit/fit_document.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

/// NaN and infinity have no form in JSON.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
template <class T>
Json optional(const std::optional<T>& x) {
    return x ? Json(*x) : Json(nullptr);
}

Json document_of(const FittedParameter& p) {
    return {{"name", p.parameter.name},        {"unit", p.parameter.unit},
            {"start", p.parameter.start},      {"value", p.value},
            {"low", optional(p.low)},          {"high", optional(p.high)},
            {"identified", p.low.has_value()}, {"bounds", {p.parameter.low, p.parameter.high}},
            {"at_bound", p.is_at_bound}};
}

Json document_of(const ParameterTrade& t) {
    Json change = Json::object();
    for (const auto& [name, factor] : t.factors) change[name] = factor;
    return {{"change", change}, {"score_change", number(t.score_change)}};
}

Json document_of(const FitRow& r) {
    return {{"data", r.data},
            {"measure", r.measure},
            {"unit", r.unit},
            {"target", number(r.target)},
            {"low", optional(r.low)},
            {"high", optional(r.high)},
            {"fitted", number(r.fitted)},
            {"within", optional(r.is_within())},
            {"set", r.is_test ? "test" : "train"},
            {"source", r.source}};
}

template <class T>
Json list_of(const std::vector<T>& all) {
    Json out = Json::array();
    for (const auto& x : all) out.push_back(document_of(x));
    return out;
}

}  // namespace

Json document_of(const FitResult& result, const std::string& score_meaning) {
    return {{"afferent", result.plan.name},
            {"parameters", list_of(result.parameters)},
            {"trades", list_of(result.trades)},
            {"score",
             {{"start", number(result.start_score)},
              {"train", number(result.score)},
              {"test", optional(result.test_score)},
              {"meaning", score_meaning}}},
            {"rows", list_of(result.rows)},
            {"search",
             {{"evaluations", result.evaluations},
              {"starts", result.starts},
              {"agreeing_starts", result.agreeing_starts},
              {"interrupted", result.is_interrupted}}},
            {"warnings", result.warnings}};
}

std::string settings_file(const FitResult& result, const std::string& command) {
    std::string out = fmt::format(
        "# Written by '{0}'.\n# This is a sweep file; its [set] may also be the [class.set] of a [[class]] of a population file whose "
        "afferent is {1}.\n\n"
        "afferent = \"{1}\"\n\n[set]\n",
        command, result.plan.name);
    for (const auto& p : result.parameters) {
        const auto interval = p.low ? fmt::format("{:.4g} to {:.4g}", *p.low, *p.high) : std::string("not identified");
        out += fmt::format("{} = {:.6g}  # {}{}{}\n", p.parameter.name, p.value, p.parameter.unit, p.parameter.unit.empty() ? "" : ", ",
                           interval);
    }
    return out;
}

std::vector<std::string> fitted_settings(const FitResult& result) {
    std::vector<std::string> out;
    for (const auto& p : result.parameters) out.push_back(fmt::format("{}.{}={:.6g}", result.plan.name, p.parameter.name, p.value));
    return out;
}

std::string settings_options(const FitResult& result) {
    auto out = fmt::format("--afferent {}", result.plan.name);
    for (const auto& setting : fitted_settings(result)) out += " --set " + setting;
    return out;
}

}  // namespace corpuscle
