#pragma once
// An expression of a netlist, parsed once and evaluated many times, with its derivatives.

#include <complex>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle::circuit {

struct Operation;

/// True for the names of the node at 0 V; HSPICE has gnd!.
inline bool is_ground(std::string_view node) { return node == "0" || node == "gnd" || node == "gnd!"; }

class Expression;

/// An input of an expression: v(a), v(a,b), i(vx), time (s), temper (the temperature in degrees Celsius) or frequency (Hz). Kind::part is a
/// part of the complex value of another expression, as in db(v(out)/v(in)).
struct ExpressionInput {
    enum class Kind { voltage, current, time, temperature, frequency, part } kind;
    std::string name, minus;                    ///< voltage: the node and its reference ("" is ground); current: the element
    std::string_view part = {};                 ///< of a complex value: "m", "db", "p", "r" or "i", as in vdb(out); "" is the value itself
    std::shared_ptr<const Expression> of = {};  ///< Kind::part: the other expression; `name` is its text
    bool operator==(const ExpressionInput& other) const {
        return kind == other.kind && name == other.name && minus == other.minus && part == other.part;
    }
};

/// The names that are visible to an expression.
struct ExpressionScope {
    std::function<std::optional<double>(std::string_view)>
        parameter{};  ///< returns the value of a parameter; nothing if no parameter has this name
    /// A user's function (.func, .param f(x)=...): the names of its arguments and its text.
    struct Function {
        std::vector<std::string> arguments;
        std::string text;
    };
    std::function<const Function*(std::string_view)> function{};  ///< returns null if no function has this name
    /// Returns the value of a random function with constant arguments. If null, it is the first argument.
    std::function<double(std::string_view, std::span<const double>)> random{};
    bool allows_inputs = false;              ///< true if voltages, currents and time are allowed; false in .param
    bool allows_parts = false;               ///< true if vdb(a), db(v(a)) ... and the frequency are allowed, too
    std::vector<std::string> suggestions{};  ///< known names, for "did you mean" in the error about an unknown name
    /// Return the name in the circuit of a node or an element of this scope ("x1.n3" for "n3" inside x1). If null, the name is kept.
    std::function<std::string(std::string_view)> node{}, element{};
};

/// A parsed expression.
class Expression {
public:
    /// Parses "2*v(a) + max(i(vx), 0)". It has + - * / ** ^ (powers), unary - + !, comparisons, && ||, c ? a : b, and numbers with SPICE's
    /// suffixes. It also has the functions of ngspice and its constants, such as pi. `location` is that of the text, for errors.
    ///
    /// As in ngspice 39:
    ///
    ///  - The powers x^y and x**y are |x|^y and associate from left to right. The value of -x^2 is -(x^2).
    ///  - The function log is the natural logarithm. The value of u(0) is 1/2.
    ///  - In a parameter pow(x,y) is C's pow. It is |x|^y if the expression may use voltages.
    ///  - In a parameter pwr(x,y) is |x|^y. It is sgn(x)|x|^y if the expression may use voltages.
    ///
    /// Different from ngspice:
    ///
    ///  - exp(x) and its derivative stay at e^700 beyond x = 700.
    ///  - limit(x,a,b) limits x to the range from a to b.
    ///  - agauss, gauss, unif, aunif and limit(x,d) are drawn once, when the expression is parsed, if the scope has random values. Else,
    ///    and with an argument that depends on an input, they are x.
    static Result<Expression> parse(std::string_view text, const SourceLocation& location, const ExpressionScope&);

    /// The inputs, in the order in which value() takes their values.
    std::span<const ExpressionInput> inputs() const { return inputs_; }
    bool is_constant() const { return inputs_.empty(); }

    /// True if it has only numbers, inputs and + - * /, so that its inputs may be complex.
    bool is_rational() const;
    /// The value for complex inputs, if is_rational().
    std::complex<double> complex_value(std::span<const std::complex<double>> inputs) const;

    bool has_jumps() const;  ///< true if it contains a comparison, a condition or a rounding function

    /// True if its value or a derivative may be infinite or NaN at some finite inputs: it has a quotient, a power, a root, a logarithm ...
    bool has_poles() const;

    /// The value for these values of the inputs.
    double value(std::span<const double> inputs = {}) const;
    /// The same value; `slopes` receives its derivative with respect to each input.
    double value(std::span<const double> inputs, std::span<double> slopes) const;

    /// A text with the same meaning here and in ngspice's B sources, such as "2*v(a)+max(i(vx),0)"; `name` gives the text of each input.
    /// It is an error if a number is not finite or the text is longer than a million characters.
    Result<std::string> text(const std::function<std::string(const ExpressionInput&)>& name) const;

private:
    friend class FormulaReader;
    template <class Values>
    double evaluate(std::span<const double> inputs, Values& values) const;
    struct Step {
        const Operation* operation = nullptr;  // null: a number or an input
        std::int32_t a = 0, b = 0, c = 0;      // the operands, as indices of earlier steps
        std::int32_t input = -1;               // index in inputs_; -1: not an input
        double number = 0;
        bool is_number() const { return operation == nullptr && input < 0; }
    };
    std::vector<Step> steps_;  // the last step gives the value of the expression
    std::vector<ExpressionInput> inputs_;
};

}  // namespace corpuscle::circuit
