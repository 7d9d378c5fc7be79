#include "circuit/export/kit_arrays.hpp"

#include <cmath>

#include "circuit/device/named_values.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view uicm_level[] = {"level"};
constexpr double max_stack = 1000;
/// Smaller shifts of a threshold (V) are rounding errors of a sum that cancels.
constexpr double min_shift = 1e-9;

bool is_pmos(KitDevice d) { return d == KitDevice::pch || d == KitDevice::hv_pch; }
bool is_hv(KitDevice d) { return d == KitDevice::hv_nch || d == KitDevice::hv_pch; }
KitDevice standard_device(bool pmos) { return pmos ? KitDevice::pch : KitDevice::nch; }
bool is_uicm(const Model& m) { return (m.type == "nmos" || m.type == "pmos") && value_or(m.values, "level", 1) == UicmCard::level; }

/// The name of a model without the path of its subcircuit.
std::string last_name(const Model& m) { return lower(m.name.substr(m.name.rfind('.') + 1)); }

double threshold_of(const Model& m) { return value_or(m.values, "vto", UicmCard{}.V_T0); }

/// The device of the kit for a role: the higher threshold if the kit has it.
KitDevice available_device(const KitMap& map, KitDevice role) { return map.device(role).empty() ? standard_device(is_pmos(role)) : role; }

std::string number(double x) { return fmt::format("{:.12g}", x); }

/// Area and perimeter of a terminal of one unit: the outer ones are the array's, the inner ones are half of a region that two units share.
struct Terminal {
    double area, perimeter;
};
Terminal outer_terminal(double W, double L_dif, double area, double perimeter) {
    return {area < 0 ? W * L_dif : area, perimeter < 0 ? 2 * (W + L_dif) : perimeter};
}

}  // namespace

Result<KitDevice> KitArrays::role_of(const Model& m) const {
    const bool pmos = m.type == "pmos";
    const auto name = last_name(m);
    const auto mapped = kit_.map.models.find(name);
    if (mapped == kit_.map.models.end())
        return !name.ends_with("_hv") ? standard_device(pmos) : pmos ? KitDevice::hv_pch : KitDevice::hv_nch;
    if (is_pmos(mapped->second) == pmos) return mapped->second;
    return error_at(m.location, "model {} is {}, but the map '{}' has it as {}; write {} in [models]", m.name, m.type, kit_.map.name,
                    kit_device_names[static_cast<std::size_t>(mapped->second)], pmos ? "pch or hv_pch" : "nch or hv_nch");
}

Result<double> KitArrays::threshold_shift(const Element& e, KitDevice role) const {
    const double own = value_or(e.values, "delvto", 0);
    const auto& model = *circuit_.model_of(e);
    if (!is_hv(role) || !kit_.map.device(role).empty()) return own;
    const Model* standard = nullptr;
    for (const auto& m : circuit_.models)
        if (is_uicm(m) && m.type == model.type && TRY(role_of(m)) == standard_device(is_pmos(role)))
            if (standard == nullptr || last_name(m) + "_hv" == last_name(model)) standard = &m;
    const auto name = kit_device_names[static_cast<std::size_t>(role)];
    if (standard != nullptr) return own + threshold_of(model) - threshold_of(*standard);
    if (kit_.map.hv_shift) return own + *kit_.map.hv_shift;
    return error_at(e.location,
                    "{}: the kit has no {}, and the netlist no other model of {} from which its threshold differs; name one, --{} NAME, or "
                    "write the difference in a map: hv_shift = \"0.15 V\"",
                    e.name, name, model.type, role == KitDevice::hv_nch ? "hv-nch" : "hv-pch");
}

Result<std::string> KitArrays::parameters(const Element& e, const UicmInstance& size, double shift) const {
    const auto& map = kit_.map;
    std::string out = fmt::format("w={} l={}", number(size.W / map.length_unit), number(size.L / map.length_unit));
    for (const auto& m : map.multipliers) out += fmt::format(" {}={}", m, number(size.m));
    const bool is_negative = circuit_.model_of(e)->type == "pmos" && map.pmos_threshold_is_negative;
    if (shift != 0) out += fmt::format(" {}={}", map.threshold, number(is_negative ? -shift : shift));
    const auto without_counterpart = [&](std::string_view name, std::string_view remedy) {
        return error_at(e.location, "{}: {} has no counterpart in the map '{}'; leave it out, or write {} in a map", e.name, name, map.name,
                        remedy);
    };
    if (size.m != 1 && map.multipliers.empty()) return without_counterpart("m", "multiplier = [\"m\"]");
    if (size.mulu0 != 1) {
        if (map.mobility.empty()) return without_counterpart("mulu0", "mobility = \"mulu0\"");
        out += fmt::format(" {}={}", map.mobility, number(size.mulu0));
    }
    for (const std::string_view name : {"temp", "dtemp"}) {
        const auto at = e.values.find(name);
        if (at == e.values.end()) continue;
        if (!map.has_temperature) return without_counterpart(name, "temperature = true");
        out += fmt::format(" {}={}", name, number(at->second));
    }
    return out;
}

std::string KitArrays::chain(const UicmInstance& size, double L_dif, const std::string& gate, const std::string& device) const {
    const auto drain = outer_terminal(size.W, L_dif, size.AD, size.PD), source = outer_terminal(size.W, L_dif, size.AS, size.PS);
    const Terminal inner{size.W * L_dif / 2, size.W + L_dif};
    const double u = kit_.map.length_unit;
    const auto last = static_cast<int>(size.stack);
    std::string out;
    for (int k = 1; k <= last; ++k) {
        const auto d = k == 1 ? "d" : fmt::format("n{}", k - 1), s = k == last ? "s" : fmt::format("n{}", k);
        out += fmt::format("{}{} {} {} {} b {}", kit_.map.is_subcircuit ? 'x' : 'm', k, d, gate, s, device);
        const auto &at_d = k == 1 ? drain : inner, &at_s = k == last ? source : inner;
        if (kit_.map.has_areas)
            out += fmt::format(" ad={} as={} pd={} ps={}", number(at_d.area / (u * u)), number(at_s.area / (u * u)),
                               number(at_d.perimeter / u), number(at_s.perimeter / u));
        out += '\n';
    }
    return out;
}

Result<std::string> KitArrays::body(const Element& e) const {
    const auto& model = *circuit_.model_of(e);
    const auto card = TRY(read_model_card<UicmCard>(UicmCard::fields, model, uicm_level));
    const auto role = TRY(role_of(model));
    const auto& device = kit_.map.device(available_device(kit_.map, role));
    if (device.empty())
        return error_at(e.location, "{}: the kit has no device for {}; name it: --{} NAME", e.name, model.type,
                        is_pmos(role) ? "pch" : "nch");
    UicmInstance size;
    for (const auto& f : UicmInstance::fields) size.*f.member = value_or(e.values, f.name, size.*f.member);
    if (size.stack != std::floor(size.stack) || size.stack > max_stack)
        return error_at(e.location, "{}: stack={} cannot be a chain of transistors; write a whole number up to {}", e.name, size.stack,
                        max_stack);
    double shift = TRY(threshold_shift(e, role));
    if (std::abs(shift) < min_shift) shift = 0;
    const bool has_source = shift != 0 && kit_.map.threshold.empty();
    const auto values = TRY(parameters(e, size, has_source ? 0 : shift));
    const auto units = chain(size, card.L_dif, has_source ? "gate" : "g", device + ' ' + values);
    return has_source ? fmt::format("vt {} {}\n{}", is_pmos(role) ? "gate g" : "g gate", number(shift), units) : units;
}

Result<std::string> KitArrays::instance(const Element& e, const std::string& head) {
    const auto body = TRY(this->body(e));
    const auto [at, is_new] = names_.try_emplace(body, fmt::format("corpuscle_array_{}", names_.size() + 1));
    if (is_new) text_ += fmt::format(".subckt {} d g s b\n{}.ends\n", at->second, body);
    return fmt::format("{} {}\n", head, at->second);
}

}  // namespace corpuscle::circuit
