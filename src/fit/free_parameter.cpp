#include "fit/free_parameter.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/number/elementary.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr double default_span = 20;  // ratio of the default bounds to the start

/// "f_B" of "sa1.f_B": the part after a dot that follows a name of the plan.
std::string_view without_afferent(const AfferentPlan& plan, std::string_view name) {
    const auto dot = name.rfind('.');
    return dot != name.npos && equal_ignoring_case(name.substr(0, dot), plan.name) ? name.substr(dot + 1) : name;
}

/// The parameter with this name, as free as its range allows.
Result<FreeParameter> find_free_parameter(const AfferentPlan& plan, std::string_view typed) {
    const auto name = without_afferent(plan, typed);
    std::vector<std::string_view> names;
    for (std::size_t k = 0; k < plan.values.size(); ++k) {
        const auto& info = (*plan.parameters)[k].info;
        if (info.name == name)
            return FreeParameter{k,        std::string(info.name), std::string(info.unit), plan.values[k], info.low, info.high, info.low,
                                 info.high};
        names.push_back(info.name);
    }
    return bad_input(fmt::format("{}: unknown parameter '{}'{} (it has {})", plan.name, typed, did_you_mean(name, names), joined(names)));
}

/// Sets the bounds "LOW:HIGH" of a parameter whose present bounds are its range.
Result<void> set_bounds(FreeParameter& parameter, std::string_view text, const std::string& typed) {
    const auto colon = text.find(':');
    if (colon == text.npos) return bad_usage(fmt::format("--bounds {}: write NAME=LOW:HIGH, such as f_B=5Hz:50Hz", typed));
    double ends[2];
    for (const int k : {0, 1}) {
        const auto end = parse_quantity(k == 0 ? text.substr(0, colon) : text.substr(colon + 1), parameter.unit);
        if (!end) return bad_usage(fmt::format("--bounds {}: {}", typed, end.error().message));
        ends[k] = *end;
    }
    if (!(ends[0] < ends[1])) return bad_usage(fmt::format("--bounds {}: the first must be below the second", typed));
    if (ends[0] < parameter.low || ends[1] > parameter.high)
        return bad_usage(fmt::format("--bounds {}: outside the range of {}, [{:g}, {:g}] {}", typed, parameter.name, parameter.low,
                                     parameter.high, parameter.unit));
    parameter.low = ends[0], parameter.high = ends[1];
    return {};
}

Result<void> set_default_bounds(FreeParameter& parameter) {
    if (!(parameter.start > 0))
        return bad_usage(fmt::format(
            "--free {0}: its value is {1}, which says nothing about its scale; give its bounds, such as --bounds "
            "{0}={2}",
            parameter.name, format_quantity(parameter.start, parameter.unit), parameter.unit == "s" ? "0.2ms:5ms" : "LOW:HIGH"));
    parameter.low = std::max(parameter.low, parameter.start / default_span);
    parameter.high = std::min(parameter.high, parameter.start * default_span);
    return {};
}

}  // namespace

double FreeParameter::width() const { return is_logarithmic() ? num::log(high / low) : 1; }

double FreeParameter::unbounded_value(double x) const { return is_logarithmic() ? low * num::exp(x * width()) : low + x * (high - low); }

double FreeParameter::value(double x) const { return std::clamp(unbounded_value(std::clamp(x, 0.0, 1.0)), low, high); }

std::string FreeParameter::wider_bounds(bool upper) const {
    double from = low, to = high;
    if (upper)
        to = std::min(range_high, is_logarithmic() ? high * default_span : high + (high - low));
    else
        from = std::max(range_low, is_logarithmic() ? low / default_span : low - (high - low));
    return from < low || to > high ? fmt::format("{:.6g}:{:.6g}", from, to) : "";
}

double FreeParameter::coordinate(double of) const {
    of = std::clamp(of, low, high);
    return std::clamp(is_logarithmic() ? num::log(of / low) / width() : (of - low) / (high - low), 0.0, 1.0);
}

Result<std::vector<FreeParameter>> free_parameters(const AfferentPlan& plan, std::span<const std::string> names,
                                                   std::span<const std::string> bounds) {
    std::vector<FreeParameter> out;
    std::vector<bool> has_bounds;
    const auto add = [&](std::string_view name) -> Result<std::size_t> {
        auto parameter = TRY(find_free_parameter(plan, name));
        for (std::size_t k = 0; k < out.size(); ++k)
            if (out[k].index == parameter.index) return k;
        return out.push_back(std::move(parameter)), has_bounds.push_back(false), out.size() - 1;
    };
    for (const auto& name : names) TRY(add(name));
    for (const auto& text : bounds) {
        const auto equals = text.find('=');
        if (equals == text.npos) return bad_usage(fmt::format("--bounds {}: write NAME=LOW:HIGH, such as f_B=5Hz:50Hz", text));
        const auto k = TRY(add(std::string_view(text).substr(0, equals)));
        if (has_bounds[k]) return bad_usage(fmt::format("--bounds {}: {} has bounds already", text, out[k].name));
        TRY(set_bounds(out[k], std::string_view(text).substr(equals + 1), text));
        has_bounds[k] = true;
    }
    for (std::size_t k = 0; k < out.size(); ++k)
        if (!has_bounds[k]) TRY(set_default_bounds(out[k]));
    return out;
}

AfferentPlan plan_at(const AfferentPlan& plan, std::span<const FreeParameter> parameters, std::span<const double> coordinates) {
    auto out = plan;
    for (std::size_t k = 0; k < parameters.size(); ++k) out.values[parameters[k].index] = parameters[k].value(coordinates[k]);
    return out;
}

}  // namespace corpuscle
