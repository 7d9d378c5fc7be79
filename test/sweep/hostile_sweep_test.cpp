// Sweep and population files that request too much are refused, with the location, the limit and the remedy.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "support/program.hpp"
#include "support/support.hpp"
#include "sweep/spec/sweep_text.hpp"

namespace corpuscle {
namespace {

using test::run_program;
using test::TemporaryFolder;

std::string repeated(std::string_view text, int times) {
    std::string out;
    for (int k = 0; k < times; ++k) out += text;
    return out;
}

std::string refusal_of_text(const std::string& text) {
    const auto read = sweeps::read_sweep_text(text, "s.toml");
    return read ? "" : read.error().text();
}

TEST(HostileSweep, KeysAndValuesNestedTooDeepAreRefusedBeforeTheyAreParsed) {
    EXPECT_EQ(refusal_of_text("title = \"a\"\nset" + repeated(".a", 100'000) + " = 1\n"), "s.toml:2:68: keys are nested more than 32 deep");
    EXPECT_EQ(refusal_of_text("[set" + repeated(". a", 100'000) + "]\n"), "s.toml:1:101: keys are nested more than 32 deep");
    EXPECT_EQ(refusal_of_text("traces = " + repeated("[", 100'000)), "s.toml:1:74: lists and tables are nested more than 64 deep");
    EXPECT_EQ(refusal_of_text("set = " + repeated("{a=", 100'000)), "s.toml:1:199: lists and tables are nested more than 64 deep");
}

TEST(HostileSweep, DotsAndBracketsInTextsNumbersAndCommentsAreNotNesting) {
    const auto many = repeated(".", 200) + repeated("[", 200);
    std::string numbers = "traces = [";
    for (int k = 0; k < 500; ++k) numbers += fmt::format("{}{}.5", k ? ", " : "", k);
    EXPECT_EQ(refusal_of_text("title = \"" + many + "\"\nforce = \"\"\"" + many + "\n" + many + "\"\"\"\n" + numbers +
                              "]\n[[vary]]\nwhat = \"press.F_max\"\n"),
              "");
}

TEST(HostileSweep, ProgramsDoNotCrashOnSuchFiles) {
    const TemporaryFolder folder;
    folder.write("s.toml", "set" + repeated(".a", 100'000) + " = 1\n");
    EXPECT_EQ(run_program(folder, "sweep s.toml --out r.sqlite").status, 1);
    EXPECT_EQ(run_program(folder, "respond press --population s.toml").status, 1);
}

TEST(HostileSweep, ARateThatMakesTooManySamplesIsRefusedWithTheLimit) {
    const TemporaryFolder folder;
    folder.write("s.toml",
                 "afferent = \"sa1\"\nforce = \"press\"\nrate = \"1e9Hz\"\n[[vary]]\nwhat = \"sa1.f_B\"\nlist = [\"20Hz\", \"40Hz\"]\n");
    const auto ran = run_program(folder, "sweep s.toml --out r.sqlite");
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.err.find("more than 5e+07 samples at 1e+09 Hz"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("rate = \"10kHz\""), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace corpuscle
