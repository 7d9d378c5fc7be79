// --help, --help-all, suggestions for misspelt options, and renamed options.

#include <fmt/format.h>
#include <algorithm>

#include "cli/arguments/renamed_arguments.hpp"
#include "support/program.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder;

TEST(Help, OfEachVerbIsPrintedByTheHelpVerbAndByTheHelpOption) {
    const TemporaryFolder folder;
    for (const std::string verb : {"respond", "compare", "study", "run", "export", "sweep", "optimize", "fit", "stream", "list"}) {
        const auto help = run_program(folder, "help " + verb), option = run_program(folder, verb + " --help");
        EXPECT_EQ(help.status, 0) << verb;
        EXPECT_EQ(help.out, option.out) << verb;
        EXPECT_TRUE(help.err.empty()) << help.err;
    }
    EXPECT_NE(run_program(folder, "").out.find("First steps:"), std::string::npos);
}

/// The number of example commands in a help text.
std::ptrdiff_t examples_in(const std::string& help) {
    std::ptrdiff_t count = 0;
    const auto end = std::min(help.find("\nPositionals:"), help.find("\nOptions:"));
    for (auto at = help.find("\n  "); at < end; at = help.find("\n  ", at + 1))
        if (help[at + 3] != ' ' && help.substr(at, help.find('\n', at + 1) - at).find("corpuscle ") != help.npos) ++count;
    return count;
}

TEST(Help, IsShortAndHelpAllIsComplete) {
    const TemporaryFolder folder;
    for (const std::string verb : {"respond", "stream"}) {
        const auto some = run_program(folder, verb + " --help").out, all = run_program(folder, verb + " --help-all").out;
        EXPECT_EQ(examples_in(some), 3) << some;
        EXPECT_GT(examples_in(all), 6) << all;
        EXPECT_LT(std::count(some.begin(), some.end(), '\n'), 70) << some;
        EXPECT_NE(some.find("corpuscle " + verb + " --help-all"), std::string::npos) << some;
        for (const auto* option : {"--notch", "--despike", "--overwrite"}) {
            EXPECT_EQ(some.find(option), std::string::npos) << option;
            EXPECT_NE(all.find(option), std::string::npos) << option;
        }
        for (const auto* option : {"--rate", "--population", "--out", "--json"}) EXPECT_NE(some.find(option), std::string::npos) << option;
        for (std::size_t at = 0; at < all.size(); at = all.find('\n', at) + 1)
            EXPECT_LE(all.find('\n', at) - at, 102U) << all.substr(at, 110);
    }
    for (const std::string verb : {"compare", "run", "sweep", "list"})
        EXPECT_LE(examples_in(run_program(folder, verb + " --help").out), 3) << verb;
}

TEST(Help, SuggestsTheNearestOption) {
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> rows[] = {
        {"respond press --rat 1kHz", "corpuscle: respond: unknown option '--rat'; did you mean '--rate'?\n"},
        {"stream --chanels=3", "corpuscle: stream: unknown option '--chanels'; did you mean '--channels'?\n"},
        {"sweep show x.sqlite --quantil 0.5", "corpuscle: sweep show: unknown option '--quantil'; did you mean '--quantile'?\n"},
        {"list --jason", "corpuscle: list: unknown option '--jason'; did you mean '--json'?\n"},
        {"run a.cir --crner ss", "corpuscle: run: unknown option '--crner'; did you mean '--corner'?\n"}};
    for (const auto& [arguments, error] : rows) {
        const auto ran = run_program(folder, arguments);
        EXPECT_EQ(ran.status, 2) << arguments;
        EXPECT_EQ(ran.err, error);
    }
}

TEST(RenamedArguments, AreRefusedWithTheNewSpelling) {
    const TemporaryFolder folder;
    for (const auto& r : renamed_arguments) {
        const auto ran = run_program(folder, fmt::format("{} {}", r.verb, r.old_text));
        EXPECT_EQ(ran.status, 2) << r.old_text;
        EXPECT_EQ(ran.err, fmt::format("corpuscle: {}: {} is now {}\n", r.verb, r.old_text, r.new_text));
    }
    EXPECT_EQ(run_program(folder, "stream --limit=2N").err, "corpuscle: stream: --limit is now --max-force\n");
    EXPECT_EQ(run_program(folder, "stream --stamp=count").err, "corpuscle: stream: --stamp count is now --stamp sequence\n");
    std::string help;
    for (const std::string verb : {"respond", "run", "compare", "stream", "sweep", "sweep calibrate"})
        help += run_program(folder, verb + " --help-all").out;
    for (const auto& r : renamed_arguments) {
        if (r.verb == "list") continue;
        EXPECT_NE(help.find(std::string(r.new_text.substr(0, r.new_text.find(' ')))), std::string::npos) << r.new_text;
    }
}

}  // namespace
}  // namespace corpuscle
