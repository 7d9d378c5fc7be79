#pragma once
// The flat circuit while it is made. Inside circuit/netlist only.

#include "circuit/netlist/frame.hpp"

namespace corpuscle::circuit {

/// Something named that must be there once the circuit is complete.
struct Promise {
    std::string name;  ///< with its path
    Place place;
    std::string who;  ///< "b1: v(x)", for the sentence
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

    /// A node's name in the circuit: of ground "0".
    std::string node_name(const Frame&, std::string_view name) const;
    int node(const Frame&, std::string_view name);
    /// The model of this name as seen from the frame, worked out at its first use.
    Result<int> model(Frame&, const Text& name, std::string_view who, std::span<const std::string_view> types);
    bool has_model(const Frame&, std::string_view name) const;
    Result<void> add(Element);

    /// Counts a statement put in place, and what its name takes: both have limits.
    Result<void> visit(const Frame&, const Statement&);
};

/// An element line that is no X: its element, put in the circuit.
Result<void> read_element(Flat&, Frame&, const Statement&);

/// V, I: what stands behind the nodes.
Result<Waveform> read_waveform(const Frame&, const Statement&);

}  // namespace corpuscle::circuit
