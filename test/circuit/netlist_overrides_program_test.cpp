// The program's verbs respond, run and list with overrides and probes of netlists, from any folder.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::read_file;
using test::run_program;
using test::TemporaryFolder;
using Json = nlohmann::json;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t spikes_in(const TemporaryFolder& folder, const std::string& out) {
    const auto text = read_file(folder / (out + "/spikes.csv"));
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1;
}

/// A divider of the supply, charged by the force.
constexpr const char* divider_text =
    "divider\n.param supply=1 r_top=1k\nvdd vdd 0 {supply}\nxdiv vdd mid half\niin 0 mid force 1m\n"
    ".subckt half a b\nrtop a b {r_top}\nrlow b 0 1k\nclow b 0 1u\n.ends\n.spike v(mid) 1.2\n.save v(mid)\n";

TEST(NetlistOverridesProgram, TheChipRespondsInAnyFolderAndOverridesChangeIt) {
    const TemporaryFolder folder;
    const std::string press = "respond press --quiet --afferent ";
    ASSERT_EQ(run_program(folder, press + "sa1-circuit -o plain").status, 0);
    const auto set =
        run_program(folder, press +
                                "SA1-circuit --set sa1-circuit.C_u=10.8pF --set SA1-circuit.summer.N3B=12x4 --corner tt --temp 27 "
                                "--probe 'VF,i(N3B),rectb.o' -o set");
    ASSERT_EQ(set.status, 0) << set.err;
    EXPECT_EQ(spikes_in(folder, "plain"), 16U);
    EXPECT_LT(spikes_in(folder, "set"), 10U) << "a membrane of twice the capacitance";
    const auto probes = read_file(folder / "set/probes.csv");
    EXPECT_EQ(probes.substr(0, probes.find('\n')),
              "time_s,press_N,sa1-circuit.press.v(vf) [V],sa1-circuit.press.i(xsummer.mn3b) [A],sa1-circuit.press.v(xrectb.o) [V]");
    const auto one = Json::parse(read_file(folder / "set/summary.json"))["afferents"][0];
    EXPECT_EQ(one["name"], "sa1-circuit");
    EXPECT_EQ(one["corner"], "tt");
    EXPECT_DOUBLE_EQ(one["parameters"]["c_u"]["value"].get<double>(), 10.8e-12);
    EXPECT_EQ(one["parameters"]["c_u"]["set"], true);
    EXPECT_EQ(one["parameters"]["c_hpb"]["set"], false);
    EXPECT_EQ(one["parameters"]["temp"]["value"], 27);
    EXPECT_EQ(one["parameters"]["xsummer.mn3b.m"]["value"], 12);
    EXPECT_FALSE(one["parameters"].contains("vtn_shift")) << "a parameter of the process card";
}

TEST(NetlistOverridesProgram, OptionsApplyToEveryNetlistAndAnOverrideForOneTakesPrecedence) {
    const TemporaryFolder folder;
    folder.write("a.cir", divider_text), folder.write("b.cir", divider_text);
    const auto ran =
        run_program(folder, "respond step -a a.cir,b.cir,sa1 --supply 0.5V --set b.cir.SUPPLY=2 --probe 'div.a,mid,i(top)' -o out");
    ASSERT_EQ(ran.status, 1) << "vdd is the node, div.a only a port";
    EXPECT_TRUE(has(ran.err, "--probe div.a: no netlist or NIR graph of this run has such a quantity")) << ran.err;
    const auto good =
        run_program(folder, "respond step -a a.cir,b.cir,sa1 --supply 0.5V --set b.cir.SUPPLY=2 --probe 'VDD,i(div.top)' -o out --report");
    ASSERT_EQ(good.status, 0) << good.err;
    const auto probes = read_file(folder / "out/probes.csv");
    EXPECT_TRUE(
        has(probes, "a.cir.step.v(vdd) [V],a.cir.step.i(xdiv.rtop) [A],b.cir.step.v(vdd) [V],b.cir.step.i(xdiv.rtop) [A],sa1.step"));
    EXPECT_TRUE(has(probes, ",0.5,0.00025,2,0.001,")) << probes.substr(0, 400);
    const auto page = read_file(folder / "out/report.html");
    EXPECT_TRUE(has(page, "i(xdiv.rtop)"));
}

TEST(NetlistOverridesProgram, ImpossibleOverridesAreRejectedByName) {
    const TemporaryFolder folder;
    folder.write("a.cir", divider_text);
    auto other = std::string(divider_text);
    other.replace(other.find("supply=1 r_top=1k"), 17, "r_top=1k v=1"), other.replace(other.find("{supply}"), 8, "{v}");
    folder.write("b.cir", other);
    const auto expect_error = [&](const std::string& words, int status, const std::string& what) {
        const auto ran = run_program(folder, "respond step " + words);
        EXPECT_EQ(ran.status, status) << words << ran.err;
        EXPECT_TRUE(has(ran.err, what)) << ran.err;
    };
    expect_error("--afferent sa1 --temp 85", 2, "--temp 85: there is no netlist in this run; try --afferent sa1-circuit");
    expect_error("--afferent sa1 --probe vf -o out", 2, "--probe vf: there is no netlist or NIR graph in this run");
    expect_error("--afferent a.cir --probe mid", 2, "--probe mid needs --out DIR or --report");
    expect_error("--afferent a.cir,b.cir --supply 0.7V", 1, "--supply 0.7V: b.cir has no .param supply");
    expect_error("--afferent a.cir --corner ss", 1, "--corner ss: there is no corner 'ss': the netlist has no line .lib 'file' section");
    expect_error("--afferent sa1-circuit --corner slow", 1,
                 "--corner slow: no corner 'slow': library '../../process/tsmc180.lib' has tt, ss, ff, sf, fs, mc");
    expect_error("--afferent sa1-circut", 1, "unknown afferent 'sa1-circut'; did you mean 'sa1-circuit'?");
    expect_error("--afferent a.cir --probe mod -o out", 1,
                 "--probe mod: no netlist or NIR graph of this run has such a quantity; did you mean 'mid'?");
    expect_error("--afferent a.cir --set a.cir.div.rtp=2k", 1, "did you mean 'div.top'?");
    expect_error("--afferent a.cir --set c.cir.div.rtop=2k", 2, "nothing here is named 'c.cir.div'");
    expect_error("--afferent a.cir --mismatch half", 1, "--mismatch half: 'half' is not a seed");
    expect_error("--afferent a.cir --copies 3 --spread a.cir.temp=5%", 1, "unknown parameter 'temp'");
    EXPECT_TRUE(folder.file_names().size() == 2) << "no other file is left";
}

TEST(NetlistOverridesProgram, CopiesOfANetlistVaryItsParametersAndAreTheChipsOfASeed) {
    const TemporaryFolder folder;
    folder.write("a.cir", divider_text);
    const auto ran = run_program(folder, "respond step -a a.cir --copies 3 --spread a.cir.R_top=5% --probe 'i(rtop)' -o out --quiet");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto copies = read_file(folder / "out/copies.csv");
    EXPECT_EQ(copies.substr(0, 22), "afferent,channel,r_top");
    const auto first = copies.substr(copies.find("a.cir#1,step,") + 13), second = copies.substr(copies.find("a.cir#2,step,") + 13);
    const double r1 = std::stod(first), r2 = std::stod(second);
    EXPECT_NE(r1, r2);
    const auto probes = read_file(folder / "out/probes.csv");
    const auto row = probes.substr(probes.find('\n') + 1);
    double time = 0, force = 0, i1 = 0, i2 = 0;
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf", &time, &force, &i1, &i2), 4);
    const auto expected = [&](double r) { return (1 - force) / (r + 1e3); };  // the force, 1 mA/N, into 1 kohm
    EXPECT_NEAR(i1, expected(r1), 1e-8);
    EXPECT_NEAR(i2, expected(r2), 1e-8);
}

TEST(NetlistOverridesProgram, RunTakesTheSameOptionsAndSavesProbesInAddition) {
    const TemporaryFolder folder;
    folder.write("a.cir", std::string(divider_text) + ".op\n.expect v(mid) 0.5 1%\n");
    EXPECT_EQ(run_program(folder, "run a.cir").status, 0);
    const auto ran = run_program(folder, "run a.cir --supply 2V --set DIV.top=3k --probe 'vdd,i(div.rtop),mid' --json");
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(has(ran.err, "values of the netlist are overridden, so .expect is ignored")) << ran.err;
    const auto curves = Json::parse(ran.out)["plots"][0]["curves"];
    EXPECT_EQ(curves.size(), 3U);
    EXPECT_NEAR(curves["v(mid)"][0].get<double>(), 0.5, 1e-6);
    EXPECT_NEAR(curves["v(vdd)"][0].get<double>(), 2, 1e-9);
    EXPECT_NEAR(curves["i(xdiv.rtop)"][0].get<double>(), 0.5e-3, 1e-9);
    EXPECT_EQ(run_program(folder, "run a.cir --probe vdd").status, 0) << "without overrides its .expect lines still apply";
    EXPECT_EQ(run_program(folder, "run a.cir --set div.top").status, 2);
    EXPECT_TRUE(has(run_program(folder, "run a.cir --probe vd").err, "--probe vd: a.cir has no such node or device; did you mean 'vdd'?"));
    EXPECT_EQ(run_program(folder, "export sa1-circuit --for ngspice -o deck.cir").status, 0);
}

TEST(NetlistOverridesProgram, ListShowsTheParametersOfAChip) {
    const TemporaryFolder folder;
    const auto listed = Json::parse(run_program(folder, "list sa1-circuit --json").out)["afferents"][0];
    EXPECT_EQ(listed["name"], "sa1-circuit");
    EXPECT_EQ(listed["composition"], "netlist");
    const auto& all = listed["parameters"];
    const auto c_u = std::find_if(all.begin(), all.end(), [](const Json& p) { return p["name"] == "c_u"; });
    ASSERT_NE(c_u, all.end());
    EXPECT_EQ((*c_u)["default"], 5.4e-12);
    EXPECT_TRUE(has((*c_u)["description"], "as_printed"));
    EXPECT_TRUE((*c_u)["low"].is_null());
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const Json& p) { return p["name"] == "vtn_shift"; }), 0);
}

// The level of this comparator is crossed for about 20 us, and the force has a sample each 100 us.
constexpr const char* short_pulses = R"(relaxation
iin 0 m dc 0 force 1u
cm m 0 1n
bout out 0 v=1/(1+exp(-(v(m)-0.5)*100))
s1 m 0 m 0 sw
.model sw sw(vt=0.4 vh=0.3 ron=3k roff=1g)
.ic v(m)=0
.spike v(out) 0.9
.tran 1u 1 0 10u
.end
)";

TEST(RespondProgram, SpikesThatTheCurveOfTheReportDoesNotShowAreCounted) {
    const test::TemporaryFolder folder;
    folder.write("own.cir", short_pulses);
    const auto ran = test::run_program(folder, "respond press --afferent own.cir --report own.html");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto page = test::read_file(folder / "own.html");
    EXPECT_NE(page.find("do not show in the curve of v(out): their pulses are shorter than the time between its samples, 100 us"),
              std::string::npos);
    ASSERT_EQ(test::run_program(folder, "respond press --afferent sa1-circuit --report sa1.html").status, 0);
    EXPECT_EQ(test::read_file(folder / "sa1.html").find("do not show in the curve"), std::string::npos);
}

TEST(RespondProgram, ChipsThatCannotDifferAndFilesWithoutAPathAreNamed) {
    const test::TemporaryFolder folder;
    folder.write("own.cir", short_pulses);
    folder.write("noext", short_pulses);
    const auto equal = test::run_program(folder, "respond press --afferent own.cir --mismatch 3 --copies 3");
    EXPECT_EQ(equal.status, 0);
    EXPECT_NE(equal.err.find("warning: own.cir: all chips are equal, because nothing in the netlist varies"), std::string::npos)
        << equal.err;
    const auto unknown = test::run_program(folder, "respond press --afferent noext");
    EXPECT_EQ(unknown.err, "corpuscle: unknown afferent 'noext'; for the file noext write ./noext\n");
    EXPECT_EQ(test::run_program(folder, "respond press --afferent ./noext").status, 0);
}

}  // namespace
}  // namespace corpuscle
