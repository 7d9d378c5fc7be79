#pragma once
// The row that describes a kind of device. The netlist reader, overrides, analyses, export and cost treat elements of its letter by this
// row.

#include "circuit/cost/area.hpp"
#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

class ElementReader;
struct ElementExport;

inline constexpr double unlimited = std::numeric_limits<double>::max(), above_zero = std::numeric_limits<double>::min();

/// A number of an element, which its line may give as name=value and which an override may replace.
struct ElementParameter {
    std::string_view name, unit;                ///< name "": the line gives it without a name
    double low = -unlimited, high = unlimited;  ///< range for overrides, ends included
    double initial = 0;                         ///< its value if the line does not give it
    bool is_value = false;               ///< true: it is Element::value, or the DC value of a source; overrides may leave out its name
    bool works_with_expression = false;  ///< true: an element with an expression has it, too
    bool excludes_zero = false;          ///< true: it must not be 0
};

// Parameters of several devices.
inline constexpr ElementParameter parameter_m{"m", "", above_zero, unlimited, 1};  ///< number of equal devices in parallel
inline constexpr ElementParameter parameter_temp{"temp", "", -273, 500};           ///< degrees Celsius; initially that of the circuit
inline constexpr ElementParameter parameter_dtemp{"dtemp", "", -500, 500};         ///< K above the temperature of the circuit

// Usual answers of the functions of DeviceKind.
inline bool always(const Element&) { return true; }
inline bool never(const Element&) { return false; }
inline std::vector<int> first_two_nodes(const Element& e) { return {e.nodes[0], e.nodes[1]}; }
inline std::vector<int> no_nodes(const Element&) { return {}; }
inline std::optional<Area> unknown_area(const Element&) { return {}; }
inline std::optional<Area> no_area(const Element&) { return Area{}; }

/// The role of an element in searches for operating points, in initial conditions, and in its cost. A voltage or current source is an
/// independent one: its value is the DC value of its waveform.
enum class Role { other, voltage_source, current_source, capacitor, inductor, transistor };

// The effect on an element of m parallel copies of its subcircuit, which are simulated as one. Every current is m times as large; voltages
// are those of one copy.
inline void multiply_m(Element& e, double m) { e.values.try_emplace("m", 1).first->second *= m; }
inline void keep_value(Element&, double) {}

/// A kind of device, chosen by the first letter of an element's name and, where several kinds share it, by the level of the model.
struct DeviceKind {
    char letter;
    double level = 0;                           ///< level of its models; 0: all levels
    std::span<const double> other_levels = {};  ///< further levels, by which other simulators call the same model
    std::string_view description;
    /// The default of .options gmin if the circuit has this kind, S; the smallest of all kinds applies. 0: it has no junctions. Models of
    /// SPICE have SPICE's, models for weak inversion a smaller one, because their currents can be picoamperes.
    double gmin = 0;
    Role role = Role::other;
    /// Reads the words of a line after the name: nodes, then a model or a value.
    Result<void> (*read)(ElementReader&);
    /// Makes the device of an element, all of whose values are evaluated.
    Result<std::unique_ptr<Device>> (*make)(const Element&, DeviceSetup&);
    std::span<const ElementParameter> parameters = {};
    /// Further names of name=value pairs that the reader accepts. make() refuses those that the device does not support.
    std::span<const std::string_view> other_names = {};
    /// The names whose value is an expression of voltages and currents. It may contain blanks.
    std::span<const std::string_view> expression_names = {};
    /// True if the current through the element is an unknown of the system. The element then fixes the voltage between its first two nodes
    /// at 0 Hz.
    bool (*has_branch_current)(const Element&) = never;
    /// The nodes between which a current at 0 Hz flows that depends, or may depend, on a voltage.
    std::vector<int> (*conducting_nodes)(const Element&) = first_two_nodes;
    void (*multiply)(Element&, double m) = multiply_m;
    /// True if i(NAME) of .save is the current into the first terminal, which follows from the voltages without displacement current.
    bool saves_terminal_current = false;
    std::optional<Area> (*area)(const Element&) = unknown_area;
    /// The element as one or more lines of an ngspice netlist. Null: the export refuses it.
    Result<std::string> (*write_spice)(const ElementExport&) = nullptr;
    /// The letters before its name in the export, if ngspice uses another letter: "x" for a subcircuit.
    std::string_view export_prefix = "";
    /// Makes the batch that evaluates devices of this kind together. If null, they are evaluated one at a time.
    Result<std::unique_ptr<DeviceBatch>> (*make_batch)() = nullptr;
};

/// The quantity that the expression of a B, and of a C, E or G with an expression, gives.
enum class ExpressionQuantity { current, voltage, charge };

/// Makes the device of an element with an expression. A current and a charge are multiplied by the value m of the element.
Result<std::unique_ptr<Device>> make_expression_device(const Element&, DeviceSetup&, ExpressionQuantity);

// The members of a transistor that the batch of chips uses.

struct UicmConstants;
/// The constants of a transistor, with its variation applied. The reference is valid as long as the device.
const UicmConstants& transistor_constants(const Device&);

namespace lanes {
struct ChipKernels;
}
/// The functions that compute one chip on each SIMD lane, for the instruction set that instruction_set() returns.
Result<const lanes::ChipKernels*> chip_kernels();

}  // namespace corpuscle::circuit
