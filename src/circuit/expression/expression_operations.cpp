#include "circuit/expression/expression_operations.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/number/elementary.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double pi = 3.141592653589793, ln_10 = 2.302585092994046;

/// The constants of ngspice; kelvin is 0 K in Celsius.
constexpr NamedConstant constants[] = {{"pi", pi},
                                       {"twopi", 2 * pi},
                                       {"e", 2.718281828459045},
                                       {"c", 299792458},
                                       {"boltz", 1.38064852e-23},
                                       {"echarge", 1.6021766208e-19},
                                       {"kelvin", -273.15},
                                       {"planck", 6.626070040e-34},
                                       {"true", 1},
                                       {"yes", 1},
                                       {"false", 0},
                                       {"no", 0}};

/// Sine and cosine of an angle in radians. num::sin_turns gives the same result on every processor, but only for fewer than 2^49 turns.
/// Above 1e14 radians the result has few significant digits anyway.
double sine(double x) { return std::abs(x) < 1e14 ? num::sin_turns(x / (2 * pi)) : std::sin(x); }
double cosine(double x) { return std::abs(x) < 1e14 ? num::cos_turns(x / (2 * pi)) : std::cos(x); }

/// num::log for normal positive numbers; also handles subnormal numbers, 0, infinity and negative numbers.
double logarithm(double x) {
    constexpr double min_normal = std::numeric_limits<double>::min(), scale = 18014398509481984.0;  // 2^54
    if (x >= min_normal && x <= std::numeric_limits<double>::max()) return num::log(x);
    if (x > 0 && x < min_normal) return num::log(x * scale) - num::log(scale);
    return std::log(x);
}

/// The derivatives of s m^b, where m = |a| and s is 1 or the sign of a. `slope` is the derivative of s m with respect to a.
Slopes slopes_of_power(const Operands& x, double slope) {
    const double m = std::abs(x.a), by_b = x.value == 0 ? 0 : x.value * logarithm(m);
    return {x.b == 0 ? 0 : x.b * std::pow(m, x.b - 1) * slope, by_b};
}

/// 0 below 0, 1 above 0, 1/2 at 0.
double unit_step(double x) {
    if (x > 0) return 1;
    return x < 0 ? 0 : 0.5;
}

/// a limited to the range from b to c.
double limit(const Operands& x) {
    if (x.a < x.b) return x.b;
    return x.a > x.c ? x.c : x.a;
}
Slopes slopes_of_limit(const Operands& x) {
    if (x.a < x.b) return {0, 1, 0};
    return x.a > x.c ? Slopes{0, 0, 1} : Slopes{1, 0, 0};
}

using In = const Operands&;
constexpr Operation operations[] = {
    {"||", 2, [](In x) -> double { return x.a != 0 || x.b != 0; }, nullptr, 1},
    {"&&", 2, [](In x) -> double { return x.a != 0 && x.b != 0; }, nullptr, 2},
    {"==", 2, [](In x) -> double { return x.a == x.b; }, nullptr, 3},
    {"!=", 2, [](In x) -> double { return x.a != x.b; }, nullptr, 3},
    {"<=", 2, [](In x) -> double { return x.a <= x.b; }, nullptr, 4},
    {">=", 2, [](In x) -> double { return x.a >= x.b; }, nullptr, 4},
    {"<", 2, [](In x) -> double { return x.a < x.b; }, nullptr, 4},
    {">", 2, [](In x) -> double { return x.a > x.b; }, nullptr, 4},
    {"+", 2, [](In x) { return x.a + x.b; }, [](In) -> Slopes { return {1, 1}; }, sum_level},
    {"-", 2, [](In x) { return x.a - x.b; }, [](In) -> Slopes { return {1, -1}; }, sum_level},
    {"*", 2, [](In x) { return x.a * x.b; }, [](In x) -> Slopes { return {x.b, x.a}; }, product_level},
    {"/", 2, [](In x) { return x.a / x.b; }, [](In x) -> Slopes { return {1 / x.b, -x.a / x.b / x.b}; }, product_level},
    // |a|^b, as ^ and ** in ngspice
    {"^", 2, [](In x) { return std::pow(std::abs(x.a), x.b); }, [](In x) { return slopes_of_power(x, x.a < 0 ? -1 : 1); }, power_level,
     "pow({3},{4})"},
    {"-", 1, [](In x) { return -x.a; }, [](In) -> Slopes { return {-1}; }, 0, "-{0}"},
    {"!", 1, [](In x) -> double { return x.a == 0; }, nullptr, 0, "({0} == 0)"},
    {"?:", 3, [](In x) { return x.a != 0 ? x.b : x.c; }, [](In x) { return x.a != 0 ? Slopes{0, 1, 0} : Slopes{0, 0, 1}; }, 0,
     "({0} ? {1} : {2})"},
    {"pow", 2, [](In x) { return std::pow(x.a, x.b); },  // C's; never occurs with voltages
     [](In x) -> Slopes { return {x.b == 0 ? 0 : x.b * std::pow(x.a, x.b - 1), x.a > 0 ? x.value * logarithm(x.a) : 0}; }},
    {"pwr", 2, [](In x) { return x.a < 0 ? -std::pow(-x.a, x.b) : std::pow(x.a, x.b); }, [](In x) { return slopes_of_power(x, 1); }},
    {"abs", 1, [](In x) { return std::abs(x.a); }, [](In x) -> Slopes { return {x.a < 0 ? -1.0 : 1.0}; }},
    {"acos", 1, [](In x) { return std::acos(x.a); }, [](In x) -> Slopes { return {-1 / std::sqrt((1 - x.a) * (1 + x.a))}; }},
    {"acosh", 1, [](In x) { return std::acosh(x.a); }, [](In x) -> Slopes { return {1 / std::sqrt((x.a - 1) * (x.a + 1))}; }},
    {"asin", 1, [](In x) { return std::asin(x.a); }, [](In x) -> Slopes { return {1 / std::sqrt((1 - x.a) * (1 + x.a))}; }},
    {"asinh", 1, [](In x) { return std::asinh(x.a); }, [](In x) -> Slopes { return {1 / std::hypot(x.a, 1.0)}; }},
    {"atan", 1, [](In x) { return std::atan(x.a); }, [](In x) -> Slopes { return {1 / (1 + x.a * x.a)}; }},
    {"atan2", 2, [](In x) { return std::atan2(x.a, x.b); },  // ngspice does not have it
     [](In x) -> Slopes { return {x.b / (x.a * x.a + x.b * x.b), -x.a / (x.a * x.a + x.b * x.b)}; }, 0,
     "({1} > 0 ? atan({0}/{1}) : ({1} < 0 ? ({0} < 0 ? atan({0}/{1})-pi : atan({0}/{1})+pi) : sgn({0})*pi/2))"},
    {"atanh", 1, [](In x) { return std::atanh(x.a); }, [](In x) -> Slopes { return {1 / ((1 - x.a) * (1 + x.a))}; }},
    {"ceil", 1, [](In x) { return std::ceil(x.a); }},
    {"cos", 1, [](In x) { return cosine(x.a); }, [](In x) -> Slopes { return {-sine(x.a)}; }},
    {"cosh", 1, [](In x) { return std::cosh(x.a); }, [](In x) -> Slopes { return {std::sinh(x.a)}; }},
    {"exp", 1, [](In x) { return std::isnan(x.a) ? x.a : num::exp(x.a); }, [](In x) -> Slopes { return {x.value}; }},
    {"floor", 1, [](In x) { return std::floor(x.a); }},
    {"hypot", 2, [](In x) { return std::hypot(x.a, x.b); },
     [](In x) { return x.value == 0 ? Slopes{} : Slopes{x.a / x.value, x.b / x.value}; }, 0, "sqrt({0}*{0}+{1}*{1})"},
    {"int", 1, [](In x) { return std::trunc(x.a); }, nullptr, 0, "({0} < 0 ? ceil({3}) : floor({3}))"},
    {"ln", 1, [](In x) { return logarithm(x.a); }, [](In x) -> Slopes { return {1 / x.a}; }},
    {"log10", 1, [](In x) { return logarithm(x.a) / ln_10; }, [](In x) -> Slopes { return {1 / (x.a * ln_10)}; }},
    {"max", 2, [](In x) { return x.a < x.b ? x.b : x.a; }, [](In x) { return x.a < x.b ? Slopes{0, 1} : Slopes{1, 0}; }},
    {"min", 2, [](In x) { return x.b < x.a ? x.b : x.a; }, [](In x) { return x.b < x.a ? Slopes{0, 1} : Slopes{1, 0}; }},
    {"nint", 1, [](In x) { return std::nearbyint(x.a); }},
    {"sgn", 1, [](In x) -> double { return (x.a > 0) - (x.a < 0); }},
    {"sin", 1, [](In x) { return sine(x.a); }, [](In x) -> Slopes { return {cosine(x.a)}; }},
    {"sinh", 1, [](In x) { return std::sinh(x.a); }, [](In x) -> Slopes { return {std::cosh(x.a)}; }},
    {"sqrt", 1, [](In x) { return std::sqrt(x.a); }, [](In x) -> Slopes { return {0.5 / x.value}; }},
    {"tan", 1, [](In x) { return std::tan(x.a); }, [](In x) -> Slopes { return {1 + x.value * x.value}; }},
    {"tanh", 1, [](In x) { return std::tanh(x.a); }, [](In x) -> Slopes { return {(1 - x.value) * (1 + x.value)}; }},
    {"u", 1, [](In x) { return unit_step(x.a); }},
    {"u2", 1, [](In x) { return x.a <= 0 ? 0 : std::min(1.0, x.a); }, [](In x) -> Slopes { return {x.a > 0 && x.a <= 1 ? 1.0 : 0.0}; }},
    {"uramp", 1, [](In x) { return x.a > 0 ? x.a : 0; }, [](In x) -> Slopes { return {x.a > 0 ? 1.0 : 0.0}; }},
    {"limit", 3, [](In x) { return limit(x); }, [](In x) { return slopes_of_limit(x); }, 0, "({0} < {1} ? {1} : ({0} > {2} ? {2} : {0}))"},
};

/// Other spellings of operators and functions.
constexpr struct {
    std::string_view name, operation;
} other_spellings[] = {{"<>", "!="},       {"|", "||"},        {"&", "&&"},  {"**", "^"},           {"arccos", "acos"},
                       {"arcsin", "asin"}, {"arctan", "atan"}, {"if", "?:"}, {"ternary_fcn", "?:"}, {"log", "ln"}};

/// limit(x,d) is a random function in ngspice; limit(x,a,b) is not.
constexpr RandomFunction random_functions[] = {{"agauss", 3}, {"gauss", 3}, {"aunif", 2}, {"unif", 2}, {"limit", 2}};

template <class Row, std::size_t n>
const Row* find_row(const Row (&rows)[n], std::string_view name) {
    const auto* row = std::find_if(rows, rows + n, [&](const Row& r) { return r.name == name; });
    return row == rows + n ? nullptr : row;
}

std::string_view without_alias(std::string_view name) {
    const auto* alias = find_row(other_spellings, name);
    return alias ? alias->operation : name;
}

}  // namespace

const PartFunction* find_part_function(std::string_view name) {
    static constexpr PartFunction all[] = {{"mag", "m"},  {"db", "db"}, {"ph", "p"},   {"phase", "p"}, {"arg", "p"}, {"re", "r"},
                                           {"real", "r"}, {"im", "i"},  {"imag", "i"}, {"img", "i"},   {"cph", ""},  {"cphase", ""}};
    const auto* found = std::ranges::find(all, name, &PartFunction::name);
    return found == std::end(all) ? nullptr : found;
}

std::span<const Operation> all_operations() { return operations; }
std::span<const NamedConstant> all_constants() { return constants; }
const RandomFunction* find_random_function(std::string_view name) { return find_row(random_functions, name); }

const Operation* find_operation(std::string_view name, int operands) {
    name = without_alias(name);
    for (const auto& o : operations)
        if (o.operands == operands && o.name == name) return &o;
    return nullptr;
}

const Operation* find_function(std::string_view name, bool allows_inputs) {
    return find_row(operations, name == (allows_inputs ? "pow" : "pwr") ? "^" : without_alias(name));
}

OperatorSpelling leading_operator(std::string_view text) {
    static const auto spellings = [] {
        std::vector<std::pair<std::string_view, const Operation*>> all;
        for (const auto& o : operations)
            if (o.level > 0) all.emplace_back(o.name, &o);
        for (const auto& alias : other_spellings) {
            const auto* o = find_operation(alias.operation, 2);
            if (o && o->level > 0) all.emplace_back(alias.name, o);
        }
        return all;
    }();
    OperatorSpelling out;
    for (const auto& [spelling, operation] : spellings)
        if (spelling.size() > out.length && text.starts_with(spelling)) out = {operation, spelling.size()};
    return out;
}

}  // namespace corpuscle::circuit
