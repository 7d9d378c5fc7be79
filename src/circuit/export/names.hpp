#pragma once
// What nodes, elements and models are called where no subcircuits are left: one name each, and only letters that ngspice takes.

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// Nodes keep their names ("x1.out"); an element inside a subcircuit has its letter first: x1.m3 is xm_x1_m3, x1.x2.r1 is r_x1_x2_r1. A
/// transistor is a subcircuit there, so that its name begins with x. Other letters than a-z 0-9 _ . # become _, and what would then be
/// called alike gets a number.
class ExportNames {
    const Circuit& circuit_;
    std::vector<std::string> nodes_, elements_, models_;

public:
    explicit ExportNames(const Circuit&);

    const std::string& node(int number) const { return nodes_[static_cast<std::size_t>(number)]; }
    /// Of a node or element by its name in the circuit; "": there is none.
    std::string node(std::string_view name) const;
    std::string element(std::string_view name) const;
    const std::string& element(std::size_t number) const { return elements_[number]; }
    const std::string& model(int number) const { return models_[static_cast<std::size_t>(number)]; }

    /// A word of a command with the names in its v(...) and i(...) put over: "v(x1.a,b)=0.5", "vdb(out)".
    std::string word(std::string_view) const;
};

}  // namespace corpuscle::circuit
