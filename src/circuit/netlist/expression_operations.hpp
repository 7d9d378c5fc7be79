#pragma once
// The operations of expressions: a value from up to three operands, and its derivatives. Used inside circuit/netlist only.

#include <cstdint>
#include <string_view>

namespace corpuscle::circuit {

enum class Operation : std::int16_t {
    number,
    input,
    add,
    subtract,
    multiply,
    divide,
    negate,
    logical_not,
    less,
    greater,
    less_equal,
    greater_equal,
    equal,
    unequal,
    logical_and,
    logical_or,
    conditional,
    magnitude_power,  // |x|^y, as ^ and ** in ngspice
    true_power,       // C's pow
    signed_power,     // sgn(x) |x|^y
    abs,
    acos,
    acosh,
    asin,
    asinh,
    atan,
    atan2,
    atanh,
    ceil,
    cos,
    cosh,
    exp,
    floor,
    hypot,
    integer,
    log,
    log10,
    max,
    min,
    nearest,
    sign,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
    step,
    ramp_step,
    ramp,
    limit,
    nominal,
};

/// A function by its name in netlists.
struct FunctionInfo {
    std::string_view name;
    int min_arguments, max_arguments;  ///< number of arguments
    Operation operation;
};

/// The function of this name; null if there is none. In ngspice pow and pwr have two meanings: `with_inputs` selects the one for
/// expressions that may use voltages, otherwise the one for .param.
const FunctionInfo* find_function(std::string_view name, bool with_inputs);
/// The value of a constant (pi, echarge ...); null if there is none of this name.
const double* find_constant(std::string_view name);
/// Names of all functions and constants, for suggestions.
std::string_view function_name(std::size_t k);  ///< "" after the last
std::string_view constant_name(std::size_t k);

double evaluate_operation(Operation, double a, double b, double c);

/// The derivatives of a value with respect to its operands.
struct Slopes {
    double a = 0, b = 0, c = 0;
};
Slopes evaluate_slopes(Operation, double a, double b, double c, double value);

/// The number of operands.
int operand_count(Operation);

}  // namespace corpuscle::circuit
