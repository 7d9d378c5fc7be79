#include "sweep/spec/mismatch_samples.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "circuit/device/uicm_card.hpp"
#include "circuit/devices.hpp"

namespace corpuscle {
namespace {

using MismatchJson = nlohmann::ordered_json;

constexpr const char* device_columns[] = {"name", "number", "type", "W", "L", "m", "stack", "sigma_VT", "sigma_IS"};

MismatchJson json_of(const MismatchDevice& d) {
    return {d.name, d.number, d.pmos ? "pmos" : "nmos", d.W, d.L, d.m, d.stack, d.sigma_VT, d.sigma_IS};
}

MismatchDevice device_from(const MismatchJson& row) {
    return {row.at(0), row.at(1), row.at(2) == "pmos", row.at(3), row.at(4), row.at(5), row.at(6), row.at(7), row.at(8)};
}

double number_or(const circuit::Values& values, std::string_view name, double fallback) {
    const auto at = values.find(name);
    return at == values.end() ? fallback : at->second;
}

}  // namespace

std::vector<MismatchDevice> mismatch_devices(const circuit::Circuit& circuit) {
    const circuit::UicmInstance instance_defaults;
    const circuit::UicmCard card_defaults;
    std::vector<MismatchDevice> out;
    for (const auto& e : circuit.elements) {
        if (!has_role(e, circuit::Role::transistor)) continue;
        const auto& model = circuit.models[static_cast<std::size_t>(e.model)];
        MismatchDevice d{e.name, static_cast<std::uint32_t>(out.size()), model.type == "pmos"};
        d.W = number_or(e.values, "w", instance_defaults.W), d.L = number_or(e.values, "l", instance_defaults.L);
        d.m = number_or(e.values, "m", instance_defaults.m), d.stack = number_or(e.values, "stack", instance_defaults.stack);
        d.sigma_VT = number_or(model.values, "avt", card_defaults.A_VT) / std::sqrt(d.area());
        d.sigma_IS = number_or(model.values, "ais", card_defaults.A_IS) / std::sqrt(d.area());
        out.push_back(std::move(d));
    }
    return out;
}

std::string format_mismatch_samples(const MismatchSamples& samples) {
    MismatchJson out = {{"seed", samples.seed}, {"chips", samples.chips}};
    out["columns"] = device_columns;
    out["subjects"] = MismatchJson::array();
    for (const auto& s : samples.subjects) {
        MismatchJson devices = MismatchJson::array();
        for (const auto& d : s.devices) devices.push_back(json_of(d));
        out["subjects"].push_back({{"name", s.name}, {"devices", std::move(devices)}});
    }
    return out.dump(-1, ' ', false, MismatchJson::error_handler_t::replace);  // a name may contain any bytes
}

Result<MismatchSamples> parse_mismatch_samples(const std::string& text) {
    try {
        const auto in = MismatchJson::parse(text);
        MismatchSamples out{in.at("seed"), in.at("chips"), {}};
        for (const auto& s : in.at("subjects")) {
            out.subjects.push_back({s.at("name"), {}});
            for (const auto& row : s.at("devices")) out.subjects.back().devices.push_back(device_from(row));
        }
        return out;
    } catch (const MismatchJson::exception& e) {
        return bad_input(fmt::format("the sweep's mismatch samples cannot be read: {}", e.what()));
    }
}

DeviceDeviates deviates_of(const MismatchDevice& device, std::uint64_t seed, const std::vector<std::uint64_t>& chips) {
    circuit::UicmCard card;  // with A_VT = A_IS = 1 and an area of 1 m^2, the standard deviations are 1, so the shifts are the deviates
    card.A_VT = 1, card.A_IS = 1;
    const circuit::UicmInstance size{.W = 1, .L = 1};
    DeviceDeviates out;
    out.V_T.reserve(chips.size()), out.I_S.reserve(chips.size());
    for (const auto chip : chips) {
        const auto shift = circuit::sample_mismatch(card, size, seed, device.number, chip);
        out.V_T.push_back(shift.V_T), out.I_S.push_back(std::log(shift.factor));
    }
    return out;
}

}  // namespace corpuscle
