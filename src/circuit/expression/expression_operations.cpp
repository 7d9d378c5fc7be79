#include "circuit/expression/expression_operations.hpp"

#include <cmath>
#include <limits>

#include "core/number/elementary.hpp"

namespace corpuscle::circuit {
namespace {

using enum Operation;
constexpr double pi = 3.141592653589793, ln_10 = 2.302585092994046;

constexpr FunctionInfo functions[] = {
    {"abs", 1, 1, abs},        {"acos", 1, 1, acos},        {"acosh", 1, 1, acosh},   {"agauss", 3, 3, nominal},
    {"asin", 1, 1, asin},      {"asinh", 1, 1, asinh},      {"atan", 1, 1, atan},     {"atan2", 2, 2, atan2},
    {"atanh", 1, 1, atanh},    {"aunif", 2, 2, nominal},    {"arccos", 1, 1, acos},   {"arcsin", 1, 1, asin},
    {"arctan", 1, 1, atan},    {"ceil", 1, 1, ceil},        {"cos", 1, 1, cos},       {"cosh", 1, 1, cosh},
    {"exp", 1, 1, exp},        {"floor", 1, 1, floor},      {"gauss", 3, 3, nominal}, {"hypot", 2, 2, hypot},
    {"if", 3, 3, conditional}, {"int", 1, 1, integer},      {"limit", 2, 3, limit},   {"ln", 1, 1, log},
    {"log", 1, 1, log},        {"log10", 1, 1, log10},      {"max", 2, 2, max},       {"min", 2, 2, min},
    {"nint", 1, 1, nearest},   {"sgn", 1, 1, sign},         {"sin", 1, 1, sin},       {"sinh", 1, 1, sinh},
    {"sqrt", 1, 1, sqrt},      {"tan", 1, 1, tan},          {"tanh", 1, 1, tanh},     {"ternary_fcn", 3, 3, conditional},
    {"u", 1, 1, step},         {"u2", 1, 1, ramp_step},     {"unif", 2, 2, nominal},  {"uramp", 1, 1, ramp},
    {"pow", 2, 2, true_power}, {"pwr", 2, 2, signed_power},
};
constexpr FunctionInfo pow_with_inputs{"pow", 2, 2, magnitude_power}, pwr_in_parameters{"pwr", 2, 2, magnitude_power};

/// The constants of ngspice; kelvin is 0 K in Celsius.
constexpr struct {
    std::string_view name;
    double value;
} constants[] = {{"pi", pi},
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

double signed_power_of(double x, double y) { return x < 0 ? -std::pow(-x, y) : std::pow(x, y); }

}  // namespace

const FunctionInfo* find_function(std::string_view name, bool allows_inputs) {
    if (name == "pow" && allows_inputs) return &pow_with_inputs;
    if (name == "pwr" && !allows_inputs) return &pwr_in_parameters;
    for (const auto& row : functions)
        if (row.name == name) return &row;
    return nullptr;
}

const double* find_constant(std::string_view name) {
    for (const auto& row : constants)
        if (row.name == name) return &row.value;
    return nullptr;
}

std::string_view function_name(std::size_t k) { return k < std::size(functions) ? functions[k].name : ""; }
std::string_view constant_name(std::size_t k) { return k < std::size(constants) ? constants[k].name : ""; }

int operand_count(Operation o) {
    switch (o) {
        case number:
        case input:
            return 0;
        case conditional:
        case limit:
            return 3;
        case add:
        case subtract:
        case multiply:
        case divide:
        case less:
        case greater:
        case less_equal:
        case greater_equal:
        case equal:
        case unequal:
        case logical_and:
        case logical_or:
        case magnitude_power:
        case true_power:
        case signed_power:
        case atan2:
        case hypot:
        case max:
        case min:
            return 2;
        default:
            return 1;
    }
}

double evaluate_operation(Operation o, double a, double b, double c) {
    switch (o) {
        case number:
        case input:
        case nominal:
            return a;
        case add:
            return a + b;
        case subtract:
            return a - b;
        case multiply:
            return a * b;
        case divide:
            return a / b;
        case negate:
            return -a;
        case logical_not:
            return a == 0;
        case less:
            return a < b;
        case greater:
            return a > b;
        case less_equal:
            return a <= b;
        case greater_equal:
            return a >= b;
        case equal:
            return a == b;
        case unequal:
            return a != b;
        case logical_and:
            return a != 0 && b != 0;
        case logical_or:
            return a != 0 || b != 0;
        case conditional:
            return a != 0 ? b : c;
        case magnitude_power:
            return std::pow(std::abs(a), b);
        case true_power:
            return std::pow(a, b);
        case signed_power:
            return signed_power_of(a, b);
        case abs:
            return std::abs(a);
        case acos:
            return std::acos(a);
        case acosh:
            return std::acosh(a);
        case asin:
            return std::asin(a);
        case asinh:
            return std::asinh(a);
        case atan:
            return std::atan(a);
        case atan2:
            return std::atan2(a, b);
        case atanh:
            return std::atanh(a);
        case ceil:
            return std::ceil(a);
        case cos:
            return cosine(a);
        case cosh:
            return std::cosh(a);
        case exp:
            return std::isnan(a) ? a : num::exp(a);
        case floor:
            return std::floor(a);
        case hypot:
            return std::hypot(a, b);
        case integer:
            return std::trunc(a);
        case log:
            return logarithm(a);
        case log10:
            return logarithm(a) / ln_10;
        case max:
            return a < b ? b : a;
        case min:
            return b < a ? b : a;
        case nearest:
            return std::nearbyint(a);
        case sign:
            return (a > 0) - (a < 0);
        case sin:
            return sine(a);
        case sinh:
            return std::sinh(a);
        case sqrt:
            return std::sqrt(a);
        case tan:
            return std::tan(a);
        case tanh:
            return std::tanh(a);
        case step:
            return a > 0 ? 1 : a < 0 ? 0 : 0.5;
        case ramp_step:
            return a <= 0 ? 0 : a <= 1 ? a : 1;
        case ramp:
            return a > 0 ? a : 0;
        case limit:
            return a < b ? b : a > c ? c : a;
    }
    return 0;
}

Slopes evaluate_slopes(Operation o, double a, double b, double c, double value) {
    // The derivatives of s m^b with respect to a and b, where m = |a| and s is 1 or the sign of a. `slope` is the derivative of s m with
    // respect to a.
    const auto power = [&](double m, double slope) -> Slopes {
        const double by_b = value == 0 ? 0 : value * logarithm(m);
        return {b == 0 ? 0 : b * std::pow(m, b - 1) * slope, by_b};
    };
    switch (o) {
        case add:
            return {1, 1};
        case subtract:
            return {1, -1};
        case multiply:
            return {b, a};
        case divide:
            return {1 / b, -a / b / b};
        case negate:
            return {-1};
        case conditional:
            return {0, a != 0 ? 1.0 : 0.0, a != 0 ? 0.0 : 1.0};
        case magnitude_power:
            return power(std::abs(a), a < 0 ? -1 : 1);
        case true_power:
            return {b == 0 ? 0 : b * std::pow(a, b - 1), a > 0 ? value * logarithm(a) : 0};
        case signed_power:
            return power(std::abs(a), 1);
        case abs:
            return {a < 0 ? -1.0 : 1.0};
        case acos:
            return {-1 / std::sqrt((1 - a) * (1 + a))};
        case acosh:
            return {1 / std::sqrt((a - 1) * (a + 1))};
        case asin:
            return {1 / std::sqrt((1 - a) * (1 + a))};
        case asinh:
            return {1 / std::hypot(a, 1.0)};
        case atan:
            return {1 / (1 + a * a)};
        case atan2:
            return {b / (a * a + b * b), -a / (a * a + b * b)};
        case atanh:
            return {1 / ((1 - a) * (1 + a))};
        case cos:
            return {-sine(a)};
        case cosh:
            return {std::sinh(a)};
        case exp:
            return {value};
        case hypot:
            return {value == 0 ? 0 : a / value, value == 0 ? 0 : b / value};
        case log:
            return {1 / a};
        case log10:
            return {1 / (a * ln_10)};
        case max:
            return {a < b ? 0.0 : 1.0, a < b ? 1.0 : 0.0};
        case min:
            return {b < a ? 0.0 : 1.0, b < a ? 1.0 : 0.0};
        case sin:
            return {cosine(a)};
        case sinh:
            return {std::cosh(a)};
        case sqrt:
            return {0.5 / value};
        case tan:
            return {1 + value * value};
        case tanh:
            return {(1 - value) * (1 + value)};
        case ramp_step:
            return {a > 0 && a <= 1 ? 1.0 : 0.0};
        case ramp:
            return {a > 0 ? 1.0 : 0.0};
        case limit:
            return {a < b || a > c ? 0.0 : 1.0, a < b ? 1.0 : 0.0, a >= b && a > c ? 1.0 : 0.0};
        case nominal:
            return {1};
        default:
            return {};  // the other operations are constant between their jumps
    }
}

}  // namespace corpuscle::circuit
