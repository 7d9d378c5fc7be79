#pragma once
// .ic v(a)=1 v(b)={x}, and .nodeset of the same form.

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

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
    /// Names with a path in the lines of the top level. The value is the index of the node that the port is connected to; -1 if the name
    /// is not that of a port.
    std::unordered_map<std::string, int> paths_;

public:
    /// Finds the names with a path, which can be those of ports, in the lines of the top level.
    void find_paths(std::span<const Statement* const> lines);
    /// Records the index of the node that a port is connected to. `path`: of the instance, "x1.x2.".
    void connect_port(const std::string& path, const std::string& port, int node);
    /// Reads a line of .ic or .nodeset in this scope. Its nodes need not exist yet.
    Result<void> read(const CircuitBuilder&, const Scope&, const Statement&);
    /// Adds the voltages to the circuit. Call it when all nodes exist.
    Result<void> resolve(Circuit&) const;
};

}  // namespace corpuscle::circuit
