#include "reproduction/thesis/bias/bias_sweep.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/quantity.hpp"
#include "reproduction/claims/claim.hpp"

namespace corpuscle {
namespace {

constexpr double k_over_q = 1.380649e-23 / 1.602176634e-19;  // V/K

double parameter(const NetlistResult& found, std::string_view name) { return found.circuit->parameters.find(name)->second; }

std::string dc_directive(BiasAxis axis, const std::string& range) {
    constexpr const char* swept[] = {"ibias", "vdd", "temp"};  // in the order of BiasAxis
    return fmt::format(".dc {} {}", swept[static_cast<int>(axis)], range);
}

/// Drain-source saturation voltage (V) of a transistor whose forward current is `current` (A): phi_t (sqrt(1 + i_f) + 3).
double saturation_voltage(const circuit::Circuit& c, std::string_view name, double current) {
    const auto& element = c.elements[static_cast<std::size_t>(c.find_element(name))];
    const auto& card = c.models[static_cast<std::size_t>(element.model)].values;
    const auto value_of = [](const circuit::Values& values, std::string_view key) { return values.find(key)->second; };
    const double kelvin = c.temperature + 273.15, temperature_ratio = kelvin / (value_of(card, "tnom") + 273.15);
    const double aspect =
        value_of(element.values, "w") / value_of(element.values, "l") * value_of(element.values, "m") / value_of(element.values, "stack");
    const double i_f = current / (value_of(card, "isq") * std::pow(temperature_ratio, value_of(card, "tis")) * aspect);
    return k_over_q * kelvin * (std::sqrt(1 + i_f) + 3);
}

}  // namespace

Result<BiasSweep> BiasSweep::run(BiasAxis axis, std::vector<std::string> settings) {
    constexpr const char* ranges[] = {"10n 3u 2n", "0.4 0.9 2m", "-100 150 5"};
    return run(axis, ranges[static_cast<int>(axis)], std::move(settings));
}

Result<BiasSweep> BiasSweep::run(BiasAxis axis, const std::string& range, std::vector<std::string> settings) {
    auto found = TRY(run_study_netlist({"bias", settings, dc_directive(axis, range)}));
    return BiasSweep{axis, std::move(settings), std::move(found)};
}

StudyCurve BiasSweep::curve(const std::string& name) const { return netlist_result.curve("dc", name); }

StudyCurve BiasSweep::voltage_error() const {
    auto out = V_Q();
    const auto supply = curve("v(vdd)");
    for (std::size_t k = 0; k < out.x.size(); ++k) out.y[k] = std::abs(out.y[k] - supply.y[k] / 2) / bias_voltage_margin;
    return out;
}

StudyCurve BiasSweep::current_error() const {
    auto out = I_Q();
    for (std::size_t k = 0; k < out.x.size(); ++k) {
        const double I_BIAS = axis == BiasAxis::current ? out.x[k] : parameter(netlist_result, "i_bias");
        out.y[k] = std::abs(out.y[k] / I_BIAS - 1) / bias_current_margin;
    }
    return out;
}

StudyCurve BiasSweep::worst_error() const {
    auto out = voltage_error();
    const auto other = current_error();
    for (std::size_t k = 0; k < out.x.size(); ++k) out.y[k] = std::max(out.y[k], other.y[k]);
    return out;
}

namespace {

/// The range around the smallest `error` where it is at most 1.
BiasSweep::Range range_within_limits(const StudyCurve& error) {
    const auto best = static_cast<std::size_t>(std::min_element(error.y.begin(), error.y.end()) - error.y.begin());
    if (error.y.empty() || error.y[best] > 1) return {Claim::none, Claim::none, false, false};
    std::size_t low = best, high = best;
    while (low > 0 && error.y[low - 1] <= 1) --low;
    while (high + 1 < error.y.size() && error.y[high + 1] <= 1) ++high;
    // interpolates where the error is 1, between a point in the range and its neighbour out of it
    const auto edge = [&](std::size_t in, std::size_t out) {
        return error.x[in] + (error.x[out] - error.x[in]) * (1 - error.y[in]) / (error.y[out] - error.y[in]);
    };
    const bool reaches_start = low == 0, reaches_end = high + 1 == error.x.size();
    return {reaches_start ? error.x[low] : edge(low, low - 1), reaches_end ? error.x[high] : edge(high, high + 1), reaches_start,
            reaches_end};
}

}  // namespace

BiasSweep::Range BiasSweep::working_range() const { return range_within_limits(worst_error()); }

BiasSweep::Range BiasSweep::described_range() const {
    auto error = curve("v(bn)");
    const auto supply = curve("v(vdd)");
    constexpr double middle = (described_V_BN[0] + described_V_BN[1]) / 2, half = (described_V_BN[1] - described_V_BN[0]) / 2;
    for (std::size_t k = 0; k < error.x.size(); ++k) {
        const double I_BIAS = error.x[k], V_BN = error.y[k];
        const double M3B = saturation_voltage(*netlist_result.circuit, "m3b", I_BIAS) / (supply.y[k] - V_BN),
                     M4A = saturation_voltage(*netlist_result.circuit, "m4a", I_BIAS) / V_BN;
        error.y[k] = std::max({std::abs(V_BN - middle) / half, M3B, M4A});
    }
    return range_within_limits(error);
}

double BiasSweep::Range::covered_fraction(double min, double max) const {
    return std::max(0.0, std::min(to, max) - std::max(from, min)) / (max - min);
}

BiasSweep::Range range_intersection(const BiasSweep::Range& a, const BiasSweep::Range& b) {
    return {std::max(a.from, b.from), std::min(a.to, b.to), a.reaches_sweep_start && b.reaches_sweep_start,
            a.reaches_sweep_end && b.reaches_sweep_end};
}

Result<BiasState> simulate_bias_state(const std::vector<std::string>& settings) {
    const auto found = TRY(run_study_netlist({"bias", settings, ".op\n.save i(m3b) i(m4a)"}));
    const auto at = [&](const char* name) { return found.operating_point(name); };
    BiasState out{at("v(q)"),
                  at("i(vis)"),
                  at("v(bn)"),
                  at("v(bp)"),
                  at("v(ref)"),
                  at("v(vdd)") - at("v(bn)"),
                  at("v(bn)"),
                  0,
                  0,
                  0,
                  parameter(found, "i_bias")};
    out.V_sat_M3B = saturation_voltage(*found.circuit, "m3b", out.I_BIAS);
    out.V_sat_M4A = saturation_voltage(*found.circuit, "m4a", out.I_BIAS);
    out.bulk_current = -at("i(m3b)") - at("i(m4a)");
    return out;
}

std::string BiasState::description() const {
    const auto volts = [](double v) { return format_quantity(v, "V"); };
    return fmt::format(
        "at this point V_Q is {} and I_Q is {}; M4A has V_DS {} and saturates at {}, M3B has V_DS {} and saturates at {}; the bulk "
        "junctions take {:.2g} % of I_BIAS from BN",
        volts(V_Q), format_quantity(I_Q, "A"), volts(V_M4A), volts(V_sat_M4A), volts(V_M3B), volts(V_sat_M3B), 100 * bulk_current / I_BIAS);
}

std::string bias_setting(BiasAxis axis, double value) {
    constexpr const char* names[] = {"i_bias", "supply", "temp"};
    return fmt::format("{}={}", names[static_cast<int>(axis)], value);
}

}  // namespace corpuscle
