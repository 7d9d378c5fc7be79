#pragma once
// All kinds of devices, by letter. To add one, write its file in circuit/device/ and add its name to the two lists below.

#include "circuit/device/device_kind.hpp"

namespace corpuscle::circuit {

extern const DeviceKind resistor_kind, capacitor_kind, inductor_kind, coupling_kind, voltage_source_kind, current_source_kind,
    voltage_controlled_voltage_kind, current_controlled_current_kind, voltage_controlled_current_kind, current_controlled_voltage_kind,
    expression_source_kind, voltage_switch_kind, current_switch_kind, diode_kind, bipolar_kind, mos1_kind, ekv_kind, transistor_kind;

/// In the order of messages and catalogues.
inline constexpr const DeviceKind* device_kinds[] = {&resistor_kind,
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

/// True if models of this level belong to the kind.
inline bool has_level(const DeviceKind& kind, double level) {
    return kind.level == level || std::find(kind.other_levels.begin(), kind.other_levels.end(), level) != kind.other_levels.end();
}

/// The kind of device of this letter whose models have this level. Without a level, or if no kind has it, the first one of the letter. Null
/// if there is none.
inline const DeviceKind* find_device_kind(char letter, std::optional<double> level = {}) {
    const DeviceKind* first = nullptr;
    for (const auto* kind : device_kinds) {
        if (kind->letter != letter) continue;
        if (level && has_level(*kind, *level)) return kind;
        if (first == nullptr) first = kind;
    }
    return first;
}

/// The levels of the models of a letter: "level=1 (SPICE level 1), 44, 55 or 260 (EKV 2.6) or 80 (UICM)".
inline std::string supported_levels(char letter) {
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

/// "R C L ... X": the letters of all elements, subcircuits included.
inline std::string element_letters() {
    std::string out;
    for (const auto* kind : device_kinds)
        if (find_device_kind(kind->letter) == kind) (out += static_cast<char>(kind->letter - 'a' + 'A')) += ' ';
    return out + 'X';
}

/// The kind of device of an element of a circuit.
inline const DeviceKind& kind_of(const Element& e) { return *e.kind; }

/// True if the current through the element is an unknown of the system.
inline bool has_branch_current(const Element& e) { return kind_of(e).has_branch_current(e); }

inline bool has_role(const Element& e, Role role) { return kind_of(e).role == role; }
inline bool is_independent_source(const Element& e) { return has_role(e, Role::voltage_source) || has_role(e, Role::current_source); }
/// True for a current source with an expression.
inline bool is_current_expression(const Element& e) { return e.expression && !e.expression_is_voltage && !has_role(e, Role::capacitor); }

/// The value that a line gives without a name: the DC value of a source, a resistance, a gain ...
inline double main_value(const Element& e) { return is_independent_source(e) ? e.waveform.dc : e.value; }
inline void set_main_value(Element& e, double value) {
    if (is_independent_source(e))
        e.waveform.dc = value, e.waveform.has_dc = true;
    else
        e.value = value;
}

}  // namespace corpuscle::circuit
