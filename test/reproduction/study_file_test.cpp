#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/data/study_expression.hpp"
#include "reproduction/data/study_from_file.hpp"
#include "reproduction/data/study_functions.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

Result<StudyResult> run_text(const std::string& text, StudyValues values = {}) {
    const auto file = read_study_file("title = 'A study'\nquestion = 'Why?'\nkind = 'predicted'\n" + text, "x.toml");
    if (!file) return file.error();
    return run_study_file(*file, {}, std::move(values));
}
std::string error_of(const std::string& text) {
    const auto outcome = run_text(text);
    return outcome ? "no error" : outcome.error().text();
}
Result<StudyValue> value_of(const std::string& expression) {
    const StudyValues names = {{"saw", StudyCurve{{0, 1, 2, 3}, {0, 2, 0, 2}}},
                               {"hill", StudyCurve{{0, 1, 2}, {-3, 5, 1}}},
                               {"train", StudyList{0.1, 0.3, 0.6}},
                               {"word", std::string("yes")}};
    return evaluate_study_expression(expression, {"x.toml", 3, 1}, [&](const std::string& name) -> Result<StudyValue> {
        const auto found = names.find(name);
        if (found != names.end()) return found->second;
        if (const auto* constant = find_study_constant(name)) return *constant;
        return bad_input("unknown name '" + name + "'");
    });
}
double number(const std::string& expression) { return std::get<double>(test::value_or_throw(value_of(expression))); }

constexpr auto divider = R"toml(
[[run]]
netlist = """
A divider
v1 a 0 2
r1 a b 1k
r2 b 0 3k
"""
directives = ".op\n.dc v1 0 4 1\n.meas dc half find v(b) at=2"
)toml";

TEST(StudyExpression, HasTheOperatorsOfNetlistExpressions) {
    EXPECT_EQ(number("1 + 2 * 3 - 4 / 2"), 5);
    EXPECT_EQ(number("-(2 + 1) * 100n"), -3 * 100e-9);
    EXPECT_EQ(number("1 < 2 && !(3 <= 2) || 0"), 1);
    EXPECT_EQ(number("2 > 1 ? 7 : 8"), 7);
    EXPECT_EQ(number("max(hypot(3, 4), pow(2, 2))"), 5);
    EXPECT_EQ(number("2 * pi"), 2 * M_PI);
}

TEST(StudyExpression, ActsOnCurvesPointByPoint) {
    const auto sum = std::get<StudyCurve>(test::value_or_throw(value_of("abs(hill) + 2 * saw")));
    EXPECT_EQ(sum.x, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(sum.y, (std::vector<double>{3, 9, 1}));
    EXPECT_EQ(number("(hill / 2).at(0.5)"), 0.5);
    EXPECT_EQ(number("saw.crossing(1, 0.6)"), 1.5);
    EXPECT_EQ(number("saw.at(hill.x).max"), 2);
    EXPECT_EQ(number("conductance(curve([400], [400])).first"), number("conductance(400)"));
    EXPECT_EQ(number("(train * 10).last"), 6);
    EXPECT_EQ(number("train.count(window(0.2, 1))"), 2);
}

TEST(StudyExpression, NamesTheFaultAndItsPlace) {
    const auto error = [](const std::string& text) { return value_of(text).error().text(); };
    EXPECT_EQ(error("hil + 1"), "x.toml:3:1: 'hil + 1': unknown name 'hil'");
    EXPECT_EQ(error("hill.maxx"), "x.toml:3:1: 'hill.maxx': there is no function 'maxx'; did you mean 'max'?");
    EXPECT_EQ(error("hill.at(word)"), "x.toml:3:1: 'hill.at(word)': at() does not take a curve, a text");
    EXPECT_EQ(error("(1 + 2"), "x.toml:3:1: '(1 + 2': expected ')' before the end");
    EXPECT_EQ(error("1 2"), "x.toml:3:1: '1 2': expected an operator or the end, not '2'");
    EXPECT_EQ(error("word ? 1 : 2"), "x.toml:3:1: 'word ? 1 : 2': the condition before '?' must be a number");
    EXPECT_EQ(error("hill.dc[v(a)]"), "x.toml:3:1: 'hill.dc[v(a)]': a curve has no 'dc'");
}

TEST(StudyFile, ComputesClaimsAndPlotsFromARun) {
    const auto out = test::value_or_throw(run_text(std::string(divider) + R"toml(
[values]
V = "run.dc[v(b)]"
V_2 = "V.at(2)"

[texts]
source = "the divider {V_2:.2f}"

[[claim]]
label = "V at 2 V"
value = "V_2"
unit = "V"
published = "3 / 2"
source = "{source}"
explain_if_needed = "never"

[[claim]]
label = "by .meas {{braces}}"
true = "dc[v(b)].at(2) == meas[half] && op[v(b)] < 1.6"

[[plot]]
title = "P"
x = "V"
y = "V"
log_x = true
series = [{ each = { k = [1, 2] }, name = "times {k}", line = "{k} * V" }, { name = "end", points = "curve([4], [3])" }]

[[note]]
text = "ends at {V.last:g} V"
)toml"));
    ASSERT_EQ(out.claims.size(), 2u);
    EXPECT_NEAR(out.claims[0].computed, 1.5, 1e-9);
    EXPECT_EQ(out.claims[0].published, 1.5);
    EXPECT_EQ(out.claims[0].source, "the divider 1.50");
    EXPECT_EQ(out.claims[0].note, "");
    EXPECT_STREQ(out.claims[1].verdict(), "holds");
    EXPECT_EQ(out.claims[1].label, "by .meas {braces}");
    ASSERT_EQ(out.plots.size(), 1u);
    ASSERT_EQ(out.plots[0].series.size(), 3u);
    EXPECT_EQ(out.plots[0].series[1].name, "times 2");
    EXPECT_NEAR(out.plots[0].series[1].y.back(), 6, 1e-9);
    EXPECT_EQ(out.plots[0].series[2].style, StudyPlot::Style::points);
    EXPECT_EQ(out.notes, (std::vector<std::string>{"ends at 3 V"}));
}

TEST(StudyFile, RepeatsItemsForEachValueOfItsVariables) {
    const auto out = test::value_or_throw(run_text(R"toml(
[[values]]
each = { k = ["a", "b"], n = [1, 2] }
"twice_{k}" = "2 * {n}"

[values."line_{k}"]
each = { x = [1, 2, 3] }
x = "{x}"
y = "{x} < 3 ? twice_{k} * {x} : none"

[[group]]
each = { k = ["a", "b"] }

[[group.claim]]
label = "first {k}"
value = "twice_{k} + offset"

[[group.claim]]
label = "last {k}"
value = "line_{k}.last"

[group.values]
offset = "0.5"

[[claim]]
each = { k = [7, 8] }
label = "{k}"
value = "{k} * from_cpp"
)toml",
                                                   {{"from_cpp", 10.0}}));
    std::vector<std::pair<std::string, double>> claims;
    for (const auto& c : out.claims) claims.emplace_back(c.label, c.computed);
    EXPECT_EQ(claims, (std::vector<std::pair<std::string, double>>{
                          {"first a", 2.5}, {"last a", 4}, {"first b", 4.5}, {"last b", 8}, {"7", 70}, {"8", 80}}));
}

TEST(StudyFile, RunsTrials) {
    const auto out = test::value_or_throw(run_text(R"toml(
[[trial]]
name = "sa1"
afferent = "sa1"
settings = ["press.F_max={2 * 2}N"]
probes = ["u"]

[[trial]]
name = "press"
rate = 1000

[[claim]]
label = "spikes"
value = "sa1.spikes.count(always)"
min = 1
source = "the model"

[[claim]]
label = "largest force"
value = "max(sa1.force.max, press.force.max) * (sa1.probe[u].max > 0)"

[[plot]]
title = "spikes"
series = [{ name = "sa1", raster = "sa1.spikes" }]
)toml"));
    EXPECT_TRUE(out.claims[0].is_in_allowed_range());
    EXPECT_NEAR(out.claims[1].computed, 4, 1e-12);
    EXPECT_FALSE(out.plots[0].series[0].x.empty());
}

TEST(StudyFile, GivesEachClaimTheKindOfTheFileOrItsOwn) {
    const auto out = test::value_or_throw(run_text(R"toml(
[[claim]]
label = "a"
value = 350.3
published = 347
tolerance = "0.1 * 3"
source = "the effect is 3"

[[claim]]
each = { kind = ["fitted", "misprint"] }
label = "b"
value = 1
published = 1
kind = "{kind}"
source = "there"
)toml"));
    EXPECT_EQ(out.claims[0].kind, ClaimKind::predicted);
    EXPECT_STREQ(out.claims[0].verdict(), "differs");
    EXPECT_EQ(out.claims[1].kind, ClaimKind::fitted);
    EXPECT_EQ(out.claims[2].kind, ClaimKind::misprint);
}

TEST(StudyFile, NamesTheFaultAndItsPlace) {
    const std::string claim = "\n[[claim]]\nlabel = 'x'\nvalue = ";
    EXPECT_EQ(
        error_of("[[claim]]\nlable = 'x'"),
        "x.toml:5:1: claim: there is no 'lable'; did you mean 'label'? (there are each, label, value, true, unit, published, derived, "
        "tolerance, min, max, kind, source, explain, explain_if_needed, explain_if_undefined)");
    EXPECT_EQ(error_of("[[claim]]\nvalue = 1"), "x.toml:4:1: claim: 'label' is missing");
    EXPECT_EQ(error_of("[[claim]]\nlabel = 'x'"), "x.toml:4:1: a claim has either 'value', a number, or 'true', a statement");
    EXPECT_NE(
        error_of(divider + claim + "'run.dc[v(c)]'").find("dc has no 'v(c)'; did you mean 'v(a)'? (there are v-sweep, v(a), v(b), i(v1))"),
        std::string::npos)
        << error_of(divider + claim + "'run.dc[v(c)]'");
    EXPECT_NE(error_of(divider + claim + "'meas[hal]'").find("meas has no 'hal'; did you mean 'half'?"), std::string::npos);
    EXPECT_NE(error_of(divider + claim + "'ac[v(a)]'").find("ac has no 'v(a)'; add a line .ac to the run's directives"), std::string::npos);
    EXPECT_NE(error_of(divider + claim + "'dc[v(a)]'").find("is a curve; expected a number"), std::string::npos);
    EXPECT_NE(error_of("[values]\na = 'b'\nb = 'a'" + claim + "'a'").find("the value 'a' depends on itself"), std::string::npos)
        << error_of("[values]\na = 'b'\nb = 'a'" + claim + "'a'");
    EXPECT_NE(error_of(std::string(divider) + divider).find("there are two runs or values 'run'; give each a name"), std::string::npos);
    EXPECT_EQ(error_of("[[run]]\ncircuit = 'nowhere'"),
              "x.toml:4:1: run 'run': circuits/nowhere.cir: there is no embedded file 'circuits/nowhere.cir'");
    EXPECT_EQ(error_of("[[run]]\nname = 'a'\nnetlist = '''T\nr1 a 0\n'''").substr(0, 39), "x.toml:4:1: run 'a': line 2 of the netl");
    EXPECT_NE(error_of("[[claim]]\neach = { a = [1, 2], b = [1] }\nlabel = 'x'\nvalue = 1").find("b has 1 elements, another list 2"),
              std::string::npos);
    EXPECT_EQ(error_of("[[run]]\ncircuit = 'divider'\nsettings = 'r1=2'"), "x.toml:6:12: settings must be a list: settings = [...]");
    EXPECT_EQ(error_of("[[run]]\ncircuit = 'divider'\nideal_mirrors = 1"), "x.toml:6:17: ideal_mirrors must be true or false");
    EXPECT_EQ(error_of("[[run]]\nsettings = []"), "x.toml:4:1: a run has either 'circuit' or 'netlist'");
    EXPECT_EQ(error_of(claim + "1\npublished = 1\nderived = 2"), "x.toml:5:1: a claim has 'published' or 'derived', not both");
    EXPECT_EQ(error_of(claim + "1\ntolerance = 1"),
              "x.toml:5:1: tolerance is the allowed difference from 'published' or 'derived'; the claim has neither");
    EXPECT_EQ(error_of(claim + "1\nkind = 'input '"),
              "x.toml:8:8: unknown kind of claim 'input '; did you mean 'input'? (known: predicted, fitted, input, identity, arithmetic, "
              "misprint, ours)");
    EXPECT_EQ(read_study_file("title = 'A study'\nquestion = 'Why?'\n", "y.toml").error().text(), "y.toml:1:1: 'kind' is missing");
    EXPECT_EQ(read_study_file("title = 'A study'\nquestion = 'Why?'\nkind = 'fit'\n", "y.toml").error().location.line, 3);
    EXPECT_NE(error_of("[[note]]\ntext = 'a { b'").find("write {{ or }} for a brace"), std::string::npos);
}

TEST(StudyFile, OfEveryStudyIsReadWithoutError) {
    for (const auto* study : all_studies()) {
        EXPECT_FALSE(study->title.empty()) << study->name << ": " << (study->title.empty() ? study->run({}).error().text() : "");
        EXPECT_FALSE(study->question.empty()) << study->name;
    }
}

}  // namespace
}  // namespace corpuscle
