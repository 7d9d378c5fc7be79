#pragma once
// A formula of a netlist: read once, worked out often, with its slopes.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle::circuit {

/// What a formula is worked out from where it is not constant: v(a), v(a,b), i(vx), time, temper (C), hertz.
struct FormulaInput {
    enum class Kind { voltage, current, time, temperature } kind;
    std::string name, minus;  ///< voltage: of a node against another ("": ground); current: through the element of this name
    bool operator==(const FormulaInput&) const = default;
};

/// What names mean where a formula stands.
struct FormulaScope {
    std::function<std::optional<double>(std::string_view)> parameter{};  ///< a number, if there is a parameter of this name
    /// A user's function of this name (.func, .param f(x)=...): its arguments' names and its text; null: there are none.
    struct Function {
        std::vector<std::string> arguments;
        std::string text;
    };
    std::function<const Function*(std::string_view)> function{};
    bool inputs = false;               ///< whether voltages, currents and time may be named: not so in .param
    std::vector<std::string> known{};  ///< names for a suggestion where one is not known
    /// What a node or an element named in the formula is called in the circuit ("n3" is "x1.n3" inside x1); null: the same.
    std::function<std::string(std::string_view)> node{}, element{};
};

class Formula {
public:
    /// Reads "2*v(a) + max(i(vx), 0)": + - * / ** ^ (powers), unary - + !, comparisons, && ||, c ? a : b, numbers with SPICE's
    /// suffixes, pi and other constants ngspice knows, and its functions. The error has the column within `at`'s line.
    /// As in ngspice 39: x^y and x**y are |x|^y and go from left to right; -x^2 is -(x^2); log is the natural logarithm; pow(x,y) is
    /// C's in a parameter and |x|^y among voltages; pwr(x,y) is |x|^y in a parameter and sgn(x)|x|^y among voltages; u(0) is 1/2.
    /// Otherwise than there: exp(x) stays at e^700 beyond x = 700 (and its slope with it), limit(x,a,b) keeps x within a and b,
    /// agauss, gauss, unif, aunif and limit(x,d) give their nominal value x.
    static Result<Formula> parse(std::string_view text, const Place& at, const FormulaScope&);

    /// In the order in which values must be handed in.
    std::span<const FormulaInput> inputs() const { return inputs_; }
    bool constant() const { return inputs_.empty(); }

    double value(std::span<const double> inputs = {}) const;
    /// The value, and in `slopes` how it changes with each input.
    double value(std::span<const double> inputs, std::span<double> slopes) const;

    /// A text that means the same here and in ngspice's B sources, with `name` for each input: "2*v(a)+max(i(vx),0)". Refused where there
    /// is no such text: a number that is not finite, or more than a million letters.
    Result<std::string> text(const std::function<std::string(const FormulaInput&)>& name) const;

private:
    friend class FormulaReader;
    template <class Room>
    double run(std::span<const double> inputs, Room& values) const;
    struct Step {
        std::int16_t what;                 // an operation, by its number
        std::int32_t a = 0, b = 0, c = 0;  // steps before this one
        double number = 0;
    };
    std::vector<Step> steps_;  // each uses earlier ones; the last is the value
    std::vector<FormulaInput> inputs_;
};

}  // namespace corpuscle::circuit
