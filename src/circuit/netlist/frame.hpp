#pragma once
// A body put in place: the top level, or a subcircuit under an X, its parameters worked out. Inside circuit/netlist only.

#include "circuit/netlist/body.hpp"

namespace corpuscle::circuit {

struct Frame {
    const Body* body = nullptr;
    const Frame* caller = nullptr;  ///< whose X this is; as in ngspice, names not known here mean what they mean there
    Frame* enclosing = nullptr;     ///< the one in whose body this one's is defined: its models and subcircuits are seen from here
    std::string path = {};          ///< "x1.x2."
    ByName<int> ports = {};         ///< numbers of the nodes outside
    ByName<int> models = {};        ///< already in the circuit
    Values parameters = {};
    double m = 1;  ///< as many of it in parallel
    int depth = 0;

    std::optional<double> parameter(std::string_view name) const;
    const FormulaScope::Function* function(std::string_view name) const;

    /// Works out all parameters but those `given`, which overrule; in any order, a circle refused.
    Result<void> define(const Values& given);

    Result<double> number(const Text&) const;
    /// A formula of voltages and currents; the scope says what these are called.
    Result<Formula> formula(const Text&, FormulaScope) const;
    FormulaScope scope() const;

private:
    std::vector<std::string> known() const;
    Result<void> define(const std::string& name, ByName<Text>& pending);
};

}  // namespace corpuscle::circuit
