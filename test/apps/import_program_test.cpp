// Recordings and spikes of other programs, in commands as a user types them.

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program;
using test::TemporaryFolder;

bool found_in(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(ImportProgram, EveryLoggerFileOfTheExamplesGivesTheSameSpikes) {
    const TemporaryFolder folder;
    std::filesystem::create_directory_symlink(test::source_root() + "/examples/data/loggers", folder / "loggers");
    const auto spikes_of = [&](const std::string& file) {
        const auto ran = run_program(folder, "respond loggers/" + file + " -o out");
        EXPECT_EQ(ran.status, 0) << file << '\n' << ran.err;
        std::string times;  // without the names of channels
        std::istringstream text(test::read_file(folder / "out/spikes.csv"));
        for (std::string line; std::getline(text, line);) times += line.substr(0, 3) + line.substr(line.rfind(',')) + "\n";
        return times;
    };
    const auto first = spikes_of("preamble.csv");
    EXPECT_GT(std::count(first.begin(), first.end(), '\n'), 5);
    for (const auto* file : {"excel.csv", "iso-time.csv", "unix-time.csv", "slash-units.csv", "unit-row.csv", "labview.lvm"})
        EXPECT_EQ(spikes_of(file), first) << file;
    EXPECT_TRUE(found_in(run_program(folder, "respond loggers/excel.csv --time 'Zeit [s]'").out, "200 samples at 100 Hz"));
}

TEST(ImportProgram, AScaleMayHaveAUnit) {
    const TemporaryFolder folder;
    folder.write("x.csv", "t_s,counts\n0,0\n0.5,1000\n1,2000\n");
    const auto plain = run_program(folder, "respond x.csv --scale 0.002"), unit = run_program(folder, "respond x.csv --scale 2mN");
    EXPECT_EQ(unit.status, 0) << unit.err;
    EXPECT_EQ(unit.out, plain.out);
    const auto wrong = run_program(folder, "respond x.csv --scale 2ms");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_TRUE(found_in(wrong.err, "0.002, or 2mN")) << wrong.err;
}

TEST(ImportProgram, StandardInputMayBeCompressedOrJson) {
    const TemporaryFolder folder;
    folder.write("x.csv", "time_s,fz_N\n0,1\n0.5,2\n1,3\n");
    folder.write("x.jsonl", "{\"t\":0,\"fz_N\":1}\n{\"t\":0.5,\"fz_N\":2}\n{\"t\":1,\"fz_N\":3}\n");
    ASSERT_EQ(std::system(("gzip -k '" + (folder / "x.csv") + "'").c_str()), 0);
    for (const std::string file : {"x.csv", "x.csv.gz", "x.jsonl"}) {
        const auto ran = run_program(folder, "respond - < " + file);
        EXPECT_TRUE(found_in(ran.out, "3 samples at 2 Hz")) << file << ran.out << ran.err;
        EXPECT_EQ(run_program(folder, "respond " + file).status, 0);
    }
    EXPECT_TRUE(found_in(run_program(folder, "respond x.csv.gz").out, "x: 3 samples"));
}

TEST(ImportProgram, TheOnlyTrainsOfTwoFilesAreComparedUnderAnyNames) {
    const TemporaryFolder folder;
    folder.write("ours.csv", "afferent,channel,time_s\nsa1,press,0.25\nsa1,press,0.5\n");
    folder.write("mine.txt", "2.5e-01\n5.0e-01\n");
    folder.write("phy.csv", "times,cluster\n0.25,7\n0.5,7\n");
    for (const std::string file : {"mine.txt", "phy.csv"}) {
        const auto ran = run_program(folder, "compare " + file + " ours.csv --json");
        EXPECT_EQ(ran.status, 0) << ran.err;
        EXPECT_TRUE(found_in(ran.out, "\"matched\": 2")) << ran.out;
    }
    EXPECT_EQ(run_program(folder, "compare phy.csv ours.csv --time times --train cluster").status, 0);
}

TEST(ImportProgram, AMatchingWindowOfSecondsCausesAWarning) {
    const TemporaryFolder folder;
    folder.write("a.csv", "0.25\n");
    EXPECT_TRUE(found_in(run_program(folder, "compare a.csv a.csv --window 5").err,
                         "--window 5 matches spikes up to 5 s apart; for milliseconds write --window 5ms"));
    EXPECT_EQ(run_program(folder, "compare a.csv a.csv --window 0.5").err, "");
    EXPECT_EQ(run_program(folder, "compare a.csv a.csv --window 5ms").err, "");
}

TEST(ImportProgram, SkipIsRefusedForAStimulus) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond press --skip 3");
    EXPECT_EQ(ran.status, 2);
    EXPECT_TRUE(found_in(ran.err, "--skip is for recordings, but press is a stimulus")) << ran.err;
}

}  // namespace
}  // namespace corpuscle
