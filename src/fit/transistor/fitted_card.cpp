#include "fit/transistor/fitted_card.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

using circuit::UicmCard;
using Json = nlohmann::ordered_json;

constexpr std::size_t line_length = 120;
constexpr double without_effect = 1e20;  // an Early voltage above it has no effect

/// The lines of a .model, each but the first beginning with +.
std::string model_lines(const UicmCard& card, bool is_pmos, const std::string& name) {
    std::string out, line = fmt::format(".model {} {} (level={:g}", name, is_pmos ? "pmos" : "nmos", UicmCard::level);
    for (const auto& f : UicmCard::fields) {
        const auto word = fmt::format(" {}={}", f.name, card.*f.member);
        if (line.size() + word.size() > line_length) out += line + "\n", line = "+";
        line += word;
    }
    return out + line + ")\n";
}

std::string quantity(double x, std::string_view unit) { return x >= without_effect ? "infinity" : format_quantity(x, unit); }

std::string value_comment(const FittedCardValue& v) {
    const auto more = v.is_given    ? ", as given"
                      : v.is_fitted ? ", 95 % interval " + card_interval_text(v)
                                    : ", not determined: " + v.reason;
    return fmt::format("* {} = {}{}\n", v.card_name, card_value_text(v), more);
}

Json json_of(const FittedCardValue& v) {
    Json out = {{"name", v.name}, {"card", v.card_name}, {"value", v.value}, {"unit", v.unit}, {"fitted", v.is_fitted}};
    out["low"] = v.low ? Json(*v.low) : Json(), out["high"] = v.high ? Json(*v.high) : Json();
    if (v.is_at_bound) out["at_bound"] = true;
    if (!v.reason.empty()) out["not_determined"] = v.reason;
    return out;
}

}  // namespace

std::string card_value_text(const FittedCardValue& v) { return v.value >= without_effect ? "infinite" : format_quantity(v.value, v.unit); }

std::string card_interval_text(const FittedCardValue& v) {
    if (v.is_given) return "as given";
    return v.is_fitted ? fmt::format("{} to {}", quantity(*v.low, v.unit), quantity(*v.high, v.unit)) : "not determined";
}

std::string percent_text(double fraction) { return fmt::format("{:.2g} %", 100 * fraction); }

std::string card_text(const TransistorFit& fit, const std::string& model_name, const std::string& command) {
    std::string out = fmt::format("{}: a UICM card from I-V curves.\n* {}\n", card_signature, command);
    out += fmt::format("* Differences of the drain current: rms {}, largest {}, in {} points.\n", percent_text(fit.misfit.rms),
                       percent_text(fit.misfit.largest), fit.misfit.points);
    for (const auto& v : fit.values) out += value_comment(v);
    out += "* Capacitances, flicker noise and all other values are not fitted: set them with --set, such as --set cox=8m.\n";
    return out + model_lines(fit.card, fit.is_pmos, model_name);
}

Json document_of(const TransistorFit& fit, const IvData& data) {
    Json out = {{"type", fit.is_pmos ? "pmos" : "nmos"}, {"points", data.points.size()}, {"devices", data.devices.size()}};
    out["parameters"] = Json::array();
    for (const auto& v : fit.values) out["parameters"].push_back(json_of(v));
    const auto& m = fit.misfit;
    out["misfit"] = {{"points", m.points}, {"rms", m.rms}, {"largest", m.largest}, {"scatter", m.scatter}};
    out["misfit"]["gm_over_ID"] = m.gm_over_ID ? Json(*m.gm_over_ID) : Json();
    out["misfit"]["bulk_rms"] = m.bulk_rms ? Json(*m.bulk_rms) : Json();
    out["misfit"]["chi_squared"] = m.chi_squared ? Json(*m.chi_squared) : Json();
    out["noise"] = {{"relative", fit.drain_noise.relative}, {"floor", fit.drain_noise.floor}};
    out["converged"] = fit.is_converged;
    out["notes"] = fit.notes;
    out["card"] = Json::object();
    for (const auto& f : UicmCard::fields) out["card"][std::string(f.name)] = fit.card.*f.member;
    for (std::size_t d = 0; d < fit.shifts.size(); ++d)
        out["deviations"].push_back({{"device", data.devices[d].name},
                                     {"W", data.devices[d].W},
                                     {"L", data.devices[d].L},
                                     {"V_T", fit.shifts[d].V_T},
                                     {"log_I_S", fit.shifts[d].log_I_S}});
    return out;
}

}  // namespace corpuscle
