#pragma once
// .save and .probe: the curves to keep; and the probes that a user names in a circuit.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/devices.hpp"

namespace corpuscle::circuit {

/// A voltage or a current. The current through a voltage source is an unknown of the system. The current into the first terminal of a
/// device (drain, anode) is computed from its terminal voltages without displacement current; for a transistor it is the sum of the
/// currents of the channel and of the drain junction.
struct SavedQuantity {
    std::string name;              ///< "v(out)", "v(a,b)", "i(v1)", "i(x1.m1)"
    OutputVariable unknowns = {};  ///< the value is their difference, unless it is the current of a device
    int device_index = -1;         ///< if it is the current of a device: index in System::devices(); otherwise -1

    bool is_voltage() const { return name[0] == 'v'; }
    /// The value of the quantity, V or A. `value_of(u)` must return the value of unknown u, and 0 for -1 (ground).
    template <class Value>
    double value(const System& system, Value&& value_of) const {
        if (device_index < 0) return value_of(unknowns.plus) - value_of(unknowns.minus);
        const auto& d = *system.devices()[static_cast<std::size_t>(device_index)];
        std::vector<double> v;
        for (const int u : d.unknowns) v.push_back(value_of(u));
        return current_into(d, v);
    }

private:
    /// The current into the first terminal; v has the values of the device's unknowns.
    static double current_into(const Device&, std::span<const double> v);
};

/// True if the current of the element is not an unknown but follows from its terminal voltages.
inline bool has_device_current(const Element& e) { return kind_of(e).saves_terminal_current; }

/// The quantities that .save and .probe name; "out" means v(out). An empty list means all unknowns: the netlist has `.save all`, or neither
/// .save nor .probe.
Result<std::vector<SavedQuantity>> resolve_saved_quantities(const System&);

/// The device currents, i(r1), that .print, .plot and .meas name and `saved` does not have.
std::vector<SavedQuantity> mentioned_device_currents(const System&, std::span<const SavedQuantity> saved);

/// True if the directive is a .probe and this word of it is not supported: the current of a capacitor, vd(r2), p(x1).
bool is_unsupported_probe(const Circuit&, const Directive&, std::string_view word);

/// Computes those of the saved quantities that are device currents. The system must outlive it.
class DeviceCurrents {
    const System& system_;
    std::vector<SavedQuantity> currents_;
    std::vector<double> row_;
    bool extends_ = false, has_sweep_ = true;  // of the plot that was begun last

public:
    DeviceCurrents(const System&, std::span<const SavedQuantity>);
    /// Begins a plot, and appends a curve for each current to its head. Currents cannot be computed if the plot is complex, is swept over
    /// temperature, or has other curves than the unknowns.
    void begin(Plot& head);
    /// A point of the plot with the currents appended; valid until the next call.
    PlotRow extend(const PlotRow& row);
};

/// Splits "vf,v(a,b),i(N3B)" at the commas outside parentheses: "vf", "v(a,b)", "i(N3B)".
std::vector<std::string> split_probes(std::string_view text);

/// Turns one probe of a user into its name in .save: "i(N3B)" into "i(xsummer.mn3b)". A probe is a node, v(NODE), v(NODE,NODE), i(SOURCE)
/// or i(DEVICE). Names match as in hierarchical_names.hpp. Returns nothing if the circuit has no such node or device. An ambiguous name and
/// a device whose current cannot be recorded are errors.
Result<std::optional<std::string>> resolve_probe(const Circuit&, std::string_view probe_text);

/// A suggestion for a probe that resolve_probe() does not find: "; did you mean 'hpb'?". If no name is similar, the first names:
/// "; there are the nodes in, out".
std::string suggest_probe(const Circuit&, std::string_view probe_text);

}  // namespace corpuscle::circuit
