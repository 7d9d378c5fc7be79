#pragma once
// All kinds of devices, by letter. Their list is in devices.cpp.

#include "circuit/device/device_kind.hpp"

namespace corpuscle::circuit {

/// In the order of messages and catalogues.
extern const std::span<const DeviceKind* const> device_kinds;

/// True if models of this level belong to the kind.
bool has_level(const DeviceKind& kind, double level);

/// The kind of device of this letter whose models have this level. Without a level, or if no kind has it, the first one of the letter. Null
/// if there is none.
const DeviceKind* find_device_kind(char letter, std::optional<double> level = {});

/// The levels of the models of a letter: "level=1 (SPICE level 1), 44, 55 or 260 (EKV 2.6) or 80 (UICM)".
std::string supported_levels(char letter);

/// "R C L ... X": the letters of all elements, subcircuits included.
std::string element_letters();

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
