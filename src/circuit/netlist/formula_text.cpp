// A formula's steps as text again, in words that mean the same here and in ngspice's B sources.

#include <fmt/format.h>
#include <cmath>

#include "circuit/netlist/formula.hpp"
#include "circuit/netlist/formula_steps.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t most_letters = 1000000;

/// How tightly a text holds together: what is looser needs parentheses about it.
enum class Hold { sum, product, whole };

struct Piece {
    std::string text;
    Hold hold = Hold::whole;
    double number = std::nan("");  ///< if it is one

    std::string within(Hold least) const { return hold < least ? "(" + text + ")" : text; }
    std::string whole() const { return within(Hold::whole); }
};

Piece number_piece(double x) {
    auto text = fmt::format("{}", x);
    const auto hold = text[0] == '-' ? Hold::sum : Hold::whole;
    return {std::move(text), hold, x};
}

Piece call(std::string_view name, const Piece& a) { return {fmt::format("{}({})", name, a.text)}; }
Piece call(std::string_view name, const Piece& a, const Piece& b) { return {fmt::format("{}({},{})", name, a.text, b.text)}; }
Piece between(const Piece& a, std::string_view sign, const Piece& b) { return {fmt::format("({} {} {})", a.whole(), sign, b.whole())}; }
Piece choice(std::string_view condition, std::string_view yes, std::string_view no) {
    return {fmt::format("({} ? {} : {})", condition, yes, no)};
}

/// Sums and products grow at their ends: the left operand keeps no parentheses that it does not need.
Piece chain(const Piece& a, char sign, const Piece& b, Hold hold) {
    const auto tighter = hold == Hold::sum ? Hold::product : Hold::whole;
    return {a.within(hold) + sign + b.within(tighter), hold};
}

/// The angle of the point (b, a), which ngspice has no function for.
Piece angle(const Piece& a, const Piece& b) {
    const auto y = a.whole(), x = b.whole(), slope = fmt::format("atan({}/{})", y, x);
    const auto left = choice(y + " < 0", slope + "-pi", slope + "+pi").text, on_axis = fmt::format("sgn({})*pi/2", y);
    return choice(x + " > 0", slope, choice(x + " < 0", left, on_axis).text);
}

/// e^x stays at e^700 beyond 700, in ngspice too.
Piece exponential(const Piece& a) {
    const bool safe = a.number <= 700 || a.text.starts_with("min(700,");
    return safe ? call("exp", a) : Piece{fmt::format("exp(min(700,{}))", a.text)};
}

Piece piece_of(Operation what, const Piece& a, const Piece& b, const Piece& c) {
    switch (what) {
        case Operation::add:
            return chain(a, '+', b, Hold::sum);
        case Operation::subtract:
            return chain(a, '-', b, Hold::sum);
        case Operation::multiply:
            return chain(a, '*', b, Hold::product);
        case Operation::divide:
            return chain(a, '/', b, Hold::product);
        case Operation::negative:
            return {"-" + a.whole(), Hold::sum};
        case Operation::bare_not:
            return {fmt::format("({} == 0)", a.whole())};
        case Operation::less:
            return between(a, "<", b);
        case Operation::greater:
            return between(a, ">", b);
        case Operation::at_most:
            return between(a, "<=", b);
        case Operation::at_least:
            return between(a, ">=", b);
        case Operation::equal:
            return between(a, "==", b);
        case Operation::unequal:
            return between(a, "!=", b);
        case Operation::both:
            return between(a, "&&", b);
        case Operation::either:
            return between(a, "||", b);
        case Operation::choose:
            return choice(a.whole(), b.whole(), c.whole());
        case Operation::magnitude_power:
        case Operation::true_power:  // of voltages there is none: pow() is |x|^y among them
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
            return {fmt::format("sqrt({0}*{0}+{1}*{1})", a.whole(), b.whole())};
        case Operation::integer:
            return choice(a.whole() + " < 0", call("ceil", a).text, call("floor", a).text);
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
            const auto above = choice(fmt::format("{} > {}", a.whole(), c.whole()), c.whole(), a.whole());
            return choice(fmt::format("{} < {}", a.whole(), b.whole()), b.whole(), above.text);
        }
        case Operation::nominal:
        case Operation::number:
        case Operation::input:
            return a;
    }
    return a;
}

}  // namespace

Result<std::string> Formula::text(const std::function<std::string(const FormulaInput&)>& name) const {
    std::vector<Piece> pieces;
    std::size_t letters = 0;
    for (const Step& s : steps_) {
        const auto what = static_cast<Operation>(s.what);
        const auto piece = [&](std::int32_t k) -> const Piece& { return pieces[static_cast<std::size_t>(k)]; };
        if (what == Operation::number) {
            if (!std::isfinite(s.number)) return bad_input("the formula has a number in it that is not finite");
            pieces.push_back(number_piece(s.number));
        } else if (what == Operation::input) {
            auto said = name(inputs_[static_cast<std::size_t>(s.a)]);
            const auto hold = said[0] == '-' ? Hold::sum : Hold::whole;
            pieces.push_back({std::move(said), hold});
        } else {
            pieces.push_back(piece_of(what, piece(s.a), piece(s.b), piece(s.c)));
        }
        letters += pieces.back().text.size();
        if (pieces.back().text.size() > most_letters || letters > 256 * most_letters)
            return bad_input(fmt::format("written out, the formula has more than {} letters", most_letters));
    }
    return pieces.empty() ? std::string("0") : std::move(pieces.back().text);
}

}  // namespace corpuscle::circuit
