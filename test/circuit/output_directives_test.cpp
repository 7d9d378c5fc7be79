// Directives of a netlist: initial conditions, options, printed and saved curves. A wrong name always gives an error or a warning.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "circuit/run_directives.hpp"
#include "support/ngspice.hpp"
#include "support/processor_time.hpp"
#include "support/program.hpp"

namespace corpuscle::circuit::test {
using namespace corpuscle::test;
namespace {

Result<RunOutcome> outcome_of(const std::string& text) {
    const auto netlist = Netlist::parse("t\n" + text + ".end\n", "t.cir", {});
    if (!netlist) return netlist.error();
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error();
    return run_directives(std::make_shared<const Circuit>(std::move(*circuit)));
}

double number(const std::string& text, std::string_view name) {
    const auto outcome = outcome_of(text);
    EXPECT_TRUE(outcome) << outcome.error().text();
    return outcome ? outcome->find_number(name).value_or(NAN) : NAN;
}

std::string error_of(const std::string& text) {
    const auto outcome = outcome_of(text);
    EXPECT_FALSE(outcome) << text;
    return outcome ? "" : outcome.error().text();
}

std::string warnings_in(const std::string& text) {
    const auto outcome = outcome_of(text);
    EXPECT_TRUE(outcome) << outcome.error().text();
    std::string out;
    if (outcome)
        for (const auto& r : outcome->warnings) out += r.text() + "\n";
    return out;
}

TEST(InitialConditions, OfCapacitorsAndInductorsStartATransientWithUic) {
    EXPECT_NEAR(number("c1 a 0 1n ic=2\nr1 a 0 1k\n.tran 10n 3u uic\n.meas tran v find v(a) at=1u\n", "v"), 2 * std::exp(-1.0), 1e-3);
    EXPECT_NEAR(number("c1 a 0 1n ic=2\nr1 a 0 1k\n.tran 10n 3u uic\n.meas tran v find v(a) at=0\n", "v"), 2, 1e-6);
    EXPECT_NEAR(number("l1 b 0 1m ic=1m\nr1 b 0 1k\n.tran 10n 3u uic\n.meas tran i find i(l1) at=1u\n", "i"), 1e-3 * std::exp(-1.0), 1e-6);
    EXPECT_NEAR(number("c1 a 0 1n ic=2\n.ic v(a)=5\nr1 a 0 1k\n.tran 10n 3u uic\n.meas tran v find v(a) at=0\n", "v"), 2, 1e-6)
        << "the value of a device takes precedence over that of its node";
}

// The charge between two capacitors in series is conserved: m = (c2 (1 - 0.3) + c3 0) / (c2 + c3).
TEST(InitialConditions, OfACapacitorBetweenTwoNodesConserveCharge) {
    EXPECT_NEAR(number("v1 in 0 1\nc2 in m 1n ic=0.3\nc3 m 0 1n\nr3 m 0 1g\n.tran 1u 5u uic\n.meas tran m find v(m) at=0\n", "m"), 0.35,
                1e-6);
    EXPECT_NEAR(number("c1 a 0 q='1n*v(a)' ic=0.7\nr1 a 0 1k\n.tran 10n 3u uic\n.meas tran v find v(a) at=0\n", "v"), 0.7, 1e-6);
}

TEST(InitialConditions, ThatHaveNoEffectCauseAWarning) {
    EXPECT_NE(warnings_in("v1 b 0 1\nr2 b a 1k\nc1 a 0 1n ic=2\nr1 a 0 1k\n.tran 10n 3u\n")
                  .find("t.cir:4:1: c1: ic= has an effect only with 'uic'"),
              std::string::npos);
    EXPECT_EQ(warnings_in("c1 a 0 1n ic=2\nr1 a 0 1k\n.tran 10n 3u uic\n"), "");
    EXPECT_NE(warnings_in("i1 0 a 1m\nd1 a 0 dx off\n.model dx d\n.tran 10n 3u\n").find("d1: off has no effect"), std::string::npos);
}

TEST(InitialConditions, AgreeWithNgspice) {
    const std::string deck =
        "t\nc1 a 0 1n ic=2\nr1 a 0 1k\nl1 b 0 1m ic=1m\nr2 b 0 1k\nv1 in 0 1\nc2 in m 1n ic=0.3\nc3 m 0 1n\nr3 m 0 1meg\n"
        "c5 p q 2n ic=1\nc6 p 0 1n\nrp p 0 1k\nrq q 0 1k\n.tran 10n 5u uic\n";
    const std::string measures =
        ".meas tran va find v(a) at=1u\n.meas tran vb find v(b) at=1u\n.meas tran vm find v(m) at=1u\n.meas tran vp find v(p) at=1u\n"
        ".meas tran vq find v(q) at=1u\n.end\n";
    const TemporaryFolder folder;
    folder.write("x.cir", deck + measures);
    const auto ours = nlohmann::json::parse(run_program(folder, "run x.cir --json").out)["numbers"];
    ASSERT_EQ(run_program(folder, "export x.cir --for ngspice -o deck.cir").status, 0);
    const auto text = run_ngspice(folder / "deck.cir", "");
    for (const auto* name : {"va", "vb", "vm", "vp", "vq"}) {
        const auto at = text.find(std::string("\n") + name + " ");
        ASSERT_NE(at, std::string::npos) << text;
        const double theirs = std::strtod(text.c_str() + text.find('=', at) + 1, nullptr);
        EXPECT_NEAR(ours[name].get<double>(), theirs, 2e-3 * std::abs(theirs) + 1e-4) << name;
    }
}

TEST(Amperes, AreAUnitAndNotAScale) {
    EXPECT_DOUBLE_EQ(number("i1 0 a 1A\nr1 a 0 1\n.op\n", "v(a)"), 1);
    EXPECT_DOUBLE_EQ(number("i1 0 a 5a\nr1 a 0 1\n.op\n", "v(a)"), 5);
    EXPECT_DOUBLE_EQ(number("i1 0 a {2*2amp}\nr1 a 0 1\n.op\n", "v(a)"), 4);
    EXPECT_NE(error_of("c1 a 0 5aF\nr1 a 0 1\n.op\n").find("t.cir:2:8: '5af': some simulators read 'a' as 1e-18"), std::string::npos);
    EXPECT_NE(error_of("c1 a 0 {2*5aF}\nr1 a 0 1\n.op\n").find("write 5e-18"), std::string::npos);
    EXPECT_NE(warnings_in("i1 0 a 1\nc1 a 0 5a\nr1 a 0 1\n.op\n")
                  .find("c1: 5a is 5, since 'a' is not a scale factor; for 5 times 1e-18 write 5e-18"),
              std::string::npos);
}

TEST(Options, ThatAreUnknownAreRejected) {
    const std::string r = "v1 a 0 1\nr1 a 0 1\n.op\n";
    EXPECT_EQ(error_of(r + ".options retol=1e-6\n"), "t.cir:5:10: unknown option 'retol'; did you mean 'reltol'?");
    EXPECT_EQ(error_of(r + ".options reltol\n"), "t.cir:5:10: .options reltol: expected a number, such as reltol=1e-6");
    EXPECT_EQ(error_of(r + ".options reltol=tight\n"), "t.cir:5:10: .options reltol: expected a number, such as reltol=1e-6");
    EXPECT_EQ(error_of(r + ".options reltol=-1\n"), "t.cir:5:10: .options reltol=-1 is outside [1e-15, 0.5]");
    EXPECT_EQ(error_of(r + ".options method=2\n"), "t.cir:5:10: .options method: expected a word, such as method=gear");
    EXPECT_NE(error_of(r + ".options scalm=1u\n").find("not supported, because it changes the circuit"), std::string::npos);
    EXPECT_TRUE(outcome_of(r + ".options noacct savecurrents trtol=7 post=2 itl4=100 numdgt=8 plotwinsize=0\n"));
}

TEST(Options, SetTheTemperatureOfNominalValues) {
    const std::string r = "i1 0 a 1\nr1 a 0 100 tc1=0.01\n.temp 37\n.op\n";
    EXPECT_DOUBLE_EQ(number(r, "v(a)"), 110);
    EXPECT_DOUBLE_EQ(number(r + ".options tnom=37\n", "v(a)"), 100);
    const std::string d = "i1 0 a 1m\nd1 a 0 dx\n.model dx d\n.temp 60\n.op\n";
    EXPECT_GT(number(d + ".options tnom=60\n", "v(a)"), number(d, "v(a)") + 0.01);
}

TEST(Elements, HaveTheirValueMultipliedByScale) {
    EXPECT_DOUBLE_EQ(number("i1 0 a 1\nr1 a 0 100 scale=3\n.op\n", "v(a)"), 300);
    EXPECT_NEAR(number("c1 a 0 1n scale=2 ic=1\nr1 a 0 1k\n.tran 10n 3u uic\n.meas tran v find v(a) at=2u\n", "v"), std::exp(-1.0), 1e-3);
    EXPECT_EQ(error_of("i1 0 a 1\nr1 a 0 100 scale=0\n.op\n"), "t.cir:3:1: r1: scale must not be 0");
}

TEST(Elements, HaveNoParameterThatIsSilentlyIgnored) {
    EXPECT_EQ(error_of("i1 0 a 1m\nd1 a 0 dx\n.model dx d(level=200)\n.op\n"),
              "t.cir:4:1: dx: diode level 200 is not supported; use level=1");
    EXPECT_TRUE(outcome_of("i1 0 a 1m\nd1 a 0 dx\n.model dx d(level=1)\n.op\n"));
    EXPECT_EQ(error_of("i1 0 a 1m\nr1 a 0 1k rx\n.model rx r(rsx=200)\n.op\n").substr(0, 36), "t.cir:4:1: rx: unknown parameter 'rs");
    EXPECT_EQ(error_of("i1 0 a 1m\nr1 a 0 1k rx\n.model rx r(kf=1)\n.op\n"),
              "t.cir:4:1: rx: kf (flicker noise of a resistor) is not supported");
    EXPECT_NE(error_of("i1 0 a sin(0 1 1k) td=1m\nr1 a 0 1k\n.op\n").find("td= is allowed only with pwl"), std::string::npos);
    EXPECT_NE(error_of("i1 0 b 1m\nr1 b 0 1\nb1 a 0 v={v(b)} tc1=1m\nr2 a 0 1\n.op\n").find("unknown parameter 'tc1'"), std::string::npos);
    EXPECT_EQ(error_of("i1 0 a 1m\nr1 a 0 1k wx=1u\n.op\n").substr(0, 38), "t.cir:3:11: r1: unknown parameter 'wx'");
}

TEST(Curves, ThatDoNotExistAreLeftOutOfTablesWithAWarning) {
    const std::string c = "v1 a 0 sin(0 1 1k)\nr1 a b 1k\nc1 b 0 1u\n.tran 1u 1m\n";
    const auto outcome = outcome_of(c + ".print tran v(b) v(zz)\n");
    ASSERT_TRUE(outcome);
    ASSERT_EQ(outcome->warnings.size(), 1U);
    EXPECT_EQ(outcome->warnings[0].text(),
              "t.cir:6:18: .print: there is no curve 'v(zz)', so the column is left out; did you mean 'v(a)'?");
    EXPECT_NE(warnings_in(c + ".plot tran v(zz)\n").find("t.cir:6:12: .plot: there is no curve 'v(zz)'"), std::string::npos);
    EXPECT_EQ(error_of(c + ".probe v(zz)\n"), "t.cir:6:8: .probe: unknown output v(zz); did you mean 'v(a)'?");
    EXPECT_NE(warnings_in(c + ".print tran i(c1)\n").find("there is no curve 'i(c1)', so the column is left out; "), std::string::npos);
    EXPECT_NE(warnings_in(c + ".print ac vdb(b)\n.print v(b) vdb(q)\n").find("there is no curve 'vdb(q)'"), std::string::npos);
    EXPECT_TRUE(outcome_of(c + ".save i(r1)\n.print tran i(r1) v(a,b) v(a) par('v(a)*2')\n.op\n.print op v(b)\n"));
    EXPECT_NE(warnings_in(c + ".plot tran v(b)\n").find("t.cir:6:1: .plot has no effect here"), std::string::npos);
    EXPECT_NE(warnings_in(c + ".print ac v(b)\n").find(".print: the netlist has no .ac, so nothing is printed"), std::string::npos);
}

TEST(Curves, AreSelectedByAllAndByProbeDirectivesInNgspicesSyntax) {
    const std::string c = "v1 a 0 1\nr1 a b 1k\nc1 b 0 1u\n.op\n";
    const auto outcome = outcome_of(c + ".print op all\n");
    ASSERT_TRUE(outcome) << outcome.error().text();
    for (const auto* name : {"v(a)", "v(b)", "i(v1)"}) EXPECT_NE(outcome->analyses[0].printed_tables.find(name), std::string::npos);
    EXPECT_EQ(outcome_of(c + ".probe v(b) i(r1)\n")->saved_curves, (std::vector<std::string>{"v(b)", "i(r1)"}));
    EXPECT_TRUE(outcome_of(c + ".probe alli\n")->saved_curves.empty());
    EXPECT_NE(warnings_in(c + ".probe vd(r1) i(c1) v(b)\n").find(".probe: 'vd(r1)' is not supported"), std::string::npos);
    EXPECT_NE(error_of(c + ".probe i(c9)\n").find(".probe: unknown output i(c9)"), std::string::npos);
}

TEST(Curves, AreSelectedInXycesSyntax) {
    const std::string c = "v1 a 0 1\nr1 a b 1k\nr2 b 0 1k\n.dc v1 0 1 1\n";
    const auto outcome = outcome_of(c + ".print dc format=csv file=x.csv v(*) {v(a)-v(b)} i(*)\n");
    ASSERT_TRUE(outcome) << outcome.error().text();
    ASSERT_EQ(outcome->warnings.size(), 2U);
    EXPECT_EQ(outcome->warnings[0].text(), "t.cir:6:11: .print: 'format=csv' has no effect here");
    const auto& table = outcome->analyses[0].printed_tables;
    EXPECT_EQ(table.substr(0, table.find('\n')),
              fmt::format("{:>16}{:>16}{:>16}{:>16}{:>16}", "v-sweep", "v(a)", "v(b)", "{v(a)-v(b)}", "i(v1)"));
    EXPECT_NE(table.find("1.0000000e+00   1.0000000e+00   5.0000000e-01   5.0000000e-01  -5.0000000e-04"), std::string::npos) << table;
}

TEST(Curves, OfEveryAnalysisArePrinted) {
    const std::string c = "v1 a 0 dc 1 ac 1\nr1 a b 1k\nr2 b 0 1k\n";
    for (const auto* line : {".noise v(b) v1 dec 1 1 10\n.print noise onoise_spectrum", ".ac dec 1 1 10\n.print ac vdb(b) vp(b)",
                             ".dc v1 0 1 1\n.print dc v(b) v-sweep", ".dc temp 0 50 50\n.print dc temp-sweep v(b)",
                             ".dc r2 1 2 1\n.print dc res-sweep", ".tf v(b) v1\n.print tf transfer_function", ".op\n.print op v(b)"}) {
        const auto outcome = outcome_of(c + line + "\n");
        ASSERT_TRUE(outcome) << line << ": " << outcome.error().text();
        EXPECT_FALSE(outcome->analyses[0].printed_tables.empty()) << line;
    }
}

// If the transient ran first, it would take much longer than the test's time limit.
TEST(Measures, ThatAreWrongAreRejectedBeforeTheAnalysesRun) {
    const std::string c = "v1 a 0 sin(0 1 1meg)\nr1 a b 1k\nc1 b 0 1n\n.tran 1n 1000\n";
    for (const auto* line : {".meas tran x max v(zz)", ".meas tran x maxx v(b)", ".meas tran", ".meas tran x param='y*2'",
                             ".meas tran x find v(b) at=1as", ".expect v(zz) 1 1%"})
        EXPECT_TRUE(error_of(c + line + "\n").starts_with("t.cir:6:")) << error_of(c + line + "\n");
    EXPECT_TRUE(
        outcome_of("v1 a 0 1\nr1 a 0 1k\n.op\n.meas op x find v(a)\n.meas op y param='x*2'\n.noise v(a) v1 dec 1 1 10\n.meas noise z "
                   "param='onoise_total*y'\n"));
}

TEST(Warnings, ReportLikelyMistakesInSolvableNetlists) {
    const std::string card = ".model nch nmos(level=80)\n";
    EXPECT_NE(warnings_in("v1 a 0 1\nm1 a a 0 0 nch w=1 l=0.5\n" + card + ".op\n")
                  .find("m1: w = 1 m (sizes are in metres; 1 um is written w=1u)"),
              std::string::npos);
    EXPECT_NE(warnings_in("v1 a 0 1\nm1 a a 0 0 nch l=1u\nm2 a a 0 0 nch l=1u\n" + card + ".op\n")
                  .find("m1: w= is not given; the default is 1 um (and 1 other element)"),
              std::string::npos);
    EXPECT_NE(warnings_in("v1 a 0 1\nr1 a b 1k\nc1 b 0 1u\n.ac dec 1 1 10\n").find(".ac: no source has an AC value"), std::string::npos);
    EXPECT_NE(warnings_in("v1 a 0 pulse(0 1 0 1u 1u 5u 4u)\nr1 a 0 1k\n.tran 1u 3u\n")
                  .find("v1: the pulse (rise, width and fall take 7 us) is longer than its period of 4 us"),
              std::string::npos);
    EXPECT_NE(warnings_in("v1 a 0 1\nr1 a 0 1k\n.tran 1m 1u\n").find(".tran: STEP 1m is longer than STOP 1u"), std::string::npos);
}

TEST(Mistakes, ThatAreCommonAreAnsweredWithTheirRemedy) {
    const auto library = source_root() + "/process/tsmc180.lib";
    const auto netlist = Netlist::parse("t\n.lib '" + library + "' typ\n", "t.cir", [&](const std::string& path) -> Result<std::string> {
        std::ifstream file(path);
        return std::string(std::istreambuf_iterator<char>(file), {});
    });
    ASSERT_FALSE(netlist);
    EXPECT_NE(netlist.error().text().find("t.cir:2:6: library '" + library + "' has no section 'typ'; it has tt, ss, ff"),
              std::string::npos)
        << netlist.error().text();
    EXPECT_EQ(error_of("v1 a 0 ac 1\n.ac dec 10 1k 1\n"),
              "t.cir:3:12: .ac: from 1000 to 1 Hz: the lower frequency comes first; write .ac dec 10 1 1k");
    EXPECT_NE(error_of("m1 a a 0 0 nhc\n.model nch nmos\n.op\n").find("2:12: m1: unknown model 'nhc'; did you mean 'nch'?"),
              std::string::npos);
    EXPECT_NE(warnings_in("v1 a 0 sin(0 0,5 1k)\nr1 a 0 1\n.tran 1u 1m\n")
                  .find("2:16: v1: '0,5' is two numbers; the decimal point is a dot: 0.5"),
              std::string::npos);
    EXPECT_EQ(warnings_in("v1 a 0 sin(0,5,1k)\nr1 a 0 1\n.tran 1u 1m\n"), "");
    EXPECT_EQ(warnings_in("v1 a 0 pwl(0,0 1m,5)\nr1 a 0 1\n.tran 1u 1m\n"), "");
}

TEST(Save, OfManyCurvesTakesTimeInProportion) {
    std::string text = "v1 n0 0 1\n", words;
    for (int k = 0; k < 20'000; ++k) text += fmt::format("r{0} n{0} n{1} 1\n", k, k + 1), words += fmt::format(" v(n{},n{})", k + 1, k);
    EXPECT_LT(test::processor_time([&] { EXPECT_TRUE(outcome_of(text + "rl n20000 0 1\n.save" + words + "\n.op\n")); }), 10)
        << "normally about 0.2 s";
}

TEST(RawFile, HasTheHeadOfNgspiceAndIsLoadedByIt) {
    const TemporaryFolder folder;
    folder.write("t.cir", "a divider\nv1 a 0 3\nr1 a b 1k\nr2 b 0 2k\n.op\n.dc v1 0 3 1\n");
    const auto head = [](const std::string& date) {
        return "Title: a divider\nDate: " + date +
               "\nPlotname: Operating Point\nFlags: real\nNo. Variables: 3\nNo. Points: " + std::string("1") + std::string(19, ' ') +
               "\nCommand: set rawwriter=\"Corpuscle, format of ngspice\"\nVariables:\n\t0\tv(a)\tvoltage\n";
    };
    ASSERT_EQ(run_program(folder, "run t.cir -o t.raw").status, 0);
    EXPECT_TRUE(read_file(folder / "t.raw").starts_with(head("Thu Jan  1 00:00:00 1970"))) << read_file(folder / "t.raw").substr(0, 300);
    EXPECT_EQ(run_program(folder, "run t.cir -o t.raw").status, 0) << "a file of an earlier run is replaced";
    ::setenv("SOURCE_DATE_EPOCH", "951782400", 1);
    const auto dated = run_program(folder, "run t.cir -o dated.raw");
    ::unsetenv("SOURCE_DATE_EPOCH");
    ASSERT_EQ(dated.status, 0);
    EXPECT_TRUE(read_file(folder / "dated.raw").starts_with(head("Tue Feb 29 00:00:00 2000")));
    folder.write("load.cir", "t\n.control\nload t.raw\nsetplot dc1\nprint v(b)[3]\necho writer $rawwriter\nquit\n.endc\n.end\n");
    const auto log = run_ngspice("load.cir", "", folder.path());
    EXPECT_NE(log.find("v(b)[3] = 2.000000e+00"), log.npos) << log;
    EXPECT_NE(log.find("writer Corpuscle"), log.npos) << log;
    EXPECT_EQ(log.find("no such command"), log.npos) << log;
}

// dv/dt = 1e39 (v^2 + 1): no step is short enough.
TEST(Run, ThatFailsAtItsFirstPointLeavesAnEarlierFileUnchanged) {
    const TemporaryFolder folder;
    folder.write("good.cir", "t\nv1 a 0 1\nr1 a b 1k\nc1 b 0 1n\n.tran 1n 1u\n");
    folder.write("bad.cir", "t\nb1 a 0 i=-1e30*(v(a)*v(a)+1)\nc1 a 0 1n\nr1 a 0 1k\n.tran 1u 2m uic\n");
    for (const std::string name : {"x.raw", "x.csv"}) {
        ASSERT_EQ(run_program(folder, "run good.cir -o " + name).status, 0);
        const auto before = read_file(folder / name);
        const auto ran = run_program(folder, "run bad.cir -o " + name);
        EXPECT_EQ(ran.status, 3) << ran.err;
        EXPECT_EQ(read_file(folder / name), before) << name;
        EXPECT_FALSE(std::filesystem::exists(folder / (name + ".part")));
    }
}

}  // namespace
}  // namespace corpuscle::circuit::test
