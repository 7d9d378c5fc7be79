#pragma once
// Names of nodes, elements and models in an exported flat netlist: unique, and only with characters that ngspice accepts.

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Nodes keep their names ("x1.out"). The name of an element inside a subcircuit begins with its letter: x1.m3 is xm_x1_m3, x1.x2.r1 is
/// r_x1_x2_r1. A transistor is exported as a subcircuit, so its name begins with x. Characters other than a-z 0-9 _ (for nodes also
/// . and #) become _, and names that are then equal get a number.
class ExportNames {
    const Circuit& circuit_;
    std::vector<std::string> nodes_, elements_, models_;

public:
    explicit ExportNames(const Circuit&);

    // Names by index in Circuit::nodes, elements and models.
    const std::string& node(int number) const { return nodes_[static_cast<std::size_t>(number)]; }
    const std::string& element(std::size_t number) const { return elements_[number]; }
    const std::string& model(int number) const { return models_[static_cast<std::size_t>(number)]; }
    /// The exported name of a node or element of the circuit; "" if the circuit has none of this name.
    std::string node(std::string_view name) const;
    std::string element(std::string_view name) const;

    /// A word of a directive with the names in its v(...) and i(...) replaced: "v(x1.a,b)=0.5", "vdb(out)".
    std::string word(std::string_view) const;
};

}  // namespace corpuscle::circuit
