// Forms that other simulators' netlists have: they are read as meant, or named in a warning, and the circuit runs.

#include <fmt/format.h>
#include <numbers>

#include "netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

std::string warnings_in(const NetlistRun& run) {
    std::string out;
    for (const auto& w : run.warnings()) out += w.text() + "\n";
    return out;
}

TEST(ForeignNetlist, PolynomialsOfControlledSourcesHaveSpicesOrderOfTerms) {
    const std::string inputs = "poly\nva a 0 2\nvb b 0 3\nvc c 0 5\nr1 x 0 1\n";
    // 1 + 2 a + 3 b + 4 c + 5 aa + 6 ab + 7 ac + 8 bb + 9 bc + 10 cc + 11 aaa + 12 aab
    const double expected = 1 + 2 * 2 + 3 * 3 + 4 * 5 + 5 * 4 + 6 * 6 + 7 * 10 + 8 * 9 + 9 * 15 + 10 * 25 + 11 * 8 + 12 * 12;
    EXPECT_NEAR(run_netlist(inputs + "e1 x 0 poly(3) a 0 b 0 c 0 1 2 3 4 5 6 7 8 9 10 11 12\n.op\n").number("v(x)"), expected, 1e-9);
    EXPECT_NEAR(run_netlist(inputs + "g1 0 x POLY(2) (a,0) (b,a) 0 {1+1} 3 0 0 1\n.op\n").number("v(x)"), 2 * 2 + 3 * 1 + 1 * 1, 1e-9);
    EXPECT_NEAR(run_netlist(inputs + "e1 x 0 poly(1) b 0 7\n.op\n").number("v(x)"), 21, 1e-9) << "one coefficient is the gain";
    // i(va) and i(vb) are minus the currents of the loads
    const std::string loads = inputs + "ra a 0 2\nrb b 0 1\n";
    EXPECT_NEAR(run_netlist(loads + "h1 x 0 poly(2) va vb 1 10 100 0 1000\n.op\n").number("v(x)"), 1 - 10 - 300 + 3000, 1e-6);
    EXPECT_NEAR(run_netlist(loads + "f1 0 x poly(1) va 0 0 4\n.op\n").number("v(x)"), 4, 1e-9);
}

/// The line and the message of each warning.
std::string placed_warnings_in(const NetlistRun& run) {
    std::string out;
    for (const auto& w : run.warnings()) out += fmt::format("{}: {}\n", w.location.line, w.message);
    return out;
}

TEST(ForeignNetlist, FormsOfCdlAreRead) {
    const auto run = run_netlist(
        "cdl\n.PARAM\n.SUBCKT HALF IN OUT VSS\n*.PININFO IN:I\nRR0 IN OUT 1k $SUB=VSS $[rpoly] m=2\nRR1 OUT VSS 1k $X=100 $Y=2.5 $D=3\n"
        ".ENDS\nV1 a 0 3\nXI1 a b 0 / HALF\nXI2 a c 0 /HALF\nRR2 b 0 1meg $T=-79 30 0 0 $X=1 m=1\n.op\n");
    EXPECT_NEAR(run.number("v(c)"), 2, 1e-9) << "two resistors of 1k are parallel, as m=2 after the notes says";
    EXPECT_EQ(placed_warnings_in(run),
              "2: .param has no name=value, so it has no effect\n"
              "5: '$SUB=VSS': notes of CDL that begin with $ have no effect, nor have those of other lines\n");
}

TEST(ForeignNetlist, LinesOfSpectreAreNamed) {
    const auto error_of = [](const std::string& text) {
        const auto read = Netlist::parse(text, "t.scs", {});
        return read ? std::string("read") : read.error().text();
    };
    const std::string remedy =
        "is in the language of Spectre, which is not read; write the netlist in that of SPICE: in Virtuoso, with the simulator hspiceD, or "
        "as "
        "CDL";
    EXPECT_EQ(error_of("// generated\nsimulator lang=spectre\nparameters vdd=1\n"), "t.scs:2:1: 'simulator lang=spectre' " + remedy);
    EXPECT_EQ(error_of("simulator lang=spectre\nglobal 0\n"), "t.scs:1:1: 'simulator lang=spectre' " + remedy);
    EXPECT_EQ(error_of("title\nglobal 0 vdd!\nparameters VDD=1.8\ntran tran stop=1m\n"), "t.scs:3:1: 'parameters vdd=1.8' " + remedy);
    const auto run = run_netlist("title\nsimulator lang=spice\nv1 a 0 3\nr1 a 0 1\n.op\n");
    EXPECT_EQ(run.number("v(a)"), 3);
    EXPECT_EQ(placed_warnings_in(run), "2: simulator has no effect here\n");
}

TEST(ForeignNetlist, ARecordingIsNamed) {
    for (const std::string text : {"time_s,fz_mN\n0.000,6.0\n0.002,6.0\n", "t\tF\n0\t1\n", "0.1;2\n0.2;3\n", "0 1\n1 2\n"}) {
        const auto read = Netlist::parse(text, "touch.csv", {});
        ASSERT_FALSE(read);
        EXPECT_NE(read.error().text().find("is a line of a recording and not of a netlist"), std::string::npos) << read.error().text();
        EXPECT_EQ(read.error().further, nullptr);
    }
}

TEST(ForeignNetlist, TitlesMayBeNumbersOrParameters) {
    for (const std::string title : {"7400 7402", "2024 05 12", "Parameters vdd=1.8"})
        EXPECT_EQ(run_netlist(title + "\nv1 a 0 2\nr1 a 0 1\n.op\n").number("v(a)"), 2) << title;
}

TEST(ForeignNetlist, ANoteOfADrawingDoesNotHideTheValueAfterIt) {
    EXPECT_EQ(run_netlist("t\ni1 0 a 1\nr1 a 0 $SUB=vss 1000\n.op\n").number("v(a)"), 1000);
}

TEST(ForeignNetlist, ChipsThatCannotDifferAreNamed) {
    const std::string text = "t\nv1 a 0 1\nr1 a 0 1\nm1 a a 0 0 n w=1u l=1u\n.op\n.mc 3\n";
    const std::string model = ".model n nmos (level=1)\n";
    const std::string warning =
        ".mc: all chips are equal, because nothing in the netlist varies: it has no UICM transistor (level=80), no tolerance and no random "
        "value\n";
    EXPECT_EQ(placed_warnings_in(run_netlist(text + model)), "6: " + warning);
    EXPECT_EQ(warnings_in(run_netlist(text + model + ".param x={agauss(1,0.1,1)}\nr2 a 0 {x}\n")), "");
}

TEST(ForeignNetlist, AResistanceMayDependOnVoltages) {
    const auto run = run_netlist("divider\nv1 in 0 6\nr1 in x 1k\nr2 x 0 R={1k*v(c)}\nvc c 0 2\n.op\n");
    EXPECT_NEAR(run.number("v(x)"), 4, 1e-9);
    // Only the names v, i and time mean the solution: these resistors keep their noise.
    const auto noisy = run_netlist(
        "names\n.param runtime=2k\n.func conv(x) {x*0.5}\nv1 in 0 0\nr1 in x {runtime}\nr2 x 0 {conv(4k)}\n"
        ".noise v(x) v1 lin 2 1 2\n");
    EXPECT_NEAR(std::pow(noisy.number("onoise_total"), 2) / (4 * 1.380649e-23 * 300.15 * 1e3), 1, 1e-6);
}

// Newton's method begins at 0 V, where these expressions or their slopes are infinite.
TEST(OperatingPoint, OfExpressionsWithPolesAndPowersAtZeroIsFound) {
    const std::string source = "poles\nv1 a 0 100\nr1 x 0 1\nr2 a 0 1k\n";
    EXPECT_NEAR(run_netlist(source + "b1 x 0 v=log(v(a))\n.op\n").number("v(x)"), std::log(100), 1e-6);
    EXPECT_NEAR(run_netlist(source + "b1 x 0 v=1/v(a)\n.op\n").number("v(x)"), 0.01, 1e-9);
    EXPECT_NEAR(run_netlist(source + "b1 x 0 v=sqrt(v(a))+ln(v(a)/v(a,0))\n.op\n").number("v(x)"), 10, 1e-6);
    // a sensor by a formula, g = 1 uS F^0.9, from 0 N on
    const auto sensor = run_netlist("sensor\nvf f 0 0\nvdd d 0 1\nb1 d x i=1u*v(f)^0.9*v(d,x)\nr1 x 0 1meg\n.op\n.dc vf 0 4 1\n");
    const auto x = sensor.curve("v(x)", "dc");
    ASSERT_EQ(x.size(), 5U);
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(x[static_cast<std::size_t>(k)], std::pow(k, 0.9) / (1 + std::pow(k, 0.9)), 1e-6) << k << " N";
    const auto press =
        run_netlist("sensor\nvf f 0 pwl(0 0 1m 0 2m 4)\nvdd d 0 1\nb1 d x i=1u*v(f)^0.9*v(d,x)\nr1 x 0 1meg\nc1 x 0 1p\n.tran 10u 4m\n");
    EXPECT_NEAR(press.curve("v(x)").back(), std::pow(4, 0.9) / (1 + std::pow(4, 0.9)), 1e-5);
}

TEST(ForeignNetlist, GroundMayBeAPortOfASubcircuit) {
    const std::string divider = "ports\n.subckt half in out 0\nr1 in out 1k\nr2 out 0 1k\n.ends\nv1 a 0 2\n";
    const auto run = run_netlist(divider + "x1 a b 0 half\n.op\n");
    EXPECT_NEAR(run.number("v(b)"), 1, 1e-9);
    EXPECT_EQ(warnings_in(run), "");
    const auto other = run_netlist(divider + "x1 a b c half\nr3 c 0 1k\n.op\n");
    EXPECT_NEAR(other.number("v(b)"), 1, 1e-9);
    EXPECT_NE(warnings_in(other).find("port 0 of subcircuit 'half' is ground, so it is not connected to c"), std::string::npos);
}

TEST(ForeignNetlist, DirectivesAndOptionsWithoutEffectAreRead) {
    const auto run = run_netlist(
        "Xyce\n.width out=80\n.list\n.backanno\n.csparam n=3\n.global_param vin=2\n.options timeint reltol=1e-3 method=gear\n"
        ".options device temp=60\n.options fooo=3 acct\nv1 a 0 {vin} distof1 1 0\nr1 a 0 1k tc1=1m\n.op\n");
    EXPECT_NEAR(run.number("i(v1)"), -2e-3 / 1.033, 1e-9) << "the temperature of .options device holds";
    const auto warnings = warnings_in(run);
    for (const char* text :
         {"'reltol' belongs to Xyce's solver and is ignored", "'method' belongs to Xyce's", "'fooo' is not known and is ignored"})
        EXPECT_NE(warnings.find(text), std::string::npos) << warnings;
}

TEST(ForeignNetlist, AnalysesOfAControlScriptAreRun) {
    const std::string deck = "script\nv1 a 0 dc 1 ac 1 sin(0 1 1k)\nr1 a b 1k\nc1 b 0 1u\n.tran 10u 1m\n";
    const auto run = run_netlist(deck +
                                 ".control\n* a comment\nset noaskquit\nrun\nac dec 2 10 1k\nTRAN 10u 1m\n"
                                 "meas tran top MAX v(b)\nprint v(b)\nplot v(b)\nplot v(a)\nwrite x.raw\n.endc\n.end\n");
    ASSERT_EQ(run.analyses().size(), 2U) << "the transient is not run twice";
    EXPECT_EQ(run.analyses()[0].directive->name, "tran");
    EXPECT_EQ(run.analyses()[1].directive->name, "ac");
    EXPECT_GT(run.number("top"), 0.1);
    for (const char* text :
         {"test.cir:8:1: .control: 'set' has no effect here: ", "test.cir:14:1: .control: 'plot' has no effect here (and 1 more): -o x.csv",
          "test.cir:16:1: .control: 'write' has no effect here: a script writes no file; -o x.csv"})
        EXPECT_NE(warnings_in(run).find(text), std::string::npos) << warnings_in(run);
    const auto altered = run_netlist(deck + ".control\nop\nalter r1 2k\nac dec 2 10 1k\n.endc\n");
    EXPECT_EQ(altered.analyses().size(), 2U) << "not the .ac of another circuit";
    EXPECT_NE(warnings_in(altered).find("test.cir:8:1: .control: 'alter' is not supported; the rest of this script is not run"),
              std::string::npos)
        << warnings_in(altered);
}

TEST(ForeignNetlist, AParameterOfAnXLineMayUseAnEarlierOne) {
    const std::string deck = "arguments\n.subckt res a b p=1 q=1\nr1 a b {p+q}\n.ends\nv1 in 0 1\n";
    EXPECT_NEAR(run_netlist(deck + "x1 in 0 res p=2 q={10*p}\n.op\n").number("i(v1)"), -1.0 / 22, 1e-12);
    EXPECT_NEAR(run_netlist(deck + ".param p=3\nx1 in 0 res p=2 q={10*p}\n.op\n").number("i(v1)"), -1.0 / 32, 1e-12)
        << "the line's scope first";
}

TEST(ForeignNetlist, ADiodeHasTheCurrentAndChargeOfItsSidewall) {
    const std::string model = ".model dm d(is=1f js=2f jsw=3f cjo=1p cjp=2p php=0.8 mjsw=0.3 fcs=0.4)\n";
    const auto dc = run_netlist("diode\nv1 a 0 0.6\nd1 a 0 dm 2 pj=5\n" + model + ".options gmin=0\n.op\n");
    const double vt = 1.380649e-23 * 300.15 / 1.602176634e-19;
    EXPECT_NEAR(dc.number("i(v1)") / ((2 * 2e-15 + 5 * 3e-15) * std::expm1(0.6 / vt)), -1, 1e-6) << "js is another name of is";
    const auto ac = run_netlist("diode\nv1 a 0 dc -1 ac 1\nd1 a 0 dm 2 pj=5\n" + model + ".options gmin=0\n.ac lin 1 1meg 1meg\n");
    const double c = 2e-12 * std::pow(2, -0.5) + 5 * 2e-12 * std::pow(1 + 1 / 0.8, -0.3);
    EXPECT_NEAR(-ac.complex_curve("i(v1)")[0].imag() / (2 * std::numbers::pi * 1e6 * c), 1, 1e-6);
}

TEST(ForeignNetlist, TheCurrentOfADeviceThatAPrintOrAMeasureNamesIsComputed) {
    const auto run = run_netlist(
        "currents\nv1 a 0 1\nr1 a b 1k\nr2 b 0 1k\n.dc v1 0 2 0.5\n.print dc i(r1)\n.meas dc top max i(r2)\n"
        ".meas dc at when i(r2)=0.4m cross=-1\n");
    EXPECT_NEAR(run.number("top"), 1e-3, 1e-12);
    EXPECT_NEAR(run.number("at"), 0.8, 1e-9);
    EXPECT_NEAR(run.curve("i(r1)").back(), 1e-3, 1e-12);
    EXPECT_EQ(warnings_in(run), "");
}

TEST(ForeignNetlist, PartsOfANetlistMayDependOnConditions) {
    const std::string deck =
        "conditions\n.param n=2\nv1 a 0 1\n.if (n==1)\nr1 a 0 1k\n.model d d(is=1f)\n.op\n.elseif(n = 2)\nr1 a 0 2k\n.model d d(is=2f)\n"
        ".if (n > 5)\nr2 a 0 {nothing}\n.else\nr2 a 0 4k\n.endif\n.else\nr1 a 0 {nothing}\n.op\n.endif\nd1 0 a d\n.dc v1 1 1 1\n";
    const auto run = run_netlist(deck);
    ASSERT_EQ(run.analyses().size(), 1U);
    EXPECT_NEAR(run.number("i(v1)"), -0.75e-3, 1e-9);
    EXPECT_NEAR(run_netlist(deck, {{"n", 1}}).number("i(v1)"), -1e-3, 1e-9) << "an overridden parameter decides, too";
    const auto instances = run_netlist(
        "instances\n.subckt s a n=1\n.if (n==1)\nr1 a 0 1\n.else\nr1 a 0 2\n.endif\n.ends\nx1 a s\nx2 b s n=2\nv1 a 0 1\nv2 b 0 1\n.op\n");
    EXPECT_NEAR(instances.number("i(v1)"), -1, 1e-9);
    EXPECT_NEAR(instances.number("i(v2)"), -0.5, 1e-9);
}

TEST(ForeignNetlist, TablesAreStraightLinesBetweenTheirPoints) {
    const auto at = [](const std::string& x) {
        return run_netlist("tables\nv1 a 0 " + x +
                           "\ne1 b 0 table {2*v(a)} = (-2,1) (0,0) (4,8)\nr1 b 0 1\ng1 0 c TABLE {v(a)} (0,0) (1,{1+1})\nr2 c 0 1\n"
                           "b1 d 0 v=table(v(a),0,0,1,1,2,3)\nr3 d 0 1\nb2 e 0 v=pwl(v(a),0,0,1,1,2,3)\nr4 e 0 1\n.op\n");
    };
    const auto inside = at("0.5"), above = at("3"), below = at("-3");
    EXPECT_NEAR(inside.number("v(b)"), 2, 1e-9);
    EXPECT_NEAR(inside.number("v(c)"), 1, 1e-9);
    EXPECT_NEAR(inside.number("v(d)"), 0.5, 1e-9);
    EXPECT_NEAR(above.number("v(b)"), 8, 1e-9);
    EXPECT_NEAR(above.number("v(d)"), 3, 1e-9);
    EXPECT_NEAR(above.number("v(e)"), 5, 1e-9) << "pwl() continues its lines, as in ngspice 39";
    EXPECT_NEAR(below.number("v(b)"), 1, 1e-9);
    EXPECT_NEAR(below.number("v(e)"), -3, 1e-9);
}

TEST(ForeignNetlist, AFormThatMeansSomethingElseInItsSimulatorGivesAWarning) {
    const std::string power = "dialects\nv1 a 0 3\nb1 b 0 v=v(a)^2+pwr(v(a),1)\nr1 b 0 1x\n.op\n";
    const auto plain = run_netlist(power);
    EXPECT_NEAR(plain.number("v(b)"), 12, 1e-9);
    EXPECT_EQ(warnings_in(plain).find("LTspice"), std::string::npos);
    EXPECT_NE(warnings_in(plain).find("4:8: r1: 1x is 1; HSPICE and Xyce read 'x' as mega: for 1 times 1e6 write 1Meg"), std::string::npos)
        << warnings_in(plain);
    const auto ltspice = warnings_in(run_netlist(power + ".backanno\n"));
    EXPECT_NE(ltspice.find("3:14: '^' is the power |x|^y; in LTspice it is the exclusive or of two truth values: write ** for the power"),
              std::string::npos)
        << ltspice;
    EXPECT_NE(ltspice.find("3:17: 'pwr' has the sign of its first argument; in LTspice it is |x|^y"), std::string::npos) << ltspice;
    EXPECT_NE(warnings_in(run_netlist(power + ".global_param x=1\n")).find("in Xyce it is"), std::string::npos);
    EXPECT_NE(warnings_in(run_netlist(power + ".options runlvl=5\n")).find("the default of HSPICE is 25 C: write .temp 25"),
              std::string::npos);
}

TEST(ForeignNetlist, ATransientMayHaveItsStopTimeOnly) {
    const auto run = run_netlist("LTspice\nv1 a 0 sin(0 1 1k)\nr1 a 0 1\n.tran 5m\n.meas tran top max v(a)\n");
    EXPECT_NEAR(run.number("top"), 1, 1e-3);
    EXPECT_NEAR(run.curve("time").back(), 5e-3, 1e-12);
}

TEST(ForeignNetlist, AStepOfZeroIsChosen) {
    const auto run = run_netlist("LTspice\nv1 a 0 pulse(0 1 1m)\nr1 a b 1k\nc1 b 0 1\xc2\xb5\n.tran 0 5m\n.meas tran x find v(b) at=3m\n");
    EXPECT_NEAR(run.number("x"), 1 - std::exp(-2.0), 2e-3);
}

TEST(ForeignNetlist, ModulatedAndRepeatedWaveformsHaveTheirClosedForms) {
    constexpr double turn = 2 * std::numbers::pi;
    const auto at = [](const std::string& source, double t) {
        return run_netlist(fmt::format("wave\nv1 a 0 {}\nr1 a 0 1\n.tran 1u 4m\n.meas tran x find v(a) at={:.9g}\n", source, t))
            .number("x");
    };
    for (const double t : {0.3e-3, 1.1e-3, 3.7e-3}) {
        EXPECT_NEAR(at("sffm(0.5 2 1k 1.5 200)", t), 0.5 + 2 * std::sin(turn * 1e3 * t + 1.5 * std::sin(turn * 200 * t)), 2e-3) << t;
        EXPECT_NEAR(at("am(2 1 200 2k 1m)", t),
                    t < 1e-3 ? 0 : 2 * (1 + std::sin(turn * 200 * (t - 1e-3))) * std::sin(turn * 2e3 * (t - 1e-3)), 4e-3)
            << t;
    }
    const std::string teeth = "pwl(0 0 0.2m 5 0.5m 1 1m 3) r=0.5m";  // then 1 to 3 within 0.5 ms, again and again
    EXPECT_NEAR(at(teeth, 0.75e-3), 2, 1e-6);
    EXPECT_NEAR(at(teeth, 1.25e-3), 2, 1e-6);
    EXPECT_NEAR(at(teeth, 3.625e-3), 1.5, 1e-6);
    EXPECT_NEAR(at(teeth + " td=0.1m", 3.725e-3), 1.5, 1e-6);
}

TEST(ForeignNetlist, TemperatureCoefficientsMayBeGivenTogether) {
    const auto run = run_netlist("tc\n.temp 37\ni1 0 a 1\nr1 a 0 100 tc=0.01,0.001\ni2 0 b 1\nr2 b 0 100 tc=0.01\n.op\n");
    EXPECT_NEAR(run.number("v(a)"), 100 * (1 + 0.1 + 0.1), 1e-9);
    EXPECT_NEAR(run.number("v(b)"), 100 * (1 + 0.1), 1e-9);
}

TEST(ForeignNetlist, TheLaterOfTwoDcValuesIsUsedWithAWarning) {
    const auto run = run_netlist("dc\nv1 a 0 1 dc 2\nr1 a 0 1k\n.op\n");
    EXPECT_EQ(run.number("v(a)"), 2);
    EXPECT_NE(warnings_in(run).find("2:13: v1: dc is given twice; this value is used"), std::string::npos) << warnings_in(run);
}

TEST(ForeignNetlist, ADegreeSignIsLeftOut) {
    const auto run = run_netlist(
        "degrees\n.options temp=37\xc2\xb0"
        "C\ni1 0 a 1\nr1 a 0 100 tc1=0.01\n.op\n");
    EXPECT_NEAR(run.number("v(a)"), 110, 1e-9);
}

TEST(ForeignNetlist, APortMayBeNamedAsANodeOfItsSubcircuit) {
    const auto run = run_netlist(
        "ports\n.subckt half in out\nr1 in out 1k\nr2 out 0 1k\n.ends\nv1 a 0 2\nx1 a b half\nc1 b 0 1n\n"
        ".ic v(x1.out)=0.25\n.tran 1n 1u\n");
    EXPECT_NEAR(run.curve("v(b)").front(), 0.25, 1e-5);
}

TEST(ForeignNetlist, AnUnknownParameterOfASubcircuitHasNoEffectUnlessItLooksLikeAnError) {
    const std::string body = "extra\n.subckt s a params: width=1\nr1 a 0 {width}\n.ends\ni1 0 a 1\nx1 a s width=5 ";
    const auto run = run_netlist(body + "bogus=2\n.op\n");
    EXPECT_EQ(run.number("v(a)"), 5);
    EXPECT_NE(warnings_in(run).find("x1: subcircuit 's' has no parameter 'bogus', so it has no effect"), std::string::npos);
    const auto circuit = parse_netlist_text(body + "widht=2\n.op\n")->elaborate();
    ASSERT_FALSE(circuit);
    EXPECT_NE(circuit.error().message.find("did you mean 'width'?"), std::string::npos);
}

TEST(ForeignNetlist, AStatementOfASubcircuitWarnsOnceForAllItsInstances) {
    std::string body = "once\n.subckt s a\nr1 a 0 1k\n.ends\n.subckt t a\nx1 a s bogus=1\n.ends\nv1 a 0 1\n";
    for (int k = 0; k < 50; ++k) body += "x" + std::to_string(k) + " a t\n";
    EXPECT_EQ(run_netlist(body + ".op\n").warnings().size(), 1U);
}

TEST(ForeignNetlist, RatingsInModelsHaveNoEffect) {
    const auto run = run_netlist(
        "ratings\nv1 a 0 0.6\nd1 a 0 d1n4148\n.model D1N4148 D(Is=2.52n N=1.752 Iave=200m Vpk=75 mfg=OnSemi type=silicon)\n.op\n");
    EXPECT_NEAR(run.number("i(v1)"), -2.52e-9 * std::expm1(0.6 / 1.752 / 0.0258649), 1e-7);
}

TEST(ForeignNetlist, AnUnknownParameterOfAModelHasNoEffectUnlessItLooksLikeAnError) {
    const std::string elements =
        "models\n.options tnom=27\nv1 a 0 1\nd1 a 0 dm\nq1 a a 0 qm\nm1 a a 0 0 mm w=1u l=1u\ns1 a 0 a 0 sm\nw1 a 0 v1 wm\nr1 a 0 rm 1k\n"
        "c1 a 0 cm 1n\nl1 b 0 lm 1u\nr2 b 0 1k\n.op\n";
    const auto models = [](const std::string& extra) {
        std::string out;
        for (const auto* head : {"dm d(", "qm npn(", "mm nmos(", "sm sw(", "wm csw(", "rm r(", "cm c(", "lm l("})
            out += std::string(".model ") + head + extra + ")\n";
        return out;
    };
    const auto plain = run_netlist(elements + models("")), run = run_netlist(elements + models("zzyzx9=1"));
    EXPECT_EQ(run.number("i(v1)"), plain.number("i(v1)"));
    const auto warnings = warnings_in(run);
    for (const std::string name : {"dm", "qm", "mm", "sm", "wm", "rm", "cm", "lm"})
        EXPECT_NE(warnings.find(": " + name + ": models of type "), std::string::npos) << name << "\n" << warnings;
    EXPECT_NE(warnings.find("have no parameter 'zzyzx9', so it has no effect"), std::string::npos) << warnings;
    EXPECT_EQ(run.warnings().size(), plain.warnings().size() + 8);
}

TEST(ForeignNetlist, AModelMayGiveItsValuesWithoutEqualsSigns) {
    const auto run = run_netlist(
        "words\nv1 a 0 3\nm1 a a 0 0 nm w=10u l=1u\n.model nm nmos(LEVEL 1 KP 25U VTO {0.5+0.3})\nv2 b 0 0.6\nd1 b 0 dm\n"
        ".model dm d is=1e-14 n 1.2\n.op\n");
    EXPECT_NEAR(run.number("i(v1)"), -25e-6 * 10 / 2 * 2.2 * 2.2, 1e-9);
    EXPECT_NEAR(run.number("i(v2)") / (-1e-14 * std::expm1(0.6 / 1.2 / 0.025864925)), 1, 1e-5);
}

TEST(ForeignNetlist, SeveralTemperaturesRepeatAllAnalyses) {
    const auto runs = run_variants("hot\ni1 0 a 1m\nr1 a 0 1k tc1=1m\n.temp 27 {20+107} -73\n.op\n");
    ASSERT_EQ(runs.size(), 3U);
    EXPECT_NEAR(runs[0].number("v(a)"), 1, 1e-9);
    EXPECT_NEAR(runs[1].number("v(a)"), 1.1, 1e-9);
    EXPECT_NEAR(runs[2].number("v(a)"), 0.9, 1e-9);
}

TEST(ForeignNetlist, WordsThatOnlyControlThePrintingOfAnAnalysisGiveAWarning) {
    const auto run = run_netlist("trace\nv1 a 0 sine(0 1 1k)\nr1 a b 1k\nc1 b 0 1n\n.op trace all\n.tran 1u 100u uic trace all\n");
    EXPECT_EQ(run.curve("v(b)", "tran").front(), 0);
    const auto warnings = warnings_in(run);
    EXPECT_NE(warnings.find(".tran: the words after uic have no effect: trace all"), std::string::npos) << warnings;
    EXPECT_NE(warnings.find(".op: the words from 'trace' on have no effect"), std::string::npos) << warnings;
}

TEST(ForeignNetlist, TheEulerMethodIsGearsOfOrderOne) {
    const std::string circuit = "euler\nv1 a 0 pulse(0 1 0 1n 1n 1 2)\nr1 a b 1k\nc1 b 0 1n\n.tran 10n 3u\n.options ";
    EXPECT_EQ(run_netlist(circuit + "method=euler\n").curve("v(b)"), run_netlist(circuit + "maxord=1\n").curve("v(b)"));
}

TEST(ForeignNetlist, ASidewallAndABreakdownMayHaveTheirOwnEmissionCoefficients) {
    const auto run = run_netlist(
        "emission\nv1 a 0 0.5\nd1 a 0 dm pj=2\n.model dm d(is=1e-12 n=1.2 jsw=1e-11 ns=2)\nv2 b 0 -10.1\nd2 b 0 dz\n"
        ".model dz d(is=1e-15 n=1 vb=10 ibv=1m nbv=3)\n.op\n");
    const double vt = 0.025864925;  // kT/q at 300.15 K, V
    EXPECT_NEAR(run.number("i(v1)") / -(1e-12 * std::expm1(0.5 / 1.2 / vt) + 2e-11 * std::expm1(0.5 / 2 / vt)), 1, 1e-5);
    EXPECT_NEAR(run.number("i(v2)") / (1e-3 * std::exp(0.1 / 3 / vt)), 1, 1e-5);
}

TEST(ForeignNetlist, AnElementWithABranchControlsACurrentSource) {
    const auto run = run_netlist(
        "controls\nv1 a 0 1\ne1 b 0 a 0 2\nb1 c 0 v=3*v(a)\nl1 a d 1m\nrb b 0 1\nrc c 0 1\nrd d 0 1\n"
        "f1 0 x e1 -1\nr1 x 0 1\nh1 y 0 b1 -1\nf2 0 z l1 1\nr2 z 0 1\n.op\n");
    EXPECT_NEAR(run.number("v(x)"), 2, 1e-9);
    EXPECT_NEAR(run.number("v(y)"), 3, 1e-9);
    EXPECT_NEAR(run.number("v(z)"), 1, 1e-9);
}

TEST(ForeignNetlist, ColonsSeparateInstanceAndNodeInInitialVoltages) {
    const auto run = run_netlist(
        "colons\n.subckt s in out\nr1 in mid 1k\nc1 mid out 1u\n.ends\nv1 a 0 0\nx_1 a 0 s\n.ic v(X_1:mid )=0.5 v(x_1:in)=0\n"
        ".tran 1m 1m\n.meas tran v0 find v(x_1.mid) at=0\n.meas tran v1 find v(x_1.mid) at=1m\n");
    EXPECT_NEAR(run.number("v0"), 0.5, 1e-6);
    EXPECT_NEAR(run.number("v1"), 0.5 * std::exp(-1), 1e-5);
}

// The charges set the voltage of a node between capacitors.
TEST(ForeignNetlist, ATransientFromGivenVoltagesNeedsNoPathToGround) {
    const std::string chain = "chain\nv1 a 0 pulse(0 1 1u 1u 1u 1 2)\nc1 a b 1n\nc2 b c 1n ic=0.5\nr1 c 0 1k\n";
    const auto run = run_netlist(chain + ".tran 1u 20u uic\n.meas tran b find v(b) at=1u\n.meas tran last find v(b) at=20u\n");
    EXPECT_NEAR(run.number("last"), 0.5 * (1 + 0.5), 1e-4);
    const auto circuit = parse_netlist_text(chain + ".tran 1u 20u uic\n.op\n")->elaborate();
    ASSERT_TRUE(circuit);
    const auto system = System::make(std::make_shared<const Circuit>(*circuit));
    ASSERT_FALSE(system);
    EXPECT_NE(system.error().message.find("no path to ground"), std::string::npos);
}

// As in LTspice. A transformer is often connected to an ideal source.
TEST(ForeignNetlist, AnInductorAcrossASourceHasOneMilliohm) {
    const auto run = run_netlist(
        "loop\nv1 a 0 sin(0 1 1k)\nl1 a 0 1m\nl2 b 0 4m\nk1 l1 l2 1\nr1 b 0 1k\n.op\n.tran 1u 1m\n"
        ".meas tran peak max v(b)\n.meas tran last find i(l1) at=0.5m\n");
    EXPECT_NE(warnings_in(run).find("l1: closes a loop with sources or other inductors"), std::string::npos) << warnings_in(run);
    EXPECT_NEAR(run.number("peak"), 2, 2 * 1e-3 * 0.32) << "less the voltage of up to 0.32 A in 1 milliohm";
    const double w = 2 * std::numbers::pi * 1e3;
    EXPECT_NEAR(run.number("last"), 2 / (w * 1e-3), 1e-3) << "the current of L1, begun at 0, is (1 - cos wt) / (w L)";
    EXPECT_NEAR(run_netlist("loop\nv1 a 0 2\nl1 a 0 1m\n.op\n").number("i(l1)"), 2000, 1e-6);
}

TEST(ForeignNetlist, AnInductorMayHaveAResistanceInSeries) {
    const auto run = run_netlist("series\nv1 a 0 2\nl1 a 0 1m Rser=0.5 m=2\n.op\n.tran 1m 4m uic\n.meas tran i find i(l1) at=2m\n");
    EXPECT_TRUE(run.warnings().empty()) << warnings_in(run);
    EXPECT_NEAR(run.number("i(l1)"), 8, 1e-9);
    EXPECT_NEAR(run.number("i"), 8 * -std::expm1(-1), 1e-4);
}

TEST(ForeignNetlist, TheLastOfSeveralValuesOrFunctionsIsUsedWithAWarning) {
    const auto run = run_netlist(
        "twice\n.options gmin=0\nv1 a 0 0.5\nd1 a 0 dm\nd2 a 0 dn\n.model dm d is=1e-14 is=1e-12\n.model dn d(is 1e-14 is 1e-12)\n"
        ".func g(x) {x}\n.func g(x) {2*x}\nr1 b 0 {g(1k)}\ni1 0 b 1m\n.op\n");
    EXPECT_NEAR(run.number("i(v1)") / (-2e-12 * std::expm1(0.5 / 0.025864925)), 1, 1e-5);
    EXPECT_NEAR(run.number("v(b)"), 2, 1e-9);
    const auto warnings = warnings_in(run);
    for (const char* text : {"6:22: model 'dm': is is given twice", "7:22: model 'dn': is is given twice", "9:7: g() is defined twice"})
        EXPECT_NE(warnings.find(text), std::string::npos) << warnings;
}

TEST(ForeignNetlist, ASectionOfALibraryMayHaveADotInItsName) {
    const auto open = [](const std::string& path) -> Result<std::string> {
        if (!path.ends_with("a.lib")) return bad_input("there is no such file");
        return std::string(".lib tt_1.8v\n.param rr=1k\n.endl\n.lib tt.x\n.param rr=2k\n.endl\n");
    };
    const auto resistance = [&](const std::string& section, const std::string& corner) {
        const auto netlist = Netlist::parse("dot\nr1 a 0 {rr}\n.lib a.lib " + section + "\n.op\n", "dot.cir", open, corner);
        if (!netlist) return ADD_FAILURE() << netlist.error().text(), 0.0;
        return netlist->elaborate()->elements[0].value;
    };
    EXPECT_EQ(resistance("tt_1.8v", ""), 1e3);
    EXPECT_EQ(resistance("tt.x", ""), 2e3);
    EXPECT_EQ(resistance("tt.x", "tt_1.8v"), 1e3);
    EXPECT_EQ(resistance("tt_1.8v", "tt.x"), 2e3);
}

TEST(ForeignNetlist, FaultsInABranchThatDoesNotHoldAreNotReported) {
    const std::string deck = "branch\n.param x=0\nv1 a 0 2\nr1 a 0 1k\n.if (x)\nj1 a 0 0 jm\nr2 a\n.foo bar\n.endif\n.op\n";
    EXPECT_NEAR(run_netlist(deck).number("i(v1)"), -2e-3, 1e-12);
    const auto netlist = parse_netlist_text(deck);
    ASSERT_TRUE(netlist);
    const auto circuit = netlist->elaborate({{"x", 1}});
    ASSERT_FALSE(circuit);
    EXPECT_NE(circuit.error().message.find("unknown element letter j"), std::string::npos);
    ASSERT_TRUE(circuit.error().further);
    EXPECT_EQ(circuit.error().further->size(), 2U);
}

TEST(ForeignNetlist, ATemperatureOverrideReplacesAListOfTemperatures) {
    const auto netlist = parse_netlist_text("hot\ni1 0 a 1m\nr1 a 0 1k tc1=1m\n.temp 27 127\n.op\n");
    ResolvedOverrides overrides;
    overrides.temperature = 77;
    const auto circuit = netlist->with_overrides(overrides).elaborate();
    ASSERT_TRUE(circuit);
    EXPECT_EQ(circuit->temperature, 77);
    EXPECT_FALSE(circuit->has_directive("step"));
}

TEST(ForeignNetlist, FormsOfAnotherSimulatorAreFoundInFunctionsButNotInNames) {
    const auto functions = run_netlist("LTspice\nv1 a 0 2\n.func f(x) {x^3}\nb1 b 0 v=f(v(a))\nr1 b 0 1k\n.op\n.backanno\n");
    EXPECT_NE(warnings_in(functions).find("3:14: '^' is the power"), std::string::npos) << warnings_in(functions);
    const auto names = run_netlist("Xyce\n.global_param z=1\n.func f1pwr(x,y) {x+y}\nv1 a 0 1\nb1 b 0 v={f1pwr(v(a),2)}\nr1 b 0 1k\n.op\n");
    EXPECT_EQ(warnings_in(names), "");
}

TEST(ForeignNetlist, AnIslandWithoutCapacitorsIsRefusedInATransientFromGivenVoltages) {
    const auto circuit = parse_netlist_text("island\ni1 0 a 1m\nr1 a b 1k\n.tran 1n 1u uic\n")->elaborate();
    ASSERT_TRUE(circuit);
    const auto system = System::make(std::make_shared<const Circuit>(*circuit));
    ASSERT_FALSE(system);
    EXPECT_NE(system.error().message.find("nodes 'a', 'b' have no path to ground: their part of the circuit is connected to ground only"),
              std::string::npos)
        << system.error().message;
}

TEST(ForeignNetlist, CardsOfRealDiodesAreRead) {
    const auto run = run_netlist(
        "diodes\nv1 a 0 0.7\nd1 a 0 D1N4148\nv2 b 0 0.8\nd2 b 0 1N4007\n"
        ".model D1N4148 D(Is=5.84n N=1.94 Rs=0 Ikf=44.17m Xti=3 Eg=1.11 Cjo=.95p M=.55 Vj=.75 Fc=.5 Isr=11.07n Nr=2.088 Bv=100 Ibv=100u "
        "Tt=11.07n)\n"
        ".model 1N4007 D(IS=14.11N N=1.984 RS=33.89M IKF=94.81 XTI=3 EG=1.110 CJO=25.89P M=.44 VJ=.3245 FC=.5 BV=1500 IBV=10U TT=5.7U "
        "IBVL=1u TRS1=0)\n.op\n");
    EXPECT_EQ(run.warnings().size(), 1U);
    EXPECT_NE(warnings_in(run).find("1n4007: models of type d have no parameter 'ibvl', so it has no effect"), std::string::npos);
    const double vt = 1.380649e-23 * 300.15 / 1.602176634e-19, barrier = 1 - 0.7 / 0.75;
    const double recombination = 11.07e-9 * std::expm1(0.7 / (2.088 * vt)) * std::pow(barrier * barrier + 0.005, 0.55 / 2);
    const double i = 5.84e-9 * std::expm1(0.7 / (1.94 * vt)) + recombination;
    EXPECT_NEAR(-run.number("i(v1)") / (i / (1 + std::sqrt(i / 44.17e-3))), 1, 1e-6);
}

// The slopes of high injection and recombination are those of the current.
TEST(ForeignNetlist, TheConductanceOfADiodeIsTheSlopeOfItsCurrent) {
    const std::string card = "d1 a 0 dm 2\n.model dm d(is=5n n=1.9 ikf=40m ikr=2n isr=11n nr=2.1 vj=0.75 m=0.55)\n.options gmin=0\n";
    for (const double v : {-3.0, -0.2, -0.05, 0.3, 0.6, 0.74, 0.9}) {
        const auto current = [&](double u) { return run_netlist(fmt::format("slope\nv1 a 0 {:.12g}\n{}.op\n", u, card)).number("i(v1)"); };
        const auto ac = run_netlist(fmt::format("slope\nv1 a 0 {:.12g} ac 1\n{}.ac lin 1 1 1\n", v, card));
        const double step = 1e-5, slope = (current(v + step) - current(v - step)) / (2 * step);
        EXPECT_NEAR(ac.complex_curve("i(v1)")[0].real() / slope, 1, 1e-4) << v;
    }
}

TEST(ForeignNetlist, CapacitorsCoilsAndSourcesMayHaveParasiticElements) {
    const std::string written =
        "r1 a1 a 10\nv1 a1 0 ac 1\ncp1 a 0 1n\nc2 b b1 1u\nr3 b1 b2 2\nl4 b2 0 1u\nr5 b 0 100\nr6 a b 1k\n"
        "c7 b 0 1p\nl8 b 0 1m\nr9 b 0 5k\nc10 b 0 2p\n.ac dec 3 1 1g\n";
    const std::string line =
        "v1 a 0 ac 1 Rser=10 Cpar=1n\nc2 b 0 1u Rser=2 Lser=1u Rpar=100 Cpar=1p V=16 Irms=2 mfg=x type=y\n"
        "l8 b 0 1m Rpar=5k Cpar=2p Ipk=1\nr6 a b 1k tol=1 pwr=0.1\n.ac dec 3 1 1g\n";
    const auto expected = run_netlist("written\n" + written), found = run_netlist("line\n" + line);
    EXPECT_EQ(warnings_in(found), "");
    const auto a = expected.complex_curve("v(b)"), b = found.complex_curve("v(b)");
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LE(std::abs(a[k] - b[k]), 1e-9 * std::abs(a[k])) << k;
    const auto copies = run_netlist(
        "copies\n.subckt s a\nv1 x 0 1 rser=10\nr1 x a 10\n.ends\nx1 a s m=4\nr2 a 0 5\nc1 a b 1n m=2 rpar=20\nr3 b 0 10\n.op\n");
    EXPECT_NEAR(copies.number("v(a)"), 4.0 / 9, 1e-9) << "5 ohm, and 5 ohm parallel to 20";
    const auto circuit = parse_netlist_text("negative\nv1 a 0 1\nc1 a 0 1n rser=-1\n.op\n")->elaborate();
    ASSERT_FALSE(circuit);
    EXPECT_NE(circuit.error().message.find("c1: rser = -1 ohm is below 0"), std::string::npos);
}

TEST(ForeignNetlist, AResistorMayBeWithoutNoise) {
    const auto run = run_netlist(
        "noise\nv1 a 0 ac 1\nr1 a b 1k\nr2 b 0 1k noisy=0\n.noise v(b) v1 lin 1 1k 1k\n.meas noise x max v(onoise)\n"
        ".meas noise y find inoise at=1k\n");
    const double thermal = std::sqrt(4 * 1.380649e-23 * 300.15 * 1e3);
    EXPECT_NEAR(run.number("x") / (thermal / 2), 1, 1e-6);
    EXPECT_NEAR(run.number("y") / thermal, 1, 1e-6);
}

TEST(ForeignNetlist, ControlledSourcesMayHaveTheirKindOrValueWithoutEquals) {
    const auto run = run_netlist(
        "kinds\nv1 in gnd! 2\ne1 a 0 VCVS in 0 10\ng1 0 b VCCS in 0 1\nf1 0 c CCCS v1 2\nh1 d 0 CCVS v1 3\ne2 e 0 VALUE {v(in)*3}\n"
        "g2 0 f VALUE {v(in)*4}\ne3 g 0 VCVS POLY(1) in 0 1 2\nr0 in 0 1\nra a 0 1\nrb b 0 1\nrc c 0 1\nrd d 0 1\nre e 0 1\nrf f 0 1\nrg g "
        "0 1\n"
        ".op\n");
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"v(a)", 20}, {"v(b)", 2}, {"v(c)", -4}, {"v(d)", -6}, {"v(e)", 6}, {"v(f)", 8}, {"v(g)", 5}})
        EXPECT_NEAR(run.number(name), value, 1e-9) << name;
}

TEST(ForeignNetlist, TheStandardLibraryOfLtspiceIsNamedIfItIsMissing) {
    const auto run = run_netlist("library\nv1 a 0 1\nr1 a 0 1k\n.lib C:\\Users\\me\\lib\\cmp\\standard.bjt\n.op\n");
    EXPECT_NE(warnings_in(run).find("standard.bjt' is not read: the models of LTspice's own library must be in the netlist"),
              std::string::npos)
        << warnings_in(run);
}

TEST(ForeignNetlist, AnXLineDefinesParametersThatItsSubcircuitUses) {
    const auto run = run_netlist(
        "opamp\nv1 in 0 1m\nxu1 in 0 out opamp Aol=100 GBW=10Meg\n.subckt opamp 1 2 3\ng1 0 3 1 2 {Aol}\nr3 3 0 1\nc3 3 0 {Aol/GBW/6.28}\n"
        ".ends opamp\n.op\n");
    EXPECT_NEAR(run.number("v(out)"), 0.1, 1e-9);
    EXPECT_EQ(warnings_in(run), "");
}

TEST(ForeignNetlist, AStepMayDefineItsParameterOrNameAnElement) {
    const auto last = [](const std::string& step) {
        const auto runs = run_variants("step\nv1 a 0 1\nr1 a b 1k\nr2 b 0 {x}\n.param x=1k\n" + step + "\n.op\n");
        return runs.empty() ? std::nan("") : runs.back().number("v(b)");
    };
    EXPECT_NEAR(last(".step V1 list 1 2 3"), 1.5, 1e-9);
    EXPECT_NEAR(last(".STEP R1 500 1500 500"), 0.4, 1e-9);
    EXPECT_NEAR(last(".step lin x 500 1500 500"), 0.6, 1e-9);
    const auto runs = run_variants("step\nv1 a 0 1\nr1 a b {r}\nr2 b 0 1k\n.step param r list 1k 3k\n.op\n");
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_NEAR(runs[0].number("v(b)"), 0.5, 1e-9);
    EXPECT_NEAR(runs[1].number("v(b)"), 0.25, 1e-9);
    const auto error_of = [](const std::string& step) {
        const auto netlist = parse_netlist_text("step\nv1 a 0 1\nr1 a 0 1k\nd1 a 0 d\n.model d d\n" + step + "\n.op\n");
        if (!netlist) return netlist.error().message;
        auto variants = NetlistVariants::create(*netlist);
        if (!variants) return variants.error().message;
        const auto first = variants->at(0);
        return first ? std::string() : first.error().message;
    };
    EXPECT_EQ(error_of(".step D D(Is) list 1f 2f"),
              ".step: a parameter of a model is not stepped directly; write {x} for it in the .model line, and .step param x");
    EXPECT_EQ(error_of(".step rr1 list 1 2"), ".step: there is no parameter or element 'rr1'; did you mean 'r1'?");
    EXPECT_EQ(error_of(".step d1 list 1 2"),
              "d1: .step: a junction diode has no value to step; write {x} in its line or model, and .step param x");
    EXPECT_EQ(error_of(".step param r1 list 1 2"), "there is no .param r1; leave out the word param to step the element");
}

TEST(ForeignNetlist, WaveformsHaveLtspicesForms) {
    const auto run = run_netlist(
        "waves\nv1 a 0 SINE(1 2 1k 0 0 90 2)\nv2 b 0 PWL(0 0 1m 5 +1m 5 +0.5m 0)\nv3 c 0 ac=1,90 pulse(0,5,1n,1n,1n,1,2)\nr1 a 0 1\nr2 b 0 "
        "1\n"
        "r3 c 0 1\n.tran 0 4m 0 10u startup\n.meas tran end find v(a) at=3m\n.meas tran p find v(a) at=1.75m\n"
        ".meas tran half find v(b) at=2.25m\n.ac lin 1 1 1\n");
    EXPECT_NEAR(run.number("end"), 3, 1e-9);
    EXPECT_NEAR(run.number("p"), 1 + 2 * std::cos(2 * std::numbers::pi * 1.75), 1e-3);
    EXPECT_NEAR(run.number("half"), 2.5, 1e-9);
    EXPECT_NEAR(std::abs(run.complex_curve("v(c)", "ac")[0] - std::complex<double>(0, 1)), 0, 1e-12);
    EXPECT_NE(warnings_in(run).find(".tran: 'startup' has no effect"), std::string::npos) << warnings_in(run);
    EXPECT_EQ(warnings_in(run).find("decimal point"), std::string::npos) << "a list with commas";
}

TEST(ForeignNetlist, StatementsAndOptionsOfOtherSimulatorsAreNamed) {
    const auto run = run_netlist(
        "statements\nv1 a 0 1\nr1 a 0 100\xce\xa9\n.wave x.wav 16 44.1k v(a)\n.preprocess replaceground true\n.net i(r1) v1\n"
        ".option accurate plotreltol=1e-4 rshunt=1e12\n.op\n.alter\nr1 a 0 200\n");
    EXPECT_NEAR(run.number("i(v1)"), -0.01, 1e-9);
    for (const char* text : {".wave has no effect here", ".preprocess has no effect here", ".net has no effect here",
                             "'rshunt' is ignored: no such elements are added", ".alter is not supported: only the circuit before it"})
        EXPECT_NE(warnings_in(run).find(text), std::string::npos) << warnings_in(run);
    EXPECT_EQ(warnings_in(run).find("accurate"), std::string::npos);
}

TEST(ForeignNetlist, ATitleIsTakenForAnElementOnlyIfItHasItsForm) {
    const auto warns = [](const std::string& title) {
        return warnings_in(run_netlist(title + "\nv1 a 0 1\nr1 a 0 1k\n.op\n")).find("the first line is the title") != std::string::npos;
    };
    for (const char* title : {"V1 in 0 5", "r1 a b {r}", "v2 b 0 dc 5", "q1 1 2 3 bc547", "M1 d g 0 0 nm w=1u", ".op"})
        EXPECT_TRUE(warns(title)) << title;
    for (const char* title : {"k=1 with a diode that has Cjo", "M1 amplifier with an active load", "R2 ladder with five sections",
                              "x10 probe", "L1 cache of a large processor"})
        EXPECT_FALSE(warns(title)) << title;
}

// The remedy holds for M, which SPICE reads as milli.
TEST(ForeignNetlist, AnUpperFrequencyInMilliIsMeantInMega) {
    for (const char* last : {"1M", "1MHz"}) {
        const auto circuit = make_circuit(fmt::format("mega\nv1 a 0 ac 1\nr1 a 0 1k\n.ac dec 10 1 {}\n", last));
        const auto outcome = run_directives(circuit);
        ASSERT_FALSE(outcome);
        EXPECT_NE(outcome.error().message.find("write .ac dec 10 1 1meg"), std::string::npos) << outcome.error().message;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
