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
