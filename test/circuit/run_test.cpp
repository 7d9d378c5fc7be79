// The verb `corpuscle run`, and every netlist of circuits/ with its .expect lines.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/raw_file.hpp"

namespace corpuscle::circuit::test {
using namespace corpuscle::test;
namespace {

constexpr const char* divider = "divider\nv1 in 0 3\nr1 in out 1k\nr2 out 0 {r}\n.param r=2k\n.op\n";

TEST(Run, PrintsResultsAndMeasurementsAsNamesAndValues) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\nv1 in 0 0\nr1 in out 1k\nr2 out 0 3k\n.dc v1 0 4 1\n.meas dc at2 find v(out) at=2\n.print dc v(out) i(v1)\n");
    const auto ran = run_program(folder, "run x.cir");
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("at2                  = 1.500000e+00"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("v(out)"), std::string::npos);
    EXPECT_NE(ran.out.find("3.0000000e+00"), std::string::npos) << ran.out;
}

TEST(Run, WritesBinaryAndAsciiRawFilesWithTheSameContents) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\nv1 in 0 ac 1\nr1 in out 1k\nc1 out 0 1u\n.ac dec 5 10 10k\n.op\n");
    EXPECT_EQ(run_program(folder, "run x.cir -o a.raw").status, 0);
    EXPECT_EQ(run_program(folder, "run x.cir -o b.raw --ascii").status, 0);
    EXPECT_EQ(run_program(folder, "run x.cir -o c.csv").status, 0);
    const auto a = read_raw(read_file(folder / "a.raw")), b = read_raw(read_file(folder / "b.raw"));
    ASSERT_EQ(a.size(), 2U);
    ASSERT_EQ(b.size(), 2U);
    for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t c = 0; c < a[p].curves.size(); ++c)
            for (std::size_t k = 0; k < a[p].point_count(); ++k)
                EXPECT_LE(std::abs(a[p].curves[c].values[k] - b[p].curves[c].values[k]), 1e-15 * std::abs(a[p].curves[c].values[k]));
    EXPECT_TRUE(read_file(folder / "c-1.csv").starts_with("frequency,v(in).re,v(in).im,v(out).re"));
    EXPECT_TRUE(read_file(folder / "c-2.csv").starts_with("v(in),v(out),i(v1)"));
    folder.write("y.cir", "t\nv1 in 0 ac 1\nr1 in 0 1k\nr2 in b 1k\nr3 b 0 1k\n.ac dec 5 10 10k\n.print ac v(in,b)\n");
    EXPECT_EQ(run_program(folder, "run y.cir -o d.csv").status, 0);
    EXPECT_EQ(read_file(folder / "d.csv").find("\"v(in,b)\"."), std::string::npos) << "text after the closing quote is not CSV";
}

TEST(Run, JsonOutputIsOneDocumentAndReproducible) {
    const TemporaryFolder folder;
    folder.write("x.cir", divider);
    const auto ran = run_program(folder, "run x.cir --json");
    const auto document = nlohmann::json::parse(ran.out);
    EXPECT_DOUBLE_EQ(document["plots"][0]["curves"]["v(out)"][0].get<double>(), 2.0);
    EXPECT_EQ(ran.out, run_program(folder, "run x.cir --json").out);
}

TEST(Run, StepsThroughAParameter) {
    const TemporaryFolder folder;
    folder.write("x.cir", std::string(divider) + ".step param r list 1k 2k\n");
    const auto document = nlohmann::json::parse(run_program(folder, "run x.cir --json").out);
    ASSERT_EQ(document.size(), 2U);
    EXPECT_EQ(document[0]["step"], "r=1000");
    EXPECT_DOUBLE_EQ(document[0]["plots"][0]["curves"]["v(out)"][0].get<double>(), 1.5);
}

TEST(Run, MeasuresAtTheLastPointOfASweep) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\nif 0 a 0\nr1 a 0 1\n.dc if 0.2u 2.6u 5n\n.meas dc end find v(a) at=2.6u\n.expect end 2.6u 1e-9\n");
    folder.write("y.cir", "t\nif 0 a 0\nr1 a 0 1\n.dc if 3 3 1\n.meas dc end find v(a) at=3\n.expect end 3 1e-9\n");
    EXPECT_EQ(run_program(folder, "run x.cir").status, 0);
    EXPECT_EQ(run_program(folder, "run y.cir").status, 0);
}

TEST(Run, ANodeThatAnExpressionReadsIsNotDangling) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\nv1 a 0 1\nb1 c 0 v=2*v(a)\nr1 c 0 1\n.op\n");
    EXPECT_EQ(run_program(folder, "run x.cir").err, "");
}

TEST(Run, TablesOfManyStepsHaveTheStepInEachRow) {
    const TemporaryFolder folder;
    folder.write("x.cir", std::string(divider) + ".dc v1 0 1 1\n.step param r list 1k 3k\n");
    EXPECT_EQ(run_program(folder, "run x.cir -o x.csv").status, 0);
    EXPECT_EQ(read_file(folder / "x-2.csv"),
              "step,v-sweep,v(in),v(out),i(v1)\nr=1000,0,0,0,0\nr=1000,1,1,0.5,-0.0005\nr=3000,0,0,0,0\nr=3000,1,1,0.75,-0.00025\n");
    EXPECT_TRUE(read_file(folder / "x-1.csv").starts_with("step,v(in),v(out),i(v1)\nr=1000,3,1.5,-0.0015\n"));
}

TEST(Run, SavesTheRequestedCurves) {
    const TemporaryFolder folder;
    folder.write("x.cir", std::string(divider) + ".save v(in,out) out\n.dc v1 0 1 1\n");
    folder.write("y.cir", std::string(divider) + ".save v(oot)\n");
    EXPECT_EQ(run_program(folder, "run x.cir -o x.csv").status, 0);
    EXPECT_TRUE(read_file(folder / "x-2.csv").starts_with("v-sweep,\"v(in,out)\",v(out)\n")) << read_file(folder / "x-2.csv");
    const auto wrong = run_program(folder, "run y.cir");
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("y.cir:7:7: .save: unknown output v(oot); did you mean 'v(out)'?"), std::string::npos) << wrong.err;
}

constexpr const char* chips =
    "chips\nv1 v 0 0.7\nr1 v a 1meg\nm1 a a 0 0 n w=1u l=1u\n.model n nmos(level=80 avt=3e-9 svt0=10m)\n.op\n.meas op va find v(a)\n.mc 40 "
    "seed=2\n";

TEST(Run, AMonteCarloRunEndsWithMeanAndStandardDeviation) {
    const TemporaryFolder folder;
    folder.write("x.cir", chips);
    const auto ran = run_program(folder, "run x.cir");
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("mc=40:"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("va                   mean "), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("n = 40\n"), std::string::npos) << ran.out;
}

TEST(Run, AStepThatDoesNotConvergeIsReportedAndTheOthersContinue) {
    const TemporaryFolder folder;
    folder.write("x.cir", "t\n.param a=1\ni1 0 x 1\nb1 x 0 i={a}*(v(x)*v(x)+0.5)\n.op\n.step param a list 1 4 1\n");
    const auto ran = run_program(folder, "run x.cir --json");
    EXPECT_EQ(ran.status, 3) << ran.out << ran.err;
    const auto document = nlohmann::json::parse(ran.out);
    ASSERT_EQ(document.size(), 3U);
    EXPECT_NE(document[1]["error"].get<std::string>().find("no operating point"), std::string::npos);
    EXPECT_NEAR(document[2]["plots"][0]["curves"]["v(x)"][0].get<double>(), std::sqrt(0.5), 1e-6);
    EXPECT_NE(ran.err.find("1 of 3 did not converge"), std::string::npos) << ran.err;
}

TEST(Run, ImpossibleTemperaturesAndAreasAreRefused) {
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"r1 a 0 1k\n.temp -300", "x.cir: the circuit's temperature of -300 C is outside (-273.15, 1000]"},
        {"r1 a 0 1k temp=-274", "x.cir:3:1: r1: its temperature of -274 C is outside"},
        {"r1 a 0 1k dtemp=2000", "x.cir:3:1: r1: its temperature of 2027 C is outside"},
        {"r1 a 0 1k\n.dc temp -300 0 100", "temperature of -300 C is outside"},
        {"d1 a 0 dm -1\n.model dm d", "x.cir:3:1: d1: area = -1 must be positive"},
        {"d1 a 0 dm\n.model dm d cj0=-1p", "dm: cjo = -1e-12"},
    };
    for (const auto& [lines, message] : cases) {
        folder.write("x.cir", std::string("t\nv1 a 0 1\n") + lines + "\n.op\n");
        const auto ran = run_program(folder, "run x.cir");
        EXPECT_EQ(ran.status, 1) << lines;
        EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    }
}

TEST(Run, LinesOfTenMegabytesAreReadOrRejected) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& line, const std::string& why) {
        folder.write("x.cir", "t\nv1 a 0 1\n" + line + "\n.op\n");
        const auto ran = run_program(folder, "run x.cir");
        EXPECT_EQ(ran.status, 1);
        EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err.substr(0, 300);
        EXPECT_LT(ran.err.size(), 1000U);
    };
    const std::size_t many = 10'000'000;
    std::string sum = "b1 b 0 v=v(a)", nodes = "x1", wave = "v2 b 0 pwl(";
    while (sum.size() < many) sum += "+v(a)";
    while (nodes.size() < many) nodes += " node" + std::to_string(nodes.size());
    for (int k = 0; wave.size() < many; ++k) wave += fmt::format("{:08d} 1 ", k);
    refused("r1 a 0 " + std::string(many, '1'), "x.cir:3:8: '1111");
    refused("r1 a 0 " + std::string(many, '('), "x.cir:3:");
    refused("b1 b 0 v=" + std::string(many, '(') + "1" + std::string(many, ')'), "nested deeper than");
    refused(sum, "the expression has more than");
    refused(nodes + " sub", "unknown subcircuit 'sub'");
    folder.write("x.cir", "t\nv1 a 0 1\nr1 a 0 1\n* " + std::string(many, 'x') + "\n" + wave + ")\nr2 b 0 1\n.op\n");
    EXPECT_EQ(run_program(folder, "run x.cir").status, 0);
}

TEST(Run, TheExitStatusReportsTheFailure) {
    const TemporaryFolder folder;
    folder.write("bad.cir", "t\nv1 a 0 1\nr1 a 0 1k\nr2 a\n.op\n");
    folder.write("wrong.cir", std::string(divider) + ".expect v(out) 1 1%\n");
    const auto bad = run_program(folder, "run bad.cir -o x.raw"), wrong = run_program(folder, "run wrong.cir"),
               none = run_program(folder, "run none.cir");
    EXPECT_EQ(bad.status, 1);
    EXPECT_NE(bad.err.find("bad.cir:4"), std::string::npos) << bad.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.raw"));
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("wrong.cir:7"), std::string::npos) << wrong.err;
    EXPECT_NE(wrong.out.find("does not hold"), std::string::npos);
    EXPECT_EQ(none.status, 1);
    EXPECT_NE(none.err.find("none.cir"), std::string::npos);
    EXPECT_EQ(run_program(folder, "run").status, 2);
}

TEST(Circuits, MeetTheirExpectations) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_root() + "/circuits")) {
        if (entry.path().extension() != ".cir") continue;
        const TemporaryFolder folder;
        const auto ran = run_program(folder, fmt::format("run '{}' --json", entry.path().string()));
        EXPECT_EQ(ran.status, 0) << entry.path() << "\n" << ran.err;
        if (ran.status != 0) continue;
        EXPECT_FALSE(nlohmann::json::parse(ran.out)["expectations"].empty()) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 2);
}

}  // namespace
}  // namespace corpuscle::circuit::test
