#pragma once
// The flat circuit while it is built. Used inside circuit/netlist only.

#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {

/// A name that an element uses. It may be defined later in the netlist, but must exist when the circuit is complete.
struct ForwardRef {
    std::string name;  ///< full path
    SourceLocation location;
    std::string user;  ///< the element that uses the name, for the error message
    /// The name must be that of a node (of v(...)), of a voltage source (of F, H), or of an element whose current is an unknown (of
    /// i(...)).
    enum class Target { node, source, current } target;
};

class CircuitBuilder {
    const ParsedNetlist& parsed_;
    std::size_t statement_count_ = 0, name_bytes_ = 0;  // elaborated statements; estimated memory of all names

public:
    Circuit circuit;
    std::vector<ForwardRef> forward_refs;
    const ResolvedOverrides& overrides;

    CircuitBuilder(const ParsedNetlist& parsed, const ResolvedOverrides& resolved) : parsed_(parsed), overrides(resolved) {}

    /// The name in the circuit of a node that the scope calls `name`; ground is "0".
    std::string node_name(const Scope&, std::string_view name) const;
    /// The index of this node in the circuit; a new node is added.
    int find_or_add_node(const Scope&, std::string_view name);
    /// The index in the circuit of the model that the scope calls `name`. The model is evaluated and added at its first use. `user` is the
    /// element that uses it. The model must have one of these types.
    Result<int> find_or_add_model(Scope&, const WordRef& name, std::string_view user, std::span<const std::string_view> types);
    bool has_model(const Scope&, std::string_view name) const;
    Result<void> add_element(Element);

    /// Counts an elaborated statement and the memory of its name. Exceeding the limit of either is an error.
    Result<void> count_statement(const Scope&, const Statement&);
};

/// Reads the element of a line, except of an X line, and adds it to the circuit.
Result<void> read_element(CircuitBuilder&, Scope&, const Statement&);

/// Reads the specification of a V or I source, which follows the nodes in its line.
Result<Waveform> read_waveform(const Scope&, const Statement&);

}  // namespace corpuscle::circuit
