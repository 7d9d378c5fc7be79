#pragma once
// The operators and functions of expressions, each described by one row. Used by circuit/netlist, and by the data files of the
// reproduction.

#include <span>
#include <string_view>

namespace corpuscle::circuit {

/// The operands of an operation; an operation with fewer ignores the others. `value` is its value, for slopes.
struct Operands {
    double a, b, c, value = 0;
};
/// The derivatives of an operation's value with respect to its operands.
struct Slopes {
    double a = 0, b = 0, c = 0;
};

/// An operator or a function.
struct Operation {
    std::string_view name;  ///< "+", "sin"
    int operands;           ///< 1 to 3
    double (*value)(const Operands&);
    Slopes (*slopes)(const Operands&) = nullptr;  ///< null: the value is constant between its jumps
    int level = 0;                                ///< of a binary operator: a higher level binds more tightly; otherwise 0
    /// The operation in ngspice's B sources, if it is not written as its name with its operands. {0} {1} {2} are the operands as atoms,
    /// {3} {4} the first two without parentheses around them.
    std::string_view text = {};

    bool has_jumps() const { return slopes == nullptr || text.find('?') != std::string_view::npos; }
};
inline constexpr int sum_level = 5, product_level = 6, power_level = 7;

std::span<const Operation> all_operations();
/// The operation with this name, or another spelling of it, and number of operands; null if there is none.
const Operation* find_operation(std::string_view name, int operands);
/// The function of this name; null if there is none. In ngspice pow and pwr have two meanings. If `allows_inputs` is true, the meaning in
/// expressions that may use voltages applies, otherwise the meaning in .param.
const Operation* find_function(std::string_view name, bool allows_inputs);
/// The binary operator at the beginning of a text, and the length of its spelling there; null if there is none.
struct OperatorSpelling {
    const Operation* operation = nullptr;
    std::size_t length = 0;
};
OperatorSpelling leading_operator(std::string_view text);

/// A random function of ngspice. Its mean is its first argument.
struct RandomFunction {
    std::string_view name;
    int arguments;
};
/// Null if there is none of this name.
const RandomFunction* find_random_function(std::string_view name);

/// A function of a complex value, such as mag, db, ph. `part` is that of an ExpressionInput; "" if the function is not available.
struct PartFunction {
    std::string_view name, part;
};
/// Null if there is none of this name.
const PartFunction* find_part_function(std::string_view name);

struct NamedConstant {
    std::string_view name;
    double value;
};
/// pi, echarge ...
std::span<const NamedConstant> all_constants();

}  // namespace corpuscle::circuit
