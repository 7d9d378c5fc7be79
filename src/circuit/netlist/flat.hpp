#pragma once
// The flat circuit while it is built. Used inside circuit/netlist only.

#include "circuit/netlist/frame.hpp"

namespace corpuscle::circuit {

/// A name that must exist when the circuit is complete.
struct Promise {
    std::string name;  ///< full path
    SourceLocation place;
    std::string who;  ///< the element that uses it, for the error message
    enum class Of { node, source, current } of;
};

class Flat {
    const ParsedNetlist& parsed_;
    std::size_t visited_ = 0, letters_ = 0;

public:
    Circuit circuit;
    std::vector<Promise> promises;
    const Changes& changes;

    Flat(const ParsedNetlist& parsed, const Changes& set) : parsed_(parsed), changes(set) {}

    /// The name of a node in the circuit; ground is "0".
    std::string node_name(const Frame&, std::string_view name) const;
    int node(const Frame&, std::string_view name);
    /// The index of the model of this name as seen from the scope. The model is evaluated at its first use.
    Result<int> model(Frame&, const Text& name, std::string_view user, std::span<const std::string_view> types);
    bool has_model(const Frame&, std::string_view name) const;
    Result<void> add(Element);

    /// Counts an elaborated statement and the memory of its name; both are limited.
    Result<void> visit(const Frame&, const Statement&);
};

/// Adds the element of any line but X to the circuit.
Result<void> read_element(Flat&, Frame&, const Statement&);

/// Reads the source specification of V and I, which follows the nodes.
Result<Waveform> read_waveform(const Frame&, const Statement&);

}  // namespace corpuscle::circuit
