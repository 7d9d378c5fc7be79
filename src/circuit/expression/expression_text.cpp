// Writes the steps of an expression as text that has the same meaning here and in ngspice's B sources.

#include <fmt/format.h>
#include <cmath>

#include "circuit/expression/expression.hpp"
#include "circuit/expression/expression_operations.hpp"

namespace corpuscle::circuit {
namespace {

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

Fragment number_fragment(double x) {
    auto text = fmt::format("{}", x);
    const auto precedence = text[0] == '-' ? Precedence::sum : Precedence::atom;
    return {std::move(text), precedence, x};
}

Fragment call(std::string_view name, const Fragment& a) { return {fmt::format("{}({})", name, a.text)}; }
Fragment call(std::string_view name, const Fragment& a, const Fragment& b) { return {fmt::format("{}({},{})", name, a.text, b.text)}; }
Fragment between(const Fragment& a, std::string_view sign, const Fragment& b) {
    return {fmt::format("({} {} {})", a.as_atom(), sign, b.as_atom())};
}
Fragment choice(std::string_view condition, std::string_view yes, std::string_view no) {
    return {fmt::format("({} ? {} : {})", condition, yes, no)};
}

/// A sum or product. A left operand of the same precedence needs no parentheses.
Fragment chain(const Fragment& a, char sign, const Fragment& b, Precedence precedence) {
    const auto higher = precedence == Precedence::sum ? Precedence::product : Precedence::atom;
    return {a.in_context(precedence) + sign + b.in_context(higher), precedence};
}

/// atan2(a, b), which ngspice does not have.
Fragment angle(const Fragment& a, const Fragment& b) {
    const auto y = a.as_atom(), x = b.as_atom(), slope = fmt::format("atan({}/{})", y, x);
    const auto left = choice(y + " < 0", slope + "-pi", slope + "+pi").text, on_axis = fmt::format("sgn({})*pi/2", y);
    return choice(x + " > 0", slope, choice(x + " < 0", left, on_axis).text);
}

/// exp with its argument limited to 700 in the text, since ngspice's exp has no such limit.
Fragment exponential(const Fragment& a) {
    const bool is_limited = a.number <= 700 || a.text.starts_with("min(700,");
    return is_limited ? call("exp", a) : Fragment{fmt::format("exp(min(700,{}))", a.text)};
}

Fragment fragment_of(Operation operation, const Fragment& a, const Fragment& b, const Fragment& c) {
    switch (operation) {
        case Operation::add:
            return chain(a, '+', b, Precedence::sum);
        case Operation::subtract:
            return chain(a, '-', b, Precedence::sum);
        case Operation::multiply:
            return chain(a, '*', b, Precedence::product);
        case Operation::divide:
            return chain(a, '/', b, Precedence::product);
        case Operation::negate:
            return {"-" + a.as_atom(), Precedence::sum};
        case Operation::logical_not:
            return {fmt::format("({} == 0)", a.as_atom())};
        case Operation::less:
            return between(a, "<", b);
        case Operation::greater:
            return between(a, ">", b);
        case Operation::less_equal:
            return between(a, "<=", b);
        case Operation::greater_equal:
            return between(a, ">=", b);
        case Operation::equal:
            return between(a, "==", b);
        case Operation::unequal:
            return between(a, "!=", b);
        case Operation::logical_and:
            return between(a, "&&", b);
        case Operation::logical_or:
            return between(a, "||", b);
        case Operation::conditional:
            return choice(a.as_atom(), b.as_atom(), c.as_atom());
        case Operation::magnitude_power:
        case Operation::true_power:  // never occurs with voltages, where pow() is |x|^y
            return call("pow", a, b);
        case Operation::signed_power:
            return call("pwr", a, b);
        case Operation::abs:
            return call("abs", a);
        case Operation::acos:
            return call("acos", a);
        case Operation::acosh:
            return call("acosh", a);
        case Operation::asin:
            return call("asin", a);
        case Operation::asinh:
            return call("asinh", a);
        case Operation::atan:
            return call("atan", a);
        case Operation::atan2:
            return angle(a, b);
        case Operation::atanh:
            return call("atanh", a);
        case Operation::ceil:
            return call("ceil", a);
        case Operation::cos:
            return call("cos", a);
        case Operation::cosh:
            return call("cosh", a);
        case Operation::exp:
            return exponential(a);
        case Operation::floor:
            return call("floor", a);
        case Operation::hypot:
            return {fmt::format("sqrt({0}*{0}+{1}*{1})", a.as_atom(), b.as_atom())};
        case Operation::integer:
            return choice(a.as_atom() + " < 0", call("ceil", a).text, call("floor", a).text);
        case Operation::log:
            return call("ln", a);
        case Operation::log10:
            return call("log10", a);
        case Operation::max:
            return call("max", a, b);
        case Operation::min:
            return call("min", a, b);
        case Operation::nearest:
            return call("nint", a);
        case Operation::sign:
            return call("sgn", a);
        case Operation::sin:
            return call("sin", a);
        case Operation::sinh:
            return call("sinh", a);
        case Operation::sqrt:
            return call("sqrt", a);
        case Operation::tan:
            return call("tan", a);
        case Operation::tanh:
            return call("tanh", a);
        case Operation::step:
            return call("u", a);
        case Operation::ramp_step:
            return call("u2", a);
        case Operation::ramp:
            return call("uramp", a);
        case Operation::limit: {
            const auto above = choice(fmt::format("{} > {}", a.as_atom(), c.as_atom()), c.as_atom(), a.as_atom());
            return choice(fmt::format("{} < {}", a.as_atom(), b.as_atom()), b.as_atom(), above.text);
        }
        case Operation::nominal:
        case Operation::number:
        case Operation::input:
            return a;
    }
    return a;
}

}  // namespace

Result<std::string> Expression::text(const std::function<std::string(const ExpressionInput&)>& name) const {
    std::vector<Fragment> fragments;
    std::size_t total = 0;  // characters of all fragments, which are kept in memory
    for (const Step& s : steps_) {
        const auto operation = static_cast<Operation>(s.operation);
        const auto operand = [&](std::int32_t k) -> const Fragment& { return fragments[static_cast<std::size_t>(k)]; };
        if (operation == Operation::number) {
            if (!std::isfinite(s.number)) return bad_input("the expression contains a number that is not finite");
            fragments.push_back(number_fragment(s.number));
        } else if (operation == Operation::input) {
            auto text = name(inputs_[static_cast<std::size_t>(s.a)]);
            const auto precedence = text[0] == '-' ? Precedence::sum : Precedence::atom;
            fragments.push_back({std::move(text), precedence});
        } else {
            fragments.push_back(fragment_of(operation, operand(s.a), operand(s.b), operand(s.c)));
        }
        total += fragments.back().text.size();
        if (fragments.back().text.size() > max_characters || total > 256 * max_characters)
            return bad_input(fmt::format("written as text, the expression has more than {} characters", max_characters));
    }
    return fragments.empty() ? std::string("0") : std::move(fragments.back().text);
}

}  // namespace corpuscle::circuit
