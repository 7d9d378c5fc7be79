#pragma once
// Every device, by its letter. To add one: its include, and its line.

#include "circuit/device/diode.hpp"
#include "circuit/device/passive.hpp"
#include "circuit/device/source.hpp"
#include "circuit/device/transistor.hpp"

namespace corpuscle::circuit {

struct DeviceKind {
    char letter;
    std::string_view sentence;
    Result<std::unique_ptr<Device>> (*make)(const Element&, Setup&);
    /// At 0 Hz: whether its current depends on the voltage at its ends, or may; and whether it fixes the voltage between the first two.
    bool conducts, fixes_voltage;
    /// How devices of this kind are looked at together; null: one by one.
    Result<std::unique_ptr<Bank>> (*bank)() = nullptr;
};

inline constexpr DeviceKind devices[] = {
    {'r', "resistor", make_resistor, true, false},
    {'c', "capacitor, linear or by a formula of its charge", make_capacitor, false, false},
    {'l', "inductor", make_inductor, true, true},
    {'v', "voltage source", make_voltage_source, true, true},
    {'i', "current source", make_current_source, false, false},
    {'e', "voltage by a voltage or a formula", make_controlled_source, true, true},
    {'f', "current by a current", make_controlled_source, true, false},
    {'g', "current by a voltage or a formula", make_controlled_source, true, false},
    {'h', "voltage by a current", make_controlled_source, true, true},
    {'b', "voltage or current by a formula", make_formula_source, true, false},
    {'d', "junction diode", make_diode, true, false},
    {'m', "MOS transistor, UICM", make_transistor, true, false, make_transistor_bank},
};

inline const DeviceKind* device_of(char letter) {
    for (const auto& d : devices)
        if (d.letter == letter) return &d;
    return nullptr;
}

/// Whether the current through an element is an unknown of its own.
inline bool has_branch(const Element& e) {
    switch (e.letter) {
        case 'v':
        case 'l':
        case 'h':
            return true;
        case 'e':
            return !e.formula || e.formula_is_voltage;
        case 'b':
        case 'g':
            return e.formula && e.formula_is_voltage;
        default:
            return false;
    }
}

}  // namespace corpuscle::circuit
