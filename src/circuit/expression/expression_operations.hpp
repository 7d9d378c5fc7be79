#pragma once
// The operations of expressions: a value from up to three operands, and its derivatives. Used by circuit/netlist, and by the data files of
// the reproduction.

#include <cstdint>
#include <string_view>

namespace corpuscle::circuit {

enum class Operation : std::int16_t {
    number,  // a constant
    input,   // the value of an input
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
    conditional,      // a ? b : c
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
    integer,  // rounds towards 0
    log,      // natural logarithm
    log10,
    max,
    min,
    nearest,  // rounds to the nearest integer
    sign,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
    step,       // 0 below 0, 1 above 0, 1/2 at 0
    ramp_step,  // x limited to the range from 0 to 1
    ramp,       // x above 0, otherwise 0
    limit,      // a limited to the range from b to c
    nominal,    // a: the nominal value of a random function such as gauss
};

/// A function by its name in netlists.
struct FunctionInfo {
    std::string_view name;
    int min_arguments, max_arguments;  ///< allowed numbers of arguments
    Operation operation;
};

/// The function of this name; null if there is none. In ngspice pow and pwr have two meanings. If `allows_inputs` is true, the meaning in
/// expressions that may use voltages applies, otherwise the meaning in .param.
const FunctionInfo* find_function(std::string_view name, bool allows_inputs);
/// The value of a constant (pi, echarge ...); null if there is none of this name.
const double* find_constant(std::string_view name);
/// The names of all functions and constants, for suggestions: the k-th name, from 0; "" after the last.
std::string_view function_name(std::size_t k);
std::string_view constant_name(std::size_t k);

/// The value of an operation with operands a, b and c. Operands beyond operand_count() are ignored.
double evaluate_operation(Operation, double a, double b, double c);

/// The derivatives of an operation's value with respect to its operands.
struct Slopes {
    double a = 0, b = 0, c = 0;
};
/// The derivatives; `value` must be that of evaluate_operation() for the same operands.
Slopes evaluate_slopes(Operation, double a, double b, double c, double value);

/// The number of operands of an operation, 0 to 3.
int operand_count(Operation);

}  // namespace corpuscle::circuit
