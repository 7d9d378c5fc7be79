#pragma once
// The state of an afferent that is a circuit, at one moment: its node voltages, and the power of its sources and blocks.

#include <string>
#include <vector>

namespace corpuscle {

struct OperatingState {
    struct Source {
        std::string name;
        double power = 0;    ///< W, delivered
        double current = 0;  ///< A, into its first terminal; of a voltage source that delivers power it is negative
    };
    struct Node {
        std::string name;
        double voltage = 0;  ///< V
    };
    struct Device {
        std::string name;
        double current = 0;  ///< A, into its first terminal, which is the drain of a transistor
    };
    struct Block {
        std::string name;  ///< of the subcircuit; "top level" for the elements outside of subcircuits
        double power = 0;  ///< W, dissipated
        std::vector<Node> nodes = {};      ///< inside it, and at the terminals of its devices
        std::vector<Device> devices = {};  ///< without the sources that deliver power
    };
    double time = 0;               ///< s since its start
    double supply = 0;             ///< V
    double power = 0, sensor = 0;  ///< W, of all sources; the part for the sensor
    std::vector<Source> sources = {};
    std::vector<Block> blocks = {};  ///< empty if the afferent is not a circuit
};

/// A value that overrides of an afferent can set, beside its parameters.
struct SettableValue {
    enum class Kind { number, choice, array };
    std::string name;  ///< as an override has it: "temp", "summer.N3B.w"
    Kind kind = Kind::number;
    std::string unit = {};
    double value = 0;       ///< of a number, in `unit`; NaN: none, such as the seed of a circuit without mismatch
    std::string text = {};  ///< of a choice, or of an array: "8x4"
    std::vector<std::string> choices = {};
    std::string block = {};  ///< the subcircuit; "" for the whole circuit
    std::string description = {};
};

}  // namespace corpuscle
