#include "circuit/expression/expression.hpp"

#include <fmt/format.h>
#include <cmath>
#include <map>

#include "circuit/expression/spice_number.hpp"
#include "support/property.hpp"

namespace corpuscle::circuit {
namespace {

ExpressionScope with_circuit_inputs() {
    ExpressionScope s;
    s.allows_inputs = true;
    return s;
}

Result<Expression> read(std::string_view text, const ExpressionScope& scope = with_circuit_inputs()) {
    return Expression::parse(text, {"f.cir", 3, 5}, scope);
}

double value(std::string_view text, const ExpressionScope& scope = with_circuit_inputs()) {
    const auto f = read(text, scope);
    EXPECT_TRUE(f) << text << ": " << (f ? "" : f.error().text());
    return f ? f->value() : NAN;
}

TEST(SpiceNumber, ReadsEveryScaleAndIgnoresTheUnit) {
    const struct {
        const char* text;
        double value;
    } cases[] = {{"10", 10},        {"10pF", 10e-12}, {"5V", 5},        {"1.5k", 1.5e3}, {"2Meg", 2e6}, {"2MEGohm", 2e6}, {"5M", 5e-3},
                 {"3mil", 76.2e-6}, {"1u", 1e-6},     {"1F", 1e-15},    {"2a", 2},       {"3T", 3e12},  {"3g", 3e9},      {".5n", .5e-9},
                 {"-1e-3", -1e-3},  {"+2", 2},        {"1e3k", 1e6},    {"1d-2", 1e-2},  {"4ohm", 4},   {"1.", 1},        {"10u", 10e-6},
                 {"2e", 2},         {"1e-400", 0},    {"0.1n", 0.1e-9}, {"7Hz", 7}};
    for (const auto& c : cases) {
        const auto n = parse_number(c.text);
        ASSERT_TRUE(n) << c.text;
        EXPECT_DOUBLE_EQ(n->value, c.value) << c.text;
    }
    EXPECT_EQ(parse_number("10u")->value, 1e-5) << "exact to the last bit";
    EXPECT_TRUE(std::isinf(parse_number("1e999")->value));
}

TEST(SpiceNumber, RejectsTextsThatAreNotNumbers) {
    for (const auto* text : {"", "k", "1k5", "1.2.3", "-", "--1", ".", "1 k", "e5", "2n3904", "0x10"})
        EXPECT_FALSE(parse_number(text)) << text;
}

TEST(Expression, EvaluatesOperationsInTheOrderOfNgspice) {
    const struct {
        const char* text;
        double value;
    } cases[] = {
        {"1+2*3-4/2", 5}, {"2^3^2", 64}, {"-2^2", -4}, {"2*-3", -6},  {"2^-1", 0.5},          {"8/4/2", 1},      {"2-3-4", -5},
        {"(1+2)*3", 9},   {"!0+1", 2},   {"2*3>5", 1}, {"1?2:3", 2},  {"0?2:0?4:5", 5},       {"1==1&&2!=2", 0}, {"1||0&&0", 1},
        {"1<2", 1},       {"2<=2", 1},   {"3>=4", 0},  {"2**3", 8},   {"1k+1u", 1000.000001}, {"{2*{3}}", 6},    {" 2 * ( 3 + 1 ) ", 8},
        {"--3", 3},       {"-+-!0", 1},  {"1<>2", 1},  {"10k/2k", 5}, {"3*2^2", 12},          {"1+1==2", 1},     {"2e-3*1k", 2},
    };
    for (const auto& c : cases) EXPECT_DOUBLE_EQ(value(c.text), c.value) << c.text;
}

TEST(Expression, HasTheFunctionsAndConstantsOfNgspice) {
    const struct {
        const char* text;
        double value;
    } cases[] = {
        {"sin(pi/6)", 0.5},
        {"cos(0)", 1},
        {"tan(1)", std::tan(1)},
        {"exp(1)", std::exp(1)},
        {"ln(exp(2))", 2},
        {"log(exp(2))", 2},
        {"log10(1000)", 3},
        {"sqrt(2)", std::sqrt(2)},
        {"abs(-3)", 3},
        {"max(1,2)", 2},
        {"min(1,2)", 1},
        {"pow(2,10)", 1024},
        {"atan2(1,-1)", 3 * M_PI / 4},
        {"hypot(3,4)", 5},
        {"floor(-1.5)", -2},
        {"ceil(1.2)", 2},
        {"int(-2.7)", -2},
        {"nint(2.5)", 2},
        {"sgn(-3)", -1},
        {"u(0)", 0.5},
        {"u2(0.3)", 0.3},
        {"uramp(-1)", 0},
        {"limit(5,0,3)", 3},
        {"limit(-5,0,3)", 0},
        {"if(1,2,3)", 2},
        {"ternary_fcn(0,5,6)", 6},
        {"agauss(3,1,2)", 3},
        {"max(2)", 2},
        {"max(2,7,3)-min(4,1,2,3)", 6},
        {"gauss(3,1,2)", 3},
        {"unif(4,0.1)", 4},
        {"aunif(4,1)", 4},
        {"limit(4,1)", 4},
        {"sinh(1)", std::sinh(1)},
        {"cosh(1)", std::cosh(1)},
        {"tanh(1)", std::tanh(1)},
        {"asinh(1)", std::asinh(1)},
        {"acosh(2)", std::acosh(2)},
        {"atanh(0.5)", std::atanh(0.5)},
        {"asin(0.5)", std::asin(0.5)},
        {"acos(0.5)", std::acos(0.5)},
        {"twopi", 2 * M_PI},
        {"e", std::exp(1)},
        {"c", 299792458},
        {"kelvin", -273.15},
        {"true+false", 1},
        {"boltz", 1.38064852e-23},
        {"echarge", 1.6021766208e-19},
        {"planck", 6.62607004e-34},
    };
    for (const auto& c : cases) EXPECT_NEAR(value(c.text), c.value, 4e-16 * std::abs(c.value)) << c.text;
    EXPECT_EQ(value("exp(1000)"), value("exp(700)")) << "the exponent is limited to 700";
    EXPECT_TRUE(std::isinf(value("ln(0)")));
    EXPECT_TRUE(std::isnan(value("ln(-1)")));
    EXPECT_NEAR(value("ln(1e-320)"), std::log(1e-320), 1e-12);
}

TEST(Expression, PowAndPwrMeanTheSameAsInNgspiceInParametersAndCircuitExpressions) {
    const ExpressionScope parameter;
    EXPECT_EQ(value("pow(-2,3)"), 8);
    EXPECT_EQ(value("pow(-2,3)", parameter), -8);
    EXPECT_EQ(value("pwr(-2,3)"), -8);
    EXPECT_EQ(value("pwr(-2,3)", parameter), 8);
    EXPECT_EQ(value("(-2)^3"), 8);
    EXPECT_EQ(value("(-2)^3", parameter), 8);
}

TEST(Expression, NamesItsInputsOnceAndInOrder) {
    const auto f = read("2*v(a) + max(i(vx), 0) + v(A)*v(b,a) + time + temper + v(c,gnd) - v(0,d)");
    ASSERT_TRUE(f) << f.error().text();
    using Kind = ExpressionInput::Kind;
    const std::vector<ExpressionInput> expected{{Kind::voltage, "a", ""}, {Kind::current, "vx", ""},   {Kind::voltage, "b", "a"},
                                                {Kind::time, "", ""},     {Kind::temperature, "", ""}, {Kind::voltage, "c", ""},
                                                {Kind::voltage, "d", ""}};
    EXPECT_EQ(std::vector<ExpressionInput>(f->inputs().begin(), f->inputs().end()), expected);
    const double x[] = {1, -1, 10, 100, 27, 5, 3};
    EXPECT_EQ(f->value(x), 2 + 0 + 10 + 100 + 27 + 5 + 3);
    EXPECT_FALSE(f->is_constant());
}

TEST(Expression, DropsUnusedInputsAndRecognizesConstants) {
    EXPECT_TRUE(read("v(a,a) + v(0) + v(gnd,0)")->is_constant());
    ExpressionScope s = with_circuit_inputs();
    const ExpressionScope::Function first{{"x", "y"}, "x"};
    s.function = [&](std::string_view name) { return name == "first" ? &first : nullptr; };
    EXPECT_EQ(read("first(v(a), v(b))", s)->inputs().size(), 1U);
}

TEST(Expression, ReportsLocationAndCauseOfErrors) {
    ExpressionScope s = with_circuit_inputs();
    s.suggestions = {"vdd", "width"};
    const ExpressionScope::Function f{{"x"}, "x*vddd"}, g{{"x"}, "h(x)"}, h{{"x"}, "g(x)+1"};
    s.function = [&](std::string_view name) { return name == "f" ? &f : name == "g" ? &g : name == "h" ? &h : nullptr; };
    const struct {
        const char *text, *message;
    } cases[] = {
        {"2*vddd", "f.cir:3:7: unknown name 'vddd'; did you mean 'vdd'?"},
        {"1 + sinn(2)", "f.cir:3:9: unknown function 'sinn'; did you mean 'sin'?"},
        {"max()", "f.cir:3:5: max() takes 2 arguments, not 0"},
        {"limit(1)", "f.cir:3:5: limit() takes 2 or 3 arguments, not 1"},
        {"1k5", "f.cir:3:5: '1k5' is not a number; write 1.5k"},
        {"(2", "f.cir:3:5: this '(' is not closed"},
        {"max(1,2", "f.cir:3:8: this '(' is not closed"},
        {"2 3", "f.cir:3:7: expected an operator such as + or the end of the expression, not '3'"},
        {"2)", "f.cir:3:6: expected an operator such as + or the end of the expression, not ')'"},
        {"2+", "f.cir:3:7: expected a number, a name or '(', not the end"},
        {"", "f.cir:3:5: expected a number, a name or '(', not the end"},
        {"a=3", "f.cir:3:5: unknown name 'a'"},
        {"2=3", "f.cir:3:6: '=' is an assignment; compare two values with '=='"},
        {"1?2", "f.cir:3:8: expected ':', as in c ? a : b, not the end"},
        {"v(a,b,c)", "f.cir:3:5: 'v(a,b,c)' is not a voltage; write v(node) or v(node,node)"},
        {"i(a,b)", "f.cir:3:5: 'i(a,b)' is not a current; write i(element)"},
        {"v()", "f.cir:3:5: 'v()' is not a voltage; write v(node) or v(node,node)"},
        {"v(a", "f.cir:3:6: this '(' is not closed"},
        {"ddt(v(a))", "f.cir:3:5: ddt() is not supported; for a charge, use a capacitor with q='...'"},
        {"hertz", "f.cir:3:5: an expression must not depend on the frequency (hertz)"},
        {"1+f(2)", "f.cir:3:7: in f(): unknown name 'vddd'; did you mean 'vdd'?"},
        {"f(1,2)", "f.cir:3:5: f() takes 1 argument, not 2"},
        {"2*g(1)", "f.cir:3:7: in h(): g() calls itself"},
        {"2 # 3", "f.cir:3:7: expected an operator such as + or the end of the expression, not '# 3'"},
    };
    for (const auto& c : cases) {
        const auto parsed = read(c.text, s);
        ASSERT_FALSE(parsed) << c.text;
        EXPECT_EQ(parsed.error().text(), c.message);
    }
    const auto in_parameter = read("1+v(a)", ExpressionScope{});
    ASSERT_FALSE(in_parameter);
    EXPECT_EQ(in_parameter.error().text(), "f.cir:3:7: v(...) is not available in a parameter, only in an expression of the circuit");
}

TEST(Expression, RejectsTooDeepNesting) {
    constexpr std::size_t n = 100000;
    std::string ternary, calls, powers = "1";
    for (std::size_t k = 0; k < n; ++k) ternary += "1?1:", calls += "sin(", powers += "^1";
    for (const auto& text :
         {std::string(n, '('), std::string(n, '(') + "1" + std::string(n, ')'), std::string(n, '{'), ternary + "1", calls}) {
        const auto f = read(text);
        ASSERT_FALSE(f);
        EXPECT_EQ(f.error().message, "the expression is nested deeper than the limit of 200");
    }
    EXPECT_EQ(value(std::string(n, '-') + "1"), 1) << "signs are not nested";
    EXPECT_EQ(value(powers), 1);
    std::string deepest(190, '(');
    EXPECT_EQ(value(deepest + "7" + std::string(190, ')')), 7);
}

TEST(Expression, RejectsFunctionsThatExpandExponentially) {
    std::map<std::string, ExpressionScope::Function, std::less<>> functions{{"f0", {{"x"}, "x"}}};
    for (int k = 1; k < 60; ++k) functions[fmt::format("f{}", k)] = {{"x"}, fmt::format("f{0}(f{0}(x))", k - 1)};
    ExpressionScope s;
    s.function = [&](std::string_view name) {
        const auto at = functions.find(name);
        return at == functions.end() ? nullptr : &at->second;
    };
    const auto f = read("f59(1)", s);
    ASSERT_FALSE(f);
    EXPECT_EQ(f.error().message.substr(f.error().message.find("the ")), "the expression has more than 1000000 steps");
    EXPECT_EQ(value("f8(3)", s), 3);
}

TEST(Expression, ItsDerivativesEqualFiniteDifferences) {
    const struct {
        const char* text;
        double low, high;
    } cases[] = {
        {"v(a)*v(b)+v(a)/v(b)", 0.2, 3},
        {"v(a)^v(b)", 0.2, 3},
        {"pow(v(a),v(b))", 0.2, 3},
        {"pwr(v(a)-5,v(b))", 0.2, 3},
        {"(v(a)-5)^v(b)", 0.2, 3},
        {"exp(v(a))*ln(v(b))", 0.2, 3},
        {"log10(v(a))*sqrt(v(b))", 0.2, 3},
        {"sin(v(a))*cos(v(b))", -3, 3},
        {"tan(v(a)/3)+tanh(v(b))", -3, 3},
        {"asin(v(a))+acos(v(b))", -0.9, 0.9},
        {"atan(v(a))+atan2(v(a),v(b))", 0.2, 3},
        {"hypot(v(a),v(b))", 0.2, 3},
        {"sinh(v(a))*cosh(v(b))", -2, 2},
        {"asinh(v(a))+atanh(v(b))", -0.9, 0.9},
        {"acosh(1+v(a)*v(a)+v(b)*v(b))", 0.2, 3},
        {"abs(v(a)-0.1)*max(v(a),v(b))", 0.2, 3},
        {"min(v(a),2*v(b)-0.1)", 0.2, 3},
        {"limit(v(a)*2,v(b),1.1+v(b))", 0.2, 3},
        {"v(a)>v(b) ? v(a)*v(b) : -v(a)", 0.2, 3},
        {"uramp(v(a)-v(b)/2)+u2(v(a)/4)", 0.2, 3},
        {"!v(a) + floor(v(a)) + int(v(b)) + u(v(a)) + sgn(v(b))", 0.21, 0.9},
        {"-v(a,b)^2", 0.2, 3},
        {"agauss(v(a),1,1)*v(b)", 0, 1},
    };
    for (const auto& c : cases) {
        const auto f = read(c.text);
        ASSERT_TRUE(f) << f.error().text();
        EXPECT_TRUE(rc::check(c.text, [&] {
            std::vector<double> x(f->inputs().size()), slopes(x.size());
            for (double& v : x) v = c.low + (c.high - c.low) * *rc::gen::inRange(0, 100000) / 1e5;
            RC_ASSERT(f->value(x, slopes) == f->value(x));
            for (std::size_t k = 0; k < x.size(); ++k) {
                const double h = 1e-6;
                auto up = x, down = x;
                up[k] += h, down[k] -= h;
                const double by_difference = (f->value(up) - f->value(down)) / (2 * h);
                const double left = (f->value(x) - f->value(down)) / h, right = (f->value(up) - f->value(x)) / h;
                if (std::abs(left - right) > 1e-2 * (1 + std::abs(left))) continue;  // a kink
                RC_ASSERT(std::abs(slopes[k] - by_difference) <= 1e-5 * (1 + std::abs(by_difference)));
            }
        }));
    }
}

TEST(Expression, PassesNoInfiniteSlopeThroughTheBranchNotTaken) {
    const auto f = read("v(a) > 0 ? sqrt(v(a)) : 0*v(b)");
    const double x[] = {0, 2};
    double slopes[2];
    EXPECT_EQ(f->value(x, slopes), 0);
    EXPECT_EQ(slopes[0], 0);
    EXPECT_EQ(slopes[1], 0);
}

/// A random expression and its separately computed value.
struct RandomExpression {
    std::string text;
    double value;
};

RandomExpression make_random_expression(int depth, std::span<const double> inputs) {
    const int kind = depth == 0 ? *rc::gen::inRange(0, 2) : *rc::gen::inRange(0, 12);
    if (kind == 0) {
        const double x = *rc::gen::inRange(0, 1000) / 64.0;
        return {fmt::format("{}", x), x};
    }
    if (kind == 1) {
        const auto k = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(inputs.size())));
        return {fmt::format("v(n{})", k), inputs[k]};
    }
    const RandomExpression a = make_random_expression(depth - 1, inputs);
    if (kind == 2) return {fmt::format("(-{})", a.text), -a.value};
    if (kind == 3) return {fmt::format("abs({})", a.text), std::abs(a.value)};
    if (kind == 4) return {fmt::format("floor( {} )", a.text), std::floor(a.value)};
    const RandomExpression b = make_random_expression(depth - 1, inputs);
    if (kind == 5) return {fmt::format("({} + {})", a.text, b.text), a.value + b.value};
    if (kind == 6) return {fmt::format("({}-{})", a.text, b.text), a.value - b.value};
    if (kind == 7) return {fmt::format("({}*{})", a.text, b.text), a.value * b.value};
    if (kind == 8) return {fmt::format("max({},{})", a.text, b.text), a.value < b.value ? b.value : a.value};
    if (kind == 9) return {fmt::format("({}<{})", a.text, b.text), a.value < b.value ? 1.0 : 0.0};
    if (kind == 10) return {fmt::format("({}/{})", a.text, b.text), a.value / b.value};
    const RandomExpression c = make_random_expression(depth - 1, inputs);
    return {fmt::format("({} ? {} : {})", a.text, b.text, c.text), a.value != 0 ? b.value : c.value};
}

TEST(Expression, RandomExpressionsEvaluateToTheirValues) {
    EXPECT_TRUE(rc::check([] {
        const double nodes[] = {1.5, -2.25, 0};
        const RandomExpression random = make_random_expression(*rc::gen::inRange(0, 6), nodes);
        const auto f = read(random.text);
        RC_ASSERT(static_cast<bool>(f));
        std::vector<double> x;
        for (const auto& input : f->inputs()) x.push_back(nodes[input.name[1] - '0']);
        const double got = f->value(x);
        RC_ASSERT(got == random.value || (std::isnan(got) && std::isnan(random.value)));
    }));
}

TEST(Expression, AnyTextIsHandledSafely) {
    EXPECT_TRUE(rc::check([](const std::string& text) { RC_ASSERT(read(text) || true); }));
}

}  // namespace
}  // namespace corpuscle::circuit
