#pragma once
// The flat circuit while it is built. Used inside circuit/netlist only.

#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {

/// A name that must exist when the circuit is complete.
struct ForwardRef {
    std::string name;  ///< full path
    SourceLocation location;
    std::string user;  ///< the element that uses it, for the error message
    enum class Target { node, source, current } target;
};

class CircuitBuilder {
    const ParsedNetlist& parsed_;
    std::size_t statement_count_ = 0, name_bytes_ = 0;

public:
    Circuit circuit;
    std::vector<ForwardRef> forward_refs;
    const ResolvedOverrides& overrides;

    CircuitBuilder(const ParsedNetlist& parsed, const ResolvedOverrides& set) : parsed_(parsed), overrides(set) {}

    /// The name of a node in the circuit; ground is "0".
    std::string node_name(const Scope&, std::string_view name) const;
    int find_or_add_node(const Scope&, std::string_view name);
    /// The index of the model of this name as seen from the scope. The model is evaluated at its first use.
    Result<int> find_or_add_model(Scope&, const WordRef& name, std::string_view user, std::span<const std::string_view> types);
    bool has_model(const Scope&, std::string_view name) const;
    Result<void> add_element(Element);

    /// Counts an elaborated statement and the memory of its name; both are limited.
    Result<void> count_statement(const Scope&, const Statement&);
};

/// Adds the element of any line but X to the circuit.
Result<void> read_element(CircuitBuilder&, Scope&, const Statement&);

/// Reads the source specification of V and I, which follows the nodes.
Result<Waveform> read_waveform(const Scope&, const Statement&);

}  // namespace corpuscle::circuit
