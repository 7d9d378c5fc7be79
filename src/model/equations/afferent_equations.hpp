#pragma once
// The equations of receptors and neurons as text, from which the scripts for other simulators are written. The simulation does not use
// them; a test compares them with it.
//
// An expression has numbers, + - * /, parentheses, comparisons, the functions below, and these names: the parameters of the afferent, its
// state variables and definitions, the force F (N), its slope dF (N/s), and in a neuron the current I (A). Times are in s.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// The functions that an expression may call, with their numbers of arguments.
struct EquationFunction {
    std::string_view name;
    int arguments;
};
inline constexpr EquationFunction equation_functions[] = {{"abs", 1},  {"asinh", 1}, {"exp", 1}, {"floor", 1},
                                                          {"sqrt", 1}, {"max", 2},   {"min", 2}};

/// A quantity that follows from others. A definition may use those before it.
struct Definition {
    std::string_view name, unit, expression;
};

/// A state variable x: dx/dt = `slope`, in `unit` per second.
struct StateEquation {
    std::string_view name, unit, slope;
    std::string_view initial = {};  ///< the value at the start; "": that of the quantity of this name which the neuron records
    std::string_view minimum = {};  ///< the value below which x does not fall; "": there is none
    bool is_held_while_refractory = false;
};

/// At a spike x takes the value of the expression.
struct Assignment {
    std::string_view name, expression;
};

struct ReceptorEquations {
    std::string_view name;
    std::vector<StateEquation> states;
    std::vector<Definition> definitions;
    std::vector<std::string_view> currents;  ///< names of definitions; each current drives a neuron of its own
    std::string_view smoothing = {};         ///< a sentence on the filters that the simulation computes differently; "": none
};

/// A neuron fires when `value` rises above `threshold`, if `condition` (an expression) is above 0.
struct NeuronEquations {
    std::string_view name;
    std::vector<StateEquation> states;
    std::vector<Definition> definitions;
    std::string_view value, threshold;
    std::string_view condition = {};  ///< "": always
    std::vector<Assignment> at_spike;
    std::string_view refractory_time = {};  ///< the parameter; "": none
};

std::span<const ReceptorEquations> all_receptor_equations();
std::span<const NeuronEquations> all_neuron_equations();

/// A parameter of an afferent with its value.
struct ParameterNumber {
    std::string_view name, unit, description;
    double value;
};

/// A state variable with its value at the start, where it is a number.
struct InitialNumber {
    std::string_view name;
    double value;
};

/// The equations of an afferent with all numbers.
struct AfferentEquations {
    const ReceptorEquations* receptor;
    const NeuronEquations* neuron;
    std::vector<ParameterNumber> parameters;  ///< those that the equations use
    std::vector<InitialNumber> initial;       ///< of the states of the neuron whose `initial` is ""
    double refractory_time = 0;               ///< s
};

/// The equations of the afferent of a plan. Returns an error with the reason and a remedy if they cannot be written down: for netlists,
/// sensors, random numbers, and models without rows in this folder.
Result<AfferentEquations> equations_of(const AfferentPlan&);

}  // namespace corpuscle
