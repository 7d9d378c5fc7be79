// The verb 'fit transistor' of the program.

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder;

const std::string curves = test::source_root() + "/examples/data/nmos.raw";

TEST(FitTransistorProgram, FitsTheCurvesOfABsim3CardAndItsCardRuns) {
    const TemporaryFolder folder;
    const auto ran = run_program(
        folder, fmt::format("fit transistor {} -W 1.5u -L 0.5u --card n.lib --name fitted --set cox=8m --report n.html --json", curves));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto document = nlohmann::json::parse(ran.out);
    EXPECT_EQ(document["type"], "nmos");
    EXPECT_LT(document["misfit"]["rms"].get<double>(), 0.1);
    EXPECT_LT(document["misfit"]["gm_over_ID"].get<double>(), 0.12);
    EXPECT_EQ(document["card"]["cox"], 8e-3);
    EXPECT_NE(test::read_file(folder / "n.html").find("I_D over V_G"), std::string::npos);

    // The card gives the current that the fit has told, in a netlist.
    folder.write("use.cir", "t\n.include 'n.lib'\nm1 d g 0 0 fitted w=1.5u l=0.5u\nvd d 0 0.4\nvg g 0 0.5\n.op\n.save i(m1)\n");
    const auto run = run_program(folder, "run use.cir -q -o use.csv");
    ASSERT_EQ(run.status, 0) << run.err;
    const auto rows = test::read_file(folder / "use.csv");
    EXPECT_NEAR(std::stod(rows.substr(rows.find('\n') + 1)) / 2.2e-6, 1, 0.2) << rows;

    // Another fit replaces the card, but no other file.
    const auto again = fmt::format("fit transistor {} -W 1.5u -L 0.5u -q --card ", curves);
    EXPECT_EQ(run_program(folder, again + "n.lib").status, 0);
    EXPECT_EQ(run_program(folder, again + "use.cir").status, 1);
    const auto input = run_program(folder, again + "'" + curves + "' --overwrite");
    EXPECT_NE(input.status, 0);
    EXPECT_NE(input.err.find("input"), std::string::npos) << input.err;
}

TEST(FitTransistorProgram, ReadsTheColumnsThatPeopleWrite) {
    const TemporaryFolder folder;
    std::string rows;
    for (int k = 0; k <= 24; ++k) {
        const double V = 0.05 * k, q = std::log1p(std::exp((V - 0.45) / 0.065)), I = 1e-7 * q * q;  // much like a transistor
        rows += fmt::format("{};{};{};300\n", 1e3 * V, 0.4, 1e6 * I);
    }
    folder.write("a.csv", "# lot 7\nVGS (mV);VDS;ID (uA);T (K)\n" + rows);
    folder.write("b.csv", "Gate [mV];Drain;Current [uA];Kelvin\n" + rows);
    const auto known = run_program(folder, "fit transistor a.csv -W 1u -L 1u --fit vto,isq,n,zetal");
    ASSERT_EQ(known.status, 0) << known.err;
    const auto named = run_program(folder,
                                   "fit transistor b.csv -W 1u -L 1u --fit vto,isq,n,zetal --column v_gs=Gate --column v_ds=Drain "
                                   "--column i_d=Current --temperature 26.85");
    ASSERT_EQ(named.status, 0) << named.err;
    EXPECT_EQ(known.out, named.out);
    EXPECT_NE(known.err.find("the bulk is taken as connected to the source"), std::string::npos) << known.err;
}

/// Rows of V_GS, V_DS, I_D of a transistor whose currents and voltages are multiplied by `sign`, the currents also by `factor`.
std::string rows_of(double sign, double factor) {
    std::string out;
    for (const double V_DS : {0.05, 0.4})
        for (int k = 0; k <= 24; ++k) {
            const double V = 0.05 * k, q = std::log1p(std::exp((V - 0.45) / 0.065)), r = std::log1p(std::exp((V - 0.45 - V_DS) / 0.065));
            out += fmt::format("{},{},{}\n", sign * V, sign * V_DS, sign * factor * 1e-7 * (q * q - r * r));
        }
    return out;
}

TEST(FitTransistorProgram, TwoPolaritiesInOneFitAreAnError) {
    const TemporaryFolder folder;
    folder.write("both.csv", "VGS,VDS,ID\n" + rows_of(1, 1) + rows_of(-1, 0.5));
    const auto ran = run_program(folder, "fit transistor both.csv -W 1u -L 1u");
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.err.find("points conduct as a PMOS and others as an NMOS"), std::string::npos) << ran.err;
}

TEST(FitTransistorProgram, AParameterIsFittedOrGivenButNotBoth) {
    const TemporaryFolder folder;
    folder.write("a.csv", "VGS,VDS,ID\n" + rows_of(1, 1));
    const auto ran = run_program(folder, "fit transistor a.csv -W 1u -L 1u --set vto=0.3 --fit V_T0");
    EXPECT_EQ(ran.status, 2);
    EXPECT_NE(ran.err.find("--fit V_T0: but --set gives its value"), std::string::npos) << ran.err;
}

TEST(FitTransistorProgram, CurrentsInAWrongUnitEndWithAnErrorOrAWarning) {
    for (const double factor : {1e-9, 1e-12, 1e-280, 1e12}) {
        const TemporaryFolder folder;
        folder.write("a.csv", "VGS,VDS,ID\n" + rows_of(1, factor));
        const auto ran = run_program(folder, "fit transistor a.csv -W 1u -L 1u");
        EXPECT_TRUE(ran.status == 0 || ran.status == 1) << factor << " " << ran.status << ran.err;
        EXPECT_FALSE(ran.err.empty());
    }
}

TEST(FitTransistorProgram, ErrorsNameTheFileTheRowAndTheRemedy) {
    const TemporaryFolder folder;
    std::string good = "VGS,VDS,ID\n";
    for (int k = 0; k < 12; ++k) good += fmt::format("{},0.1,{}\n", 0.05 * k, 1e-12 * std::exp(k));
    folder.write("good.csv", good);
    folder.write("empty.csv", "");
    folder.write("head.csv", "VGS,VDS,ID\n");
    folder.write("word.csv", good + "0.6,0.1,abc\n");
    folder.write("inf.csv", good + "0.6,0.1,inf\n");
    folder.write("fields.csv", good + "0.6,0.1\n");
    folder.write("few.csv", "VGS,VDS,ID\n0,0.1,1e-9\n");
    folder.write(
        "zero.csv", std::string("VGS,VDS,ID\n") + [] {
            std::string s;
            for (int k = 0; k < 12; ++k) s += "0.1,0.1,0\n";
            return s;
        }());
    folder.write("no_drain.csv", "VGS,ID\n0,1\n");
    folder.write("no_current.csv", "VGS,VDS\n0,1\n");
    folder.write("size.csv", "VGS,VDS,ID,W,L\n0,0.1,1e-9,1.5,0.5\n");
    folder.write("unit.csv", "VGS (A),VDS,ID\n0,0.1,1e-9\n");
    folder.write("bad.raw", "VGS,ID\n");
    const std::pair<std::string, std::string> rows[] = {
        {"", "DATA is required"},
        {"none.csv", "none.csv"},
        {"empty.csv", "empty.csv: the file is empty; expected a header, such as V_G,V_D,I_D"},
        {"head.csv", "head.csv: the table has a header but no rows"},
        {"word.csv", "word.csv:14:9: i_d: 'abc' is not a number; correct it, or delete the row"},
        {"inf.csv", "inf.csv:14:9: i_d: 'inf' is not a number"},
        {"fields.csv", "fields.csv:14: 2 fields where the header has 3"},
        {"few.csv", "1 points are too few; a card needs at least 10"},
        {"zero.csv", "every drain current is 0; is the column of I_D the right one? --column i_d=HEAD"},
        {"no_drain.csv",
         "no_drain.csv:1: no column holds the drain voltage; this file has: VGS, ID. Name one with --column v_ds=HEAD, or give a "
         "constant with --vds 50mV"},
        {"no_current.csv", "no column holds the drain current"},
        {"size.csv", "size.csv:2:12: width = 1.5 is outside [1e-09, 0.01] m; write the unit into the heading, such as 'W (um)'"},
        {"unit.csv", "'VGS (A)': the unit of v_gs must be one of V"},
        {"bad.raw", "bad.raw:1: a .raw file of SPICE begins with 'Title:'"},
        {"good.csv --column i_d=-ID", "flows out of the drain; if it is measured with the opposite sign, write --column i_d=-HEAD"},
        {"good.csv --column i_d=Current", "there is no such column; the file has: VGS, VDS, ID"},
        {"good.csv --type pmos --column i_d=-ID", "flows out of the drain"},
        {"good.csv --fit A_VT", "--fit avt: these data do not determine it: there is one device; measure 10 or more"},
        {"good.csv --fit k", "--fit k: curves do not determine such a parameter; there are all, vto"},
        {"good.csv --set isq=-1", "isq"},
        {"good.csv --noise 2", "--noise 2: must be between 0 and 1, such as 1%"},
        {"good.csv -W 1u,2u", "--width has 2 values; give one for all files, or one for each of the 1 files"},
        {"good.csv -W 5", "--width 5 is outside [1e-09, 0.01] m; write a value such as --width 0.5um"},
        {"good.csv --report x.pdf", "the name must end in .html"},
    };
    for (const auto& [arguments, expected] : rows) {
        const auto ran = run_program(folder, "fit transistor " + arguments);
        EXPECT_NE(ran.status, 0) << arguments;
        EXPECT_NE(ran.err.find(expected), std::string::npos) << arguments << ": " << ran.err;
    }
}

}  // namespace
}  // namespace corpuscle
