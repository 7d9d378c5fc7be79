#pragma once
// A scope of the elaboration: the top level, or an instance of a subcircuit (X), with its parameters evaluated. Used inside
// circuit/netlist only.

#include "circuit/netlist/body.hpp"

namespace corpuscle::circuit {

struct Frame {
    const Body* body = nullptr;
    const Frame* caller = nullptr;  ///< the scope of the X line; as in ngspice, names that are unknown here are looked up there
    Frame* enclosing = nullptr;     ///< the scope that contains the subcircuit's definition; its models and subcircuits are visible here
    std::string path = {};          ///< "x1.x2."
    ByName<int> ports = {};         ///< numbers of the nodes that the ports are connected to
    ByName<int> models = {};        ///< indices of models that are already in the circuit
    Values parameters = {};
    double m = 1;  ///< number of parallel instances
    int depth = 0;

    std::optional<double> parameter(std::string_view name) const;
    const FormulaScope::Function* function(std::string_view name) const;

    /// Evaluates all parameters; the values in `given` override. Parameters may be in any order, but a cycle is an error.
    Result<void> define(const Values& given);

    Result<double> number(const Text&) const;
    /// Parses an expression of voltages and currents; the scope translates their names.
    Result<Formula> formula(const Text&, FormulaScope) const;
    FormulaScope scope() const;

private:
    std::vector<std::string> known() const;
    Result<void> define(const std::string& name, ByName<Text>& pending);
};

}  // namespace corpuscle::circuit
