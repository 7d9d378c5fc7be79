// The list of all kinds of devices. To add one, write its file in circuit/device/ and add its name to the two lists below.

#include "circuit/devices.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle::circuit {

extern const DeviceKind resistor_kind, capacitor_kind, inductor_kind, coupling_kind, voltage_source_kind, current_source_kind,
    voltage_controlled_voltage_kind, current_controlled_current_kind, voltage_controlled_current_kind, current_controlled_voltage_kind,
    expression_source_kind, voltage_switch_kind, current_switch_kind, diode_kind, bipolar_kind, mos1_kind, ekv_kind, transistor_kind;

namespace {

constexpr const DeviceKind* all_kinds[] = {&resistor_kind,
                                           &capacitor_kind,
                                           &inductor_kind,
                                           &coupling_kind,
                                           &voltage_source_kind,
                                           &current_source_kind,
                                           &voltage_controlled_voltage_kind,
                                           &current_controlled_current_kind,
                                           &voltage_controlled_current_kind,
                                           &current_controlled_voltage_kind,
                                           &expression_source_kind,
                                           &voltage_switch_kind,
                                           &current_switch_kind,
                                           &diode_kind,
                                           &bipolar_kind,
                                           &mos1_kind,
                                           &ekv_kind,
                                           &transistor_kind};

}  // namespace

constinit const std::span<const DeviceKind* const> device_kinds = all_kinds;

bool has_level(const DeviceKind& kind, double level) {
    return kind.level == level || std::find(kind.other_levels.begin(), kind.other_levels.end(), level) != kind.other_levels.end();
}

const DeviceKind* find_device_kind(char letter, std::optional<double> level) {
    const DeviceKind* first = nullptr;
    for (const auto* kind : device_kinds) {
        if (kind->letter != letter) continue;
        if (level && has_level(*kind, *level)) return kind;
        if (first == nullptr) first = kind;
    }
    return first;
}

std::string supported_levels(char letter) {
    const auto listed = [](const std::vector<std::string>& texts) {
        std::string out;
        for (std::size_t k = 0; k < texts.size(); ++k) out += (k == 0 ? "" : k + 1 == texts.size() ? " or " : ", ") + texts[k];
        return out;
    };
    std::vector<std::string> kinds;
    for (const auto* kind : device_kinds) {
        if (kind->letter != letter) continue;
        std::vector<std::string> levels = {fmt::format("{:g}", kind->level)};
        for (const double level : kind->other_levels) levels.push_back(fmt::format("{:g}", level));
        const auto comma = kind->description.find(", ");  // "MOS transistor, UICM"
        kinds.push_back(fmt::format("{} ({})", listed(levels), kind->description.substr(comma == std::string_view::npos ? 0 : comma + 2)));
    }
    return "level=" + listed(kinds);
}

std::string element_letters() {
    std::string out;
    for (const auto* kind : device_kinds)
        if (find_device_kind(kind->letter) == kind) (out += static_cast<char>(kind->letter - 'a' + 'A')) += ' ';
    return out + 'X';
}

}  // namespace corpuscle::circuit
