#include "circuit/expression/expression.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/expression/expression_operations.hpp"

namespace corpuscle::circuit {
namespace {

/// A buffer with a number for each step, on the stack for all but the longest expressions.
class StepBuffer {
    static constexpr std::size_t max_on_stack = 64;
    double on_stack_[max_on_stack];
    std::unique_ptr<double[]> on_heap_;
    double* data_;

public:
    explicit StepBuffer(std::size_t n)
        : on_heap_(n > max_on_stack ? new double[n] : nullptr), data_(on_heap_ ? on_heap_.get() : on_stack_) {}
    double& operator[](std::size_t k) { return data_[k]; }
    double& operator[](std::int32_t k) { return data_[static_cast<std::size_t>(k)]; }
};

constexpr std::size_t max_characters = 1000000;

/// The precedence of the outermost operator of a text. A text of lower precedence than its context needs parentheses.
enum class Precedence { sum, product, atom };

/// The text of one step with all its operands.
struct Fragment {
    std::string text;
    Precedence precedence = Precedence::atom;
    double number = std::nan("");  ///< if the text is a number, its value; otherwise NaN

    std::string in_context(Precedence required) const { return precedence < required ? "(" + text + ")" : text; }
    std::string as_atom() const { return in_context(Precedence::atom); }
};

/// A text that is an atom, or begins with a minus sign.
Fragment fragment(std::string text, double number = std::nan("")) {
    const auto precedence = text[0] == '-' ? Precedence::sum : Precedence::atom;
    return {std::move(text), precedence, number};
}

/// True if the text of an operand keeps exp() below e^700. The text of others limits it, since ngspice's exp has no limit.
bool is_limited(const Fragment& a) { return a.number <= 700 || a.text.starts_with("min(700,"); }

/// Writes an operation with the texts of its operands. A left operand of the same precedence needs no parentheses.
Fragment fragment_of(const Operation& o, const Fragment& a, const Fragment& b, const Fragment& c) {
    if (o.level == sum_level) return {a.in_context(Precedence::sum) + o.name[0] + b.in_context(Precedence::product), Precedence::sum};
    if (o.level == product_level) return {a.in_context(Precedence::product) + o.name[0] + b.as_atom(), Precedence::product};
    if (o.name == "exp" && !is_limited(a)) return fragment(fmt::format("exp(min(700,{}))", a.text));
    if (!o.text.empty()) return fragment(fmt::format(fmt::runtime(o.text), a.as_atom(), b.as_atom(), c.as_atom(), a.text, b.text));
    if (o.level > 0) return fragment(fmt::format("({} {} {})", a.as_atom(), o.name, b.as_atom()));
    return fragment(o.operands == 1 ? fmt::format("{}({})", o.name, a.text) : fmt::format("{}({},{})", o.name, a.text, b.text));
}

}  // namespace

/// Evaluates all steps into `values` and returns the value of the last one.
template <class Values>
double Expression::evaluate(std::span<const double> inputs, Values& values) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        const Step& s = steps_[k];
        if (s.operation)
            values[k] = s.operation->value({values[s.a], values[s.b], values[s.c]});
        else
            values[k] = s.is_number() ? s.number : inputs[static_cast<std::size_t>(s.input)];
    }
    return steps_.empty() ? 0 : values[steps_.size() - 1];
}

bool Expression::is_rational() const {
    constexpr std::string_view rational[] = {"+", "-", "*", "/"};
    return std::ranges::all_of(
        steps_, [&](const Step& s) { return !s.operation || std::ranges::find(rational, s.operation->name) != std::end(rational); });
}

std::complex<double> Expression::complex_value(std::span<const std::complex<double>> inputs) const {
    std::vector<std::complex<double>> values;
    values.reserve(steps_.size());
    for (const auto& s : steps_) {
        if (!s.operation) {
            values.push_back(s.input >= 0 ? inputs[static_cast<std::size_t>(s.input)] : s.number);
            continue;
        }
        const auto a = values[static_cast<std::size_t>(s.a)], b = values[static_cast<std::size_t>(s.b)];
        const char name = s.operation->name[0];
        values.push_back(s.operation->operands == 1 ? -a : name == '+' ? a + b : name == '-' ? a - b : name == '*' ? a * b : a / b);
    }
    return values.back();
}

bool Expression::has_jumps() const {
    return std::any_of(steps_.begin(), steps_.end(), [](const Step& s) { return s.operation && s.operation->has_jumps(); });
}

bool Expression::has_poles() const {
    constexpr std::string_view with_poles[] = {"/",    "^",     "pow",  "pwr",   "ln",  "log10", "sqrt",
                                               "acos", "acosh", "asin", "atanh", "tan", "hypot", "atan2"};
    return std::any_of(steps_.begin(), steps_.end(), [&](const Step& s) {
        return s.operation && std::ranges::find(with_poles, s.operation->name) != std::end(with_poles);
    });
}

double Expression::value(std::span<const double> inputs) const {
    StepBuffer values(steps_.size());
    return evaluate(inputs, values);
}

/// Computes derivatives by reverse accumulation. The weight of a step is the derivative of the expression's value with respect to the
/// step's value. From the last step back to the inputs, each step adds its weight times its own derivatives to the weights of its operands.
/// A step with weight 0 adds nothing, even where its own derivative is infinite.
double Expression::value(std::span<const double> inputs, std::span<double> slopes) const {
    StepBuffer values(steps_.size()), weight(steps_.size());
    const double value = evaluate(inputs, values);
    std::fill(slopes.begin(), slopes.end(), 0.0);
    for (std::size_t k = 0; k < steps_.size(); ++k) weight[k] = 0;
    if (!steps_.empty()) weight[steps_.size() - 1] = 1;
    for (std::size_t k = steps_.size(); k-- > 0;) {
        const Step& s = steps_[k];
        const double w = weight[k];
        if (w == 0) continue;
        if (s.input >= 0) slopes[static_cast<std::size_t>(s.input)] += w;
        if (!s.operation || !s.operation->slopes) continue;
        const Slopes d = s.operation->slopes({values[s.a], values[s.b], values[s.c], values[k]});
        if (d.a != 0) weight[s.a] += w * d.a;
        if (d.b != 0) weight[s.b] += w * d.b;
        if (d.c != 0) weight[s.c] += w * d.c;
    }
    return value;
}

Result<std::string> Expression::text(const std::function<std::string(const ExpressionInput&)>& name) const {
    std::vector<Fragment> fragments;
    std::size_t total = 0;  // characters of all fragments, which are kept in memory
    for (const Step& s : steps_) {
        const auto operand = [&](std::int32_t k) -> const Fragment& { return fragments[static_cast<std::size_t>(k)]; };
        if (s.is_number() && !std::isfinite(s.number)) return bad_input("the expression contains a number that is not finite");
        if (s.operation)
            fragments.push_back(fragment_of(*s.operation, operand(s.a), operand(s.b), operand(s.c)));
        else if (s.is_number())
            fragments.push_back(fragment(fmt::format("{}", s.number), s.number));
        else
            fragments.push_back(fragment(name(inputs_[static_cast<std::size_t>(s.input)])));
        total += fragments.back().text.size();
        if (fragments.back().text.size() > max_characters || total > 256 * max_characters)
            return bad_input(fmt::format("written as text, the expression has more than {} characters", max_characters));
    }
    return fragments.empty() ? std::string("0") : std::move(fragments.back().text);
}

}  // namespace corpuscle::circuit
