// .meas lines of Xyce, LTspice and HSPICE: their results, and what happens to those that are not supported.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "circuit/netlist_runner.hpp"
#include "support/program.hpp"

namespace corpuscle::circuit::test {
using namespace corpuscle::test;
namespace {

// v(a) is 0 V, 2 V at 1 s, -2 V at 3 s, and 2 V at 5 s; v(b) is 1 V.
const std::string wave = "wave\nv1 a 0 pwl(0 0 1 2 3 -2 5 2)\nr1 a 0 1k\nv2 b 0 1\nr2 b 0 2k\n.param level=1\n.tran 10m 5\n";

NetlistRun run_measures(const std::string& lines) { return run_netlist(wave + lines); }

double measure(const std::string& words) { return run_measures(".meas tran x " + words + "\n").number("x"); }

std::string error_of(const std::string& lines) {
    const auto netlist = parse_netlist_text(wave + lines);
    if (!netlist) return netlist.error().text();
    const auto outcome = run_directives(std::make_shared<const Circuit>(*netlist->elaborate()));
    const auto text = outcome ? "nothing" : outcome.error().text();
    return text.substr(text.find("test.cir") == std::string::npos ? 0 : text.find("test.cir") + 9);
}

TEST(ForeignMeasure, IsReadInTheSpellingsOfOtherSimulators) {
    EXPECT_NEAR(measure("find v(a) at 0.5"), 1, 1e-6) << "LTspice";
    EXPECT_NEAR(measure("find v(a) at=0.5 from=0 to=2"), 1, 1e-6);
    EXPECT_TRUE(std::isnan(measure("find v(a) at=0.5 from=1 to=2"))) << "Xyce";
    EXPECT_NEAR(measure("derivative v(a) at=2"), -2, 1e-6);
    EXPECT_NEAR(measure("integral v(a) from=0 to=2"), 2, 1e-6);
    EXPECT_NEAR(measure("int v(a) from=0 to=2"), 2, 1e-6) << "HSPICE";
    EXPECT_NEAR(measure("avg from=0 to=2 v(a)"), 1, 1e-6);
    EXPECT_NEAR(measure("max v(a) td=1.5"), 2, 1e-6);
    EXPECT_NEAR(measure("max v(a) td=1.5 to=4.5"), 1, 1e-6);
    EXPECT_NEAR(measure("min v(a) output=time"), 3, 1e-6);
    EXPECT_NEAR(measure("trig v(a) 1 targ v(a)=1 fall=1"), 1, 1e-6);
    EXPECT_NEAR(measure("trig at=1 td=2 targ v(a)=1 rise 2 minval=1m"), 3.5, 1e-6);
    EXPECT_NEAR(measure("when v(a) = v(b) cross=-2"), 1.5, 1e-6);
    EXPECT_NEAR(measure("find {v(a)*2} when v(a)='0.5*v(b)' cross=-3"), 1, 1e-5);
    EXPECT_TRUE(std::isnan(measure("when v(a)=v(b) cross=-9")));
    EXPECT_NEAR(measure("when v(a)=level rise=2 goal=3 weight=2 precision=4 print=all default_val=-1"), 4.5, 1e-6);
    EXPECT_NEAR(measure("find v(a)-v(b) at=1"), 1, 1e-6);
    EXPECT_NEAR(measure("max abs(v(a))"), 2, 1e-6);
    EXPECT_NEAR(measure("max ('v(a)*v(b)')"), 2, 1e-6);
    EXPECT_NEAR(measure("find i(r1) at=1"), 2e-3, 1e-9);
    EXPECT_NEAR(measure("find {1k*i(r2) - v(b)} at=1"), -0.5, 1e-9);
    EXPECT_NEAR(measure("find v1#branch at=1"), -2e-3, 1e-9) << "ngspice";
    EXPECT_NEAR(measure("find a at=1"), 2, 1e-6);
}

TEST(ForeignMeasure, OfCyclesHasItsClosedForm) {
    // above 1 V from 0.5 to 1.5 s and from 4.5 s; below -1 V from 2.5 to 3.5 s
    EXPECT_NEAR(measure("on_time v(a) on=1 off=-1"), 1.5 / 2, 1e-6);
    EXPECT_NEAR(measure("off_time v(a) on=1 off=-1"), 1, 1e-6);
    EXPECT_NEAR(measure("duty v(a) on=1 off=-1"), (2.5 - 0.5 + 0.5) / 5, 1e-6) << "it is on until it falls below OFF";
    EXPECT_NEAR(measure("duty v(a) on=1"), 1.5 / 5, 1e-6);
    EXPECT_NEAR(measure("freq v(a) on=1 off=-1"), 1.5 / 5, 1e-6);
    EXPECT_NEAR(measure("duty v(a) on=1 off=-1 from=1 to=2"), 1, 1e-6);
    EXPECT_TRUE(std::isnan(measure("on_time v(a) on=9")));
}

// The expected values are those of the same sweep in Xyce's documentation of err1 and err2: sums over the points.
TEST(ForeignMeasure, OfDifferencesIsTakenOverPoints) {
    const auto run = run_netlist(
        "divider\nv1 1 0 1\nr1 1 2 1\nr2 2 0 3\n.dc v1 -5 5 1\n.meas dc e err v(1) v(2)\n.meas dc e1 err1 v(2) v(1)\n"
        ".meas dc small err1 v(1) v(2) minval=1.5\n.meas dc e2 err2 v(1) v(2) weight=2\n.meas dc least err1 v(1) {2.5} ymin=2.5\n");
    EXPECT_NEAR(run.number("e"), 0.25, 1e-9) << "the point at 0 V is below the default of ymin";
    EXPECT_NEAR(run.number("e1"), 1.0 / 3, 1e-9);
    EXPECT_NEAR(run.number("small"), std::sqrt((8 * 0.0625 + 2 / 36.0) / 10), 1e-9);
    EXPECT_NEAR(run.number("e2"), 0.25, 1e-9);
    double squares = 0;
    for (const double v : {-5, -4, -3, 3, 4, 5}) squares += std::pow((v - 2.5) / v, 2);
    EXPECT_NEAR(run.number("least"), std::sqrt(squares / 6), 1e-9);
}

TEST(ForeignMeasure, MayDependOnEarlierOnes) {
    const auto run = run_measures(
        ".meas tran most max v(a)\n.meas tran rise trig v(a) val='0.1*most' rise=1 targ v(a) val='0.9*most' rise=1\n"
        ".meas tran half find {v(a)/most} at=0.5\n.meas tran gain param rise/most\n.meas tran late when v(a)={most/2} cross=-1\n");
    EXPECT_NEAR(run.number("rise"), 0.8, 1e-6);
    EXPECT_NEAR(run.number("half"), 0.5, 1e-6);
    EXPECT_NEAR(run.number("gain"), 0.4, 1e-6);
    EXPECT_NEAR(run.number("late"), 4.5, 1e-6);
}

TEST(ForeignMeasure, OfAnEquationIsItsLastValue) {
    const auto run = run_measures(
        ".meas tran a eqn {v(a)+v(b)}\n.meas tran b param='v(a)*2' to=3\n.meas tran c equation {a + b}\n.meas tran d eqn {time + a}\n"
        ".meas tran e param = a * 2\n");
    EXPECT_NEAR(run.number("a"), 3, 1e-6);
    EXPECT_NEAR(run.number("b"), -4, 1e-6);
    EXPECT_NEAR(run.number("c"), -1, 1e-6);
    EXPECT_NEAR(run.number("d"), 8, 1e-6);
    EXPECT_NEAR(run.number("e"), 6, 1e-6);
}

TEST(ForeignMeasure, WithoutAnAnalysisIsOfTheFirstOne) {
    EXPECT_NEAR(run_measures(".meas x find v(a) at 0.5\n.meas y param x*2\n").number("y"), 2, 1e-6);
}

TEST(ForeignMeasure, OfAcTakesPartsInExpressions) {
    const auto run = run_netlist(
        "rc\nv1 a 0 ac 2\nr1 a b 1k\nc1 b 0 1u\n.ac dec 20 1 10k\n.meas ac gain find {vm(b)/vm(a)} at=159.15494\n"
        ".meas ac corner when vdb(b)={vdb(a) - 10*log10(2)}\n.meas ac last eqn {freq}\n.meas ac plain find sqrt(v(b)) at=10\n");
    EXPECT_NEAR(run.number("gain"), std::sqrt(0.5), 2e-3);
    EXPECT_NEAR(run.number("corner"), 159.155, 0.5);
    EXPECT_NEAR(run.number("last"), 1e4, 1e-6);
    EXPECT_TRUE(std::isnan(run.number("plain")));
    ASSERT_EQ(run.warnings().size(), 1U);
    EXPECT_NE(run.warnings()[0].text().find(".meas plain is left out: v(b) is not available in an expression, because it is complex; use "
                                            "its vm, vdb, vp, vr or vi"),
              std::string::npos);
}

TEST(ForeignMeasure, ThatIsNotSupportedIsLeftOutWithAWarning) {
    for (const auto& [line, why] :
         {std::pair{".meas tran_cont x when v(a)=1", "8:1: .meas x is left out: 'tran_cont' of another simulator is not supported"},
          std::pair{".meas tran x error v(a) file=a.prn comp_function=l2norm",
                    "8:14: .meas x is left out: the measurement 'error' of another simulator is not supported"},
          std::pair{".meas fft x thd v(a)", "8:1: .meas x is left out: 'fft' of another simulator is not supported"},
          std::pair{".meas tran x max v(a) rise=2", "8:23: .meas x is left out: rise=2 is not supported"},
          std::pair{".meas tran x trig v(a) frac_max=0.1 targ v(a) frac_max=0.9",
                    "8:24: .meas x is left out: frac_max=0.1 is not supported"},
          std::pair{".meas tran x max p(r1)", "8:18: .meas x is left out: p(r1) is not available in .tran"},
          std::pair{".meas tran x max {p(r1)*2}", "8:18: .meas x is left out: p(r1) is not available in .tran"},
          std::pair{".meas tran x avg @r1[i]", "8:18: .meas x is left out: @r1[i] is not available in .tran"},
          std::pair{".meas tran x avg r1:power", "8:18: .meas x is left out: r1:power is not available in .tran"}}) {
        const auto run = run_measures(std::string(line) + "\n.meas tran y max v(b)\n");
        ASSERT_TRUE(run.is_complete()) << line;
        EXPECT_TRUE(std::isnan(run.number("x"))) << line;
        EXPECT_NEAR(run.number("y"), 1, 1e-9) << line;
        ASSERT_EQ(run.warnings().size(), 1U) << line;
        EXPECT_NE(run.warnings()[0].text().find(why), std::string::npos) << run.warnings()[0].text();
    }
}

TEST(ForeignMeasure, ThatIsMisspeltIsRefused) {
    EXPECT_EQ(error_of(".meas tran x max v(aa)\n"), "8:18: .meas: there is no curve 'v(aa)' in 'Transient Analysis'");
    EXPECT_EQ(error_of(".meas tran x max i(r9)\n"), "8:18: .meas: there is no curve 'i(r9)' in 'Transient Analysis'");
    EXPECT_EQ(error_of(".meas tran x max {v(aa)*2}\n"), "8:18: .meas: there is no curve '{v(aa)*2}' in 'Transient Analysis'");
    EXPECT_EQ(error_of(".meas tra x max v(a)\n"), "8:7: .meas: 'tra' must be one of tran, ac, dc, noise, op; did you mean 'tran'?");
    EXPECT_EQ(error_of(".meas tran x max v(a) fro=1\n"), "8:23: .meas: unexpected 'fro=1'");
    EXPECT_EQ(error_of(".meas tran x when v(a)=1 rise=0\n"), "8:26: .meas: 'rise=0' must be 1, 2 ... or last");
    EXPECT_EQ(error_of(".meas tran x duty v(a) on=1 off=2\n"), "8:1: .meas: off=2 is above on=1");
    EXPECT_EQ(error_of(".meas tran x find v(a) at=later\n"), "8:24: .meas: 'at=later': expected a number after 'at='");
}

TEST(ForeignMeasure, OfAVectorOfAScriptIsThatOfItsExpression) {
    const auto run = run_measures(
        ".control\nrun\nlet twice = 2*v(a)\nmeas tran x max twice\nmeas tran y max v(b) > out.txt $ a comment\nmeas tran z min v(b) ; "
        "another\n.endc\n");
    EXPECT_NEAR(run.number("y"), 1, 1e-9);
    EXPECT_NEAR(run.number("z"), 1, 1e-9);
    EXPECT_NEAR(run.number("x"), 4, 1e-9);
    EXPECT_TRUE(run.warnings().empty());
}

TEST(ForeignMeasure, ThatIsLeftOutIsReportedAndTheOthersAreComputed) {
    const TemporaryFolder folder;
    folder.write("x.cir", wave + ".meas tran x max p(r1)\n.meas tran y max v(b)\n.meas ac z max v(b)\n.end\n");
    const auto ran = run_program(folder, "run x.cir");
    EXPECT_EQ(ran.status, 0);
    EXPECT_NE(ran.out.find("x                    = failed"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("y                    = 1.0000"), std::string::npos) << ran.out;
    EXPECT_NE(ran.err.find(".meas z is left out: the netlist has no .ac to measure"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("x.cir:8:18: .meas x is left out: p(r1) is not available in .tran"), std::string::npos) << ran.err;
}

TEST(ForeignMeasure, PartsOfComplexCurvesAndOfTheirQuotientsAreMeasured) {
    const auto run = run_netlist(
        "parts\nv1 in 0 ac 2\nr1 in out 1k\nc1 out 0 1u\n.ac dec 20 1 100k\n.meas ac top max mag(v(out))\n.meas ac low find "
        "db(v(out)/v(in)) at=1k\n"
        ".meas ac angle find ph(v(out)) at=1k\n.meas ac re find re(v(out)/v(in)) at=1k\n.meas ac im find im(v(out)/v(in)) at=1k\n"
        ".meas ac corner when mag(v(out))=top/sqrt(2)\n.meas ac f find freq when v(out)=top/sqrt(2)\n.meas ac sum find mag(2*v(out)-v(in)) "
        "at=1k\n"
        ".meas ac gain find v(out)/v(in) at=1k\n");
    const std::complex<double> h = 1.0 / std::complex<double>(1, 2 * std::acos(-1.0));
    const double tolerance = 2e-3;  // of straight lines between points
    EXPECT_NEAR(run.number("low"), 20 * std::log10(std::abs(h)), 20 * tolerance);
    EXPECT_NEAR(run.number("angle"), std::arg(h), tolerance);
    EXPECT_NEAR(run.number("re"), h.real(), tolerance);
    EXPECT_NEAR(run.number("im"), h.imag(), tolerance);
    EXPECT_NEAR(run.number("sum"), std::abs(4.0 * h - 2.0), 2 * tolerance);
    EXPECT_NEAR(run.number("gain"), std::abs(h), tolerance) << "a magnitude, like that of v(out)";
    EXPECT_NEAR(run.number("corner") / 159.155, 1, tolerance);
    EXPECT_EQ(run.number("f"), run.number("corner"));
    const auto error_of = [](const std::string& line) {
        const auto outcome = run_directives(make_circuit("parts\nv1 in 0 ac 2\nr1 in 0 1k\n.ac dec 20 1 100k\n.meas ac x " + line + "\n"));
        return outcome ? std::string() : outcome.error().message;
    };
    EXPECT_EQ(error_of("max cph(v(in)/v(in))"), ".meas: cph() is not available: the phase between two points is not continued; use ph()");
    EXPECT_EQ(error_of("max mag(sqrt(v(in)))"), ".meas: mag(): only + - * / of curves and numbers are available in it");
}

}  // namespace
}  // namespace corpuscle::circuit::test
