#pragma once
// What a step of a formula can do: its value from up to three others, and its slopes. Inside circuit/netlist only.

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
    negative,
    bare_not,
    less,
    greater,
    at_most,
    at_least,
    equal,
    unequal,
    both,
    either,
    choose,
    magnitude_power,  // |x|^y: what ngspice's ^ and ** are
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

/// A function by the name that a netlist calls it.
struct FunctionRow {
    std::string_view name;
    int least, most;  ///< arguments
    Operation operation;
};

/// The row of a function, or null. pow and pwr mean two things in ngspice: `solved` where voltages may stand, otherwise in .param.
const FunctionRow* function_row(std::string_view name, bool solved);
/// The value of a constant (pi, echarge ...), or null.
const double* constant_value(std::string_view name);
/// Names of all functions and constants, for suggestions.
std::string_view function_name(std::size_t k);  ///< "" after the last
std::string_view constant_name(std::size_t k);

double value_of(Operation, double a, double b, double c);

/// How a value changes with each operand.
struct Slopes {
    double a = 0, b = 0, c = 0;
};
Slopes slopes_of(Operation, double a, double b, double c, double value);

/// How many operands it has.
int operands(Operation);

}  // namespace corpuscle::circuit
