#pragma once
// .ic v(a)=1 v(b)={x}, and .nodeset of the same form.

#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {

/// The voltages of the .ic and .nodeset lines of a netlist. The lines are read before all nodes exist.
class NodeVoltages {
    struct NodeVoltage {
        std::string node;  // its name in the circuit
        double value;      // V
        SourceLocation location;
        bool is_ic;  // true: from .ic; false: from .nodeset
    };
    std::vector<NodeVoltage> voltages_;
    /// Names with a path in the lines of the top level; for a port, the node that it is connected to, else -1.
    std::unordered_map<std::string, int> ports_;

public:
    /// Finds the names with a path, which can be those of ports, in the lines of the top level.
    void find_paths(std::span<const Statement* const> lines);
    /// The port of the instance with this path ("x1.x2.") is connected to a node of the circuit.
    void connect_port(const std::string& path, const std::string& port, int node);
    Result<void> read(const CircuitBuilder&, const Scope&, const Statement&);
    /// Adds the voltages to the circuit, which is complete.
    Result<void> resolve(Circuit&) const;
};

}  // namespace corpuscle::circuit
