// Exported decks give the same results as their netlists, both in ngspice and when Corpuscle reads them back.

#include <fmt/format.h>
#include <cmath>
#include <map>
#include <set>

#include "circuit/devices.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/export/ngspice_deck.hpp"
#include "circuit/expression/spice_number.hpp"
#include "support/ngspice.hpp"
#include "support/program.hpp"
#include "support/property.hpp"

namespace corpuscle::circuit::test {
namespace {

std::vector<std::string> netlists_in(const std::string& folder) {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(source_root() + folder))
        if (entry.path().extension() == ".cir") out.push_back(entry.path().string());
    std::sort(out.begin(), out.end());
    return out;
}

/// All netlists of the project that can be exported to ngspice.
std::vector<std::string> netlists() {
    std::vector<std::string> out;
    for (const char* folder : {"/circuits", "/test/circuit/decks", "/test/circuit/export"})
        for (auto& path : netlists_in(folder)) out.push_back(std::move(path));
    return out;
}

std::string exported(const std::shared_ptr<const Circuit>& circuit) {
    const auto deck = ngspice_deck(circuit);
    EXPECT_TRUE(deck) << (deck ? "" : deck.error().text());
    return deck ? deck->text : "";
}

/// Name of a curve in the exported deck's plots: "i(x1.v1)" becomes "i(v_x1_v1)".
std::string exported_name(const ExportNames& names, const std::string& curve) {
    if (!curve.starts_with("v(") && !curve.starts_with("i(")) return curve;
    const auto inside = curve.substr(2, curve.size() - 3);
    const auto known = curve[0] == 'v' ? names.node(inside) : names.element(inside);
    return known.empty() ? curve : fmt::format("{}({})", curve[0], known);
}

/// Expects the curves of two plots to agree. The relative tolerance is 1e-5, for small signals and noise 1e-3. The absolute tolerance
/// covers the simulators' own floors: 2 nV and 1e-16 A, and for small signals 1e-9 of the largest value. With ngspice's own diodes and
/// transistors it is also 1e-7 of the largest current, because ngspice's kT/q differs from the SI value in the seventh digit.
void compare_with_export(const ExportNames& names, bool diodes, const Plot& result, const Plot& reference) {
    SCOPED_TRACE(result.name);
    ASSERT_EQ(result.point_count(), reference.point_count());
    std::map<std::string, const Curve*> reference_curves;
    for (const auto& c : reference.curves) reference_curves[corpuscle_name(c.name)] = &c;
    const bool small = result.is_complex || result.name.find("oise") != std::string::npos;
    for (const auto& c : result.curves) {
        if (c.name.find('#') != std::string::npos && c.name.starts_with("v(")) continue;  // an internal node of a device
        if (c.name.ends_with("-sweep") || c.name == "frequency" || c.name == "inoise_total" || c.name == "onoise_total") continue;
        const auto match = reference_curves.find(exported_name(names, c.name));
        ASSERT_NE(match, reference_curves.end()) << c.name << " as " << exported_name(names, c.name);
        double largest = 0;
        for (const auto& x : c.values) largest = std::max(largest, std::abs(x));
        const double floor = small                 ? 1e-9 * largest + 1e-30
                             : c.type == "current" ? 1e-16 + (diodes ? 1e-7 * largest : 0)
                                                   : 2e-9,
                     tolerance = small ? 1e-3 : 1e-5;
        for (std::size_t k = 0; k < c.values.size(); ++k)
            ASSERT_LE(std::abs(c.values[k] - match->second->values[k]), tolerance * std::abs(c.values[k]) + floor)
                << c.name << " at point " << k << ": netlist " << c.values[k] << ", export " << match->second->values[k];
    }
}

/// Compares plots of the same name, in the order of their directives. In a deck that Corpuscle reads back, directives run in reverse order.
void compare_all_with_export(const Circuit& circuit, const std::vector<Plot>& result, std::vector<Plot> reference, bool is_reversed) {
    if (is_reversed) std::reverse(reference.begin(), reference.end());
    const ExportNames names(circuit);
    const bool diodes = std::any_of(circuit.elements.begin(), circuit.elements.end(), [](const Element& e) {
        return e.letter == 'd' || e.letter == 'q' || (e.letter == 'm' && !has_role(e, Role::transistor));
    });
    std::map<std::string, std::size_t> seen;
    for (const auto& plot : result) {
        std::size_t skip = seen[plot.name]++;
        const auto match =
            std::find_if(reference.begin(), reference.end(), [&](const Plot& p) { return p.name == plot.name && skip-- == 0; });
        ASSERT_NE(match, reference.end()) << "no plot '" << plot.name << "'";
        compare_with_export(names, diodes, plot, *match);
    }
}

/// Path of a netlist with built-in transistors: for a deck of transistors written as expressions, of a converted copy.
std::string path_with_native_transistors(const TemporaryFolder& folder, const std::string& path) {
    const auto name = std::filesystem::path(path).stem().string();
    return name.starts_with("uicm_") ? folder.write("native.cir", with_native_transistors(path)) : path;
}

/// Makes a sweep one that ngspice supports: in one direction, and with about fifty points, because ngspice is slow here.
void simplify(Directive& dc) {
    if (dc.words.back() == "updown") dc.words.pop_back();
    for (std::size_t k = 0; k + 3 < dc.words.size(); k += 4) {
        const auto number = [&](std::size_t j) { return parse_number(dc.words[k + j])->value; };
        const double factor = std::max(1.0, std::floor((number(2) - number(1)) / number(3) / 50)), step = number(3);
        dc.words[k + 3] = fmt::format("{:.17g}", step * factor);
    }
}

/// Removes directives that ngspice does not support, those that only ngspice would run, and .tran, whose points differ between simulators.
std::shared_ptr<const Circuit> with_common_directives(const std::shared_ptr<const Circuit>& circuit) {
    auto out = std::make_shared<Circuit>(*circuit);
    std::erase_if(out->directives, [](const Directive& c) {
        return c.name == "expect" || c.name == "step" || c.name == "mc" || c.name == "tran" || c.name.starts_with("meas");
    });
    for (auto& c : out->directives)
        if (c.name == "dc") simplify(c);
    return out;
}

class Export : public testing::TestWithParam<std::string> {};

TEST_P(Export, GivesTheSameResultsInNgspice) {
    if (is_another_formula(GetParam())) GTEST_SKIP() << "this ngspice has another formula";
    const TemporaryFolder folder;
    const auto read = elaborate_netlist(path_with_native_transistors(folder, GetParam()));
    ASSERT_TRUE(read);
    const auto circuit = with_common_directives(read);
    const auto log = run_ngspice(folder.write("deck.cir", exported(circuit)), folder / "deck.raw");
    const auto result = run_directives(circuit);
    ASSERT_TRUE(result) << result.error().text();
    const auto reference = read_raw_file(folder / "deck.raw");
    ASSERT_FALSE(reference.empty()) << log;
    compare_all_with_export(*circuit, result->plots(), reference, false);
    if (HasFailure()) std::puts(log.c_str());
}

TEST_P(Export, ReadsBackWithTheSameResults) {
    // For transistors as expressions in a loop of high gain (amplifier, trigger), Corpuscle's operating-point search fails; ngspice's does
    // not.
    for (const auto* known : {"/force_to_current.cir", "/rectifier_sa.cir", "/rectifier_fa.cir"})
        if (GetParam().ends_with(known)) GTEST_SKIP() << "known: no operating point is found for the deck read back";
    const TemporaryFolder folder;
    const auto read = elaborate_netlist(path_with_native_transistors(folder, GetParam()));
    ASSERT_TRUE(read);
    const auto circuit = with_common_directives(read);
    const auto result = run_directives(circuit);
    ASSERT_TRUE(result) << result.error().text();
    const auto deck = elaborate_netlist(folder.write("deck.cir", exported(circuit)));
    ASSERT_TRUE(deck);
    auto again = std::make_shared<Circuit>(*deck);
    for (const auto* name : {"reltol", "vntol"}) again->options.erase(name);  // ngspice needs tight tolerances; the defaults suffice here
    const auto back = run_directives(std::shared_ptr<const Circuit>(again));
    ASSERT_TRUE(back) << back.error().text();
    compare_all_with_export(*circuit, result->plots(), back->plots(), true);
    const auto second = elaborate_netlist(folder.write("twice.cir", exported(again)));
    ASSERT_TRUE(second);
    auto twice = std::make_shared<Circuit>(*second);
    for (const auto* name : {"reltol", "vntol"}) twice->options.erase(name);
    const auto last = run_directives(std::shared_ptr<const Circuit>(twice));
    ASSERT_TRUE(last) << last.error().text();
    compare_all_with_export(*again, back->plots(), last->plots(), true);
}

INSTANTIATE_TEST_SUITE_P(Netlists, Export, testing::ValuesIn(netlists()), [](const auto& one) {
    const std::filesystem::path path(one.param);
    return path.parent_path().filename().string() + "_" + path.stem().string();
});

/// Compares six digits. The inverter also has an .op; after it ngspice would measure nothing, so the export reports this.
TEST(ExportedDirectives, AreMeasuredTheSameByNgspice) {
    const TemporaryFolder folder;
    auto circuit = std::make_shared<Circuit>(*elaborate_netlist(source_root() + "/circuits/inverter.cir"));
    const auto with_op = ngspice_deck(circuit);
    ASSERT_TRUE(with_op);
    EXPECT_NE(with_op->text.find("* .meas dc: ngspice measures only the analysis that it runs last, here .op"), std::string::npos);
    std::erase_if(circuit->directives, [](const Directive& c) { return c.name == "op"; });
    const auto log = run_ngspice(folder.write("deck.cir", exported(circuit)), "");
    const auto result = run_directives(circuit);
    ASSERT_TRUE(result);
    ASSERT_EQ(result->numbers.size(), 2U);
    for (const auto& [name, value] : result->numbers) EXPECT_NEAR(logged_number(log, name), value, 1e-4 * std::abs(value)) << log;
}

TEST(ExportedDirectives, DistancesBetweenCrossingsAndMeasuresOfAnAcAreMeasuredByNgspice) {
    const TemporaryFolder folder;
    const std::string filter = "a filter\nv1 a 0 dc 0 ac 1 sin(0 1 1k)\nr1 a b 1k\nc1 b 0 100n\n";
    for (const auto& [lines, expected] :
         std::vector<std::pair<std::string, std::string>>{{".tran 1u 4m\n.meas tran late trig v(a)=0.1 rise=2 targ v(b) val=0.1 rise=2\n",
                                                           ".meas tran late trig v(a) val=0.1 rise=2 targ v(b) val=0.1 rise=2\n"},
                                                          {".ac dec 100 10 100k\n.meas ac half when vm(b)=0.5\n", ".save all\n"}}) {
        const std::shared_ptr<const Circuit> circuit = elaborate_netlist(folder.write("filter.cir", filter + lines));
        const auto deck = exported(circuit);
        EXPECT_NE(deck.find(expected), std::string::npos) << deck;
        const auto log = run_ngspice(folder.write("deck.cir", deck), "");
        const auto result = run_directives(circuit);
        ASSERT_TRUE(result && result->numbers.size() == 1);
        const auto& [name, value] = result->numbers[0];
        EXPECT_NEAR(logged_number(log, name), value, 1e-3 * value) << log;
    }
    const auto left_out = ngspice_deck(elaborate_netlist(folder.write(
        "filter.cir", filter + ".tran 1u 4m\n.meas tran x trig v(a)=v(b) rise=1 targ v(a)=0 fall=2\n.meas tran y param='2*x'\n")));
    ASSERT_TRUE(left_out);
    EXPECT_NE(left_out->text.find(
                  "* left out: .meas tran x trig v(a)=v(b) rise=1 targ v(a)=0 fall=2 (ngspice has no trig where two curves cross)"),
              std::string::npos);
    EXPECT_NE(left_out->text.find("(it needs x, which is left out)"), std::string::npos);
}

TEST(ExportedDirectives, TheForceIsExportedInTheWaveformsOfItsSources) {
    const TemporaryFolder folder;
    const auto circuit =
        elaborate_netlist(folder.write("touch.cir",
                                       "touched\nvf f 0 force 2\nrf f s 1k\ncs s 0 10u\n.force press f_max=3\n.tran 1m 1 0 2m\n"
                                       ".meas tran rising find v(s) at=0.31\n.meas tran held find v(s) at=0.5\n"
                                       ".meas tran falling find v(s) at=0.7\n"));
    const auto shared = std::make_shared<Circuit>(*circuit);
    const auto log = run_ngspice(folder.write("deck.cir", exported(shared)), "");
    const auto result = run_directives(shared);
    ASSERT_TRUE(result);
    ASSERT_EQ(result->numbers.size(), 3U);
    for (const auto& [name, value] : result->numbers) EXPECT_NEAR(logged_number(log, name), value, 1e-3) << name << log;
    EXPECT_NEAR(result->numbers[1].second, 6, 1e-3);
}

constexpr const char* unsupported_directives = R"(directives that ngspice does not support
.param w=1.5u
vdd v 0 0.7
vin g 0 dc 0.4 ac 1
x1 d g v load
.subckt load d g v
m1 d g 0 0 nch w={w} l=0.5u
r1 v d 1meg
.ends
.model nch nmos(level=80)
.dc vin 0 0.7 0.05 updown
.dc temp 0 50 10
.noise v(d) vin dec 5 1 1k
.step param w 1u 2u 0.5u
.mc 10
.meas dc half when v(d)=0.35
.print v(d) i(vdd)
.expect half 0.35 1
.end
)";

TEST(ExportedDirectives, UnsupportedByNgspiceStayAsCommentsAndAreReported) {
    const TemporaryFolder folder;
    const auto deck = ngspice_deck(elaborate_netlist(folder.write("x.cir", unsupported_directives)));
    ASSERT_TRUE(deck);
    for (const char* line :
         {"* left out: .step param w 1u 2u 0.5u", "* left out: .mc 10", "* left out: .expect half 0.35 1", "* left out: .dc temp 0 50 10",
          "* left out: updown", "\n.dc vin 0 0.7 0.05\n", "\n.print dc v(d) i(vdd)\n", "\n.meas dc half when v(d)=0.35\n",
          "\nxm_x1_m1 d g 0 0", "* .meas dc: ngspice measures only the analysis that it runs last, here .noise",
          "* ngspice's result lacks the noise of the transistors"})
        EXPECT_NE(deck->text.find(line), std::string::npos) << line << "\n" << deck->text;
    EXPECT_EQ(deck->warnings.size(), 7U);
    for (const auto& e : deck->warnings) EXPECT_GT(e.location.line, 10) << e.text();
}

TEST(ExportedNames, AreLegalAndOneToOne) {
    EXPECT_TRUE(rc::check([](const std::vector<std::string>& wanted) {
        Circuit circuit;
        for (const auto& w : wanted) {
            const auto name = "n" + w;
            if (circuit.node_numbers.try_emplace(name, static_cast<int>(circuit.nodes.size())).second) circuit.nodes.push_back(name);
            circuit.elements.push_back({});
            circuit.elements.back().name = "x." + name, circuit.elements.back().letter = 'r';
            circuit.elements.back().kind = find_device_kind('r');
        }
        const ExportNames names(circuit);
        std::set<std::string> nodes, elements;
        for (std::size_t k = 0; k < circuit.nodes.size(); ++k) nodes.insert(names.node(static_cast<int>(k)));
        for (std::size_t k = 0; k < circuit.elements.size(); ++k) elements.insert(names.element(k));
        RC_ASSERT(nodes.size() == circuit.nodes.size());
        RC_ASSERT(elements.size() == circuit.elements.size());
        for (const auto& name : nodes) RC_ASSERT(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.#") == std::string::npos);
    }));
}

/// Text of a random expression of v(a), v(b) and i(v1) that never overflows and does not depend on the sign of zero.
rc::Gen<std::string> formulas(int depth) {
    const auto leaf = rc::gen::element<std::string>("v(a)", "v(b)", "v(a,b)", "i(v1)", "2.5", "1m", "(-3)", "temper", "0");
    if (depth == 0) return leaf;
    const auto inner = formulas(depth - 1);
    const auto from_format = [&](std::string form) {
        return rc::gen::map(rc::gen::tuple(inner, inner, inner), [form](const auto& t) {
            return fmt::format(fmt::runtime(form), std::get<0>(t), std::get<1>(t), std::get<2>(t));
        });
    };
    return rc::gen::oneOf(
        leaf, from_format("({0}+{1})"), from_format("({0}-{1})"), from_format("({0}-({1}-{2}))"), from_format("({0}*{1})"),
        from_format("({0}/(1+abs({1}))/(2+abs({2})))"), from_format("({0}/((1+abs({1}))*(2+abs({2}))))"), from_format("(-{0})"),
        from_format("(-tanh({0})^2)"), from_format("(2^tanh({0})^3)"), from_format("max({0},{1})"), from_format("min({0},{1})"),
        from_format("exp(tanh({0}))"), from_format("abs({0})"), from_format("ln(abs({0})+1)"), from_format("log10(abs({0})+1)"),
        from_format("tanh({0})"), from_format("atan2(tanh({0})+0.29,tanh({1})+0.37)"), from_format("hypot(tanh({0}),tanh({1}))"),
        from_format("int({0})"), from_format("nint({0})"), from_format("sgn({0})"), from_format("({0} < {1} ? {1} : {2})"),
        from_format("({0} >= {1} && !({2} == 0))"), from_format("({0} != {1} || {2} > 1)"), from_format("limit({0},{1},{2})"),
        from_format("u({0})*u2({1})"), from_format("uramp({0})"), from_format("pwr(tanh({0}),3)"), from_format("sqrt(abs({0}))"),
        from_format("sin({0})*cos({1})"));
}

TEST(ExpressionText, ReadsBackAsTheSameExpression) {
    EXPECT_TRUE(rc::check([] {
        const auto text = *formulas(*rc::gen::inRange(0, 5));
        ExpressionScope scope;
        scope.allows_inputs = true;
        const auto first = Expression::parse(text, {}, scope);
        if (!first) RC_FAIL(text + ": " + first.error().text());
        const auto written = first->text([](const ExpressionInput& in) -> std::string {
            if (in.kind == ExpressionInput::Kind::current) return "i(" + in.name + ")";
            if (in.kind == ExpressionInput::Kind::temperature) return "temper";
            return in.minus.empty() ? "v(" + in.name + ")" : "v(" + in.name + "," + in.minus + ")";
        });
        if (!written) {
            RC_ASSERT(written.error().message.find("not finite") != std::string::npos);
            return;
        }
        const auto again = Expression::parse(*written, {}, scope);
        if (!again) RC_FAIL(*written + ": " + again.error().text());
        for (const double x : {-1.5, -0.2, 0.0, 0.4, 1.0, 3.0}) {
            const auto values = [&](const Expression& f) {
                std::vector<double> out;
                for (const auto& in : f.inputs())
                    out.push_back(in.kind == ExpressionInput::Kind::voltage   ? (in.minus.empty() ? (in.name == "a" ? x : 0.7) : x - 0.7)
                                  : in.kind == ExpressionInput::Kind::current ? 0.3 * x
                                                                              : 27);
                return out;
            };
            const double a = first->value(values(*first)), b = again->value(values(*again));
            const bool same = a == b || (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= 1e-9 * std::abs(a) || !std::isfinite(a);
            if (!same) RC_FAIL(fmt::format("{} at {}: {}; as {}: {}", text, x, a, *written, b));
        }
    }));
}

TEST(ExportVerb, WritesACompleteDeckOrNothing) {
    using corpuscle::test::run_program;
    const TemporaryFolder folder;
    folder.write("x.cir", "divider\nv1 in 0 3\nr1 in out 1k\nr2 out 0 2k\n.op\n.expect v(out) 2 1%\n");
    folder.write("bad.cir", "t\nv1 a 0 1\nr1 a 0 1k\nr2 a\n.op\n");
    const auto printed = run_program(folder, "export x.cir --for ngspice"),
               written = run_program(folder, "export x.cir --for ngspice -o y.cir");
    EXPECT_EQ(printed.status, 0) << printed.err;
    EXPECT_TRUE(printed.out.starts_with("divider\n* ")) << printed.out;
    EXPECT_TRUE(printed.out.ends_with(".end\n")) << printed.out;
    EXPECT_NE(printed.err.find("x.cir:6:1: left out: .expect"), std::string::npos) << printed.err;
    EXPECT_EQ(written.status, 0) << written.err;
    EXPECT_EQ(written.out, "");
    EXPECT_EQ(read_file(folder / "y.cir"), printed.out);
    EXPECT_EQ(run_program(folder, "export bad.cir -o z.cir").status, 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "z.cir"));
    EXPECT_EQ(run_program(folder, "export x.cir --for hspice").status, 2);
    EXPECT_EQ(run_program(folder, "export x.cir -o x.cir").status, 2);
    EXPECT_EQ(run_program(folder, "export").status, 2);
}

}  // namespace
}  // namespace corpuscle::circuit::test
