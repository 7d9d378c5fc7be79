#pragma once
// All kinds of devices, by letter. To add one, include its header here and add a line to `devices`.

#include "circuit/device/diode.hpp"
#include "circuit/device/passive.hpp"
#include "circuit/device/source.hpp"
#include "circuit/device/transistor.hpp"

namespace corpuscle::circuit {

/// A kind of device, chosen by the first letter of an element's name.
struct DeviceKind {
    char letter;
    std::string_view description;
    Result<std::unique_ptr<Device>> (*make)(const Element&, DeviceSetup&);
    /// Behaviour at 0 Hz. conducts_dc: the current depends, or may depend, on the voltage across the device. fixes_voltage: the device
    /// fixes the voltage between its first two terminals.
    bool conducts_dc, fixes_voltage;
    /// Makes the batch that evaluates devices of this kind together. If null, they are evaluated one at a time.
    Result<std::unique_ptr<DeviceBatch>> (*make_batch)() = nullptr;
};

inline constexpr DeviceKind devices[] = {
    {'r', "resistor", make_resistor, true, false},
    {'c', "capacitor, linear or with an expression for its charge", make_capacitor, false, false},
    {'l', "inductor", make_inductor, true, true},
    {'v', "voltage source", make_voltage_source, true, true},
    {'i', "current source", make_current_source, false, false},
    {'e', "voltage source controlled by a voltage or an expression", make_controlled_source, true, true},
    {'f', "current source controlled by a current", make_controlled_source, true, false},
    {'g', "current source controlled by a voltage or an expression", make_controlled_source, true, false},
    {'h', "voltage source controlled by a current", make_controlled_source, true, true},
    {'b', "voltage or current source with an expression", make_formula_source, true, false},
    {'d', "junction diode", make_diode, true, false},
    {'m', "MOS transistor, UICM", make_transistor, true, false, make_transistor_batch},
};

/// The kind of device of this letter; null if there is none.
inline const DeviceKind* find_device_kind(char letter) {
    for (const auto& d : devices)
        if (d.letter == letter) return &d;
    return nullptr;
}

/// True if the current through the element is an unknown of the system.
inline bool has_branch_current(const Element& e) {
    switch (e.letter) {
        case 'v':
        case 'l':
        case 'h':
            return true;
        case 'e':
            return !e.expression || e.expression_is_voltage;  // an E with a gain is a voltage source, too
        case 'b':
        case 'g':
            return e.expression && e.expression_is_voltage;
        default:
            return false;
    }
}

}  // namespace corpuscle::circuit
