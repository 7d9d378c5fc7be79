#pragma once
// A scope of the elaboration: the top level, or an instance of a subcircuit (X), with its parameters evaluated. Used inside
// circuit/netlist only.

#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {

struct Scope {
    const SubcktDef* definition = nullptr;
    const Scope* caller = nullptr;  ///< the scope of the X line; as in ngspice, names that are unknown here are looked up there
    Scope* enclosing = nullptr;     ///< the scope that contains the subcircuit's definition; its models and subcircuits are visible here
    std::string path = {};          ///< "x1.x2."
    ByName<int> ports = {};         ///< indices of the nodes that the ports are connected to
    ByName<int> models = {};        ///< indices of models that are already in the circuit
    Values parameters = {};
    double m = 1;  ///< number of parallel instances
    int depth = 0;

    /// Look up a name in this scope, then in its callers.
    std::optional<double> parameter(std::string_view name) const;
    const ExpressionScope::Function* function(std::string_view name) const;

    /// Evaluates all parameters; the values in `given` override. Parameters may be in any order, but a cycle is an error.
    Result<void> define(const Values& given);

    Result<double> evaluate(const WordRef&) const;
    /// Parses an expression of voltages and currents; the scope translates their names.
    Result<Expression> parse_expression(const WordRef&, ExpressionScope) const;
    ExpressionScope expression_scope() const;

private:
    std::vector<std::string> known_names() const;
    Result<void> define(const std::string& name, ByName<WordRef>& pending);
};

}  // namespace corpuscle::circuit
