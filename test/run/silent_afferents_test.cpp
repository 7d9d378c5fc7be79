// Warnings for afferents that never fire, or fire faster than a nerve can: the numbers in them are right, and the remedies work as typed.

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <regex>

#include "run/firing_factor.hpp"
#include "run/summary/silent_afferents.hpp"
#include "support/program.hpp"
#include "support/sanitized.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::read_file, test::run_program;

constexpr const char* skin_patch = R"(
unit = "mm"
[sites]
pitch = 1
[[region]]
name = "a"
shapes = [{capsule = [[0, 0], [0, 20]], width = 16}]
[[class]]
afferent = "sa1"
density = "70 /cm2"
sigma = "0.8 mm"
)";

/// The text that the first group of a regular expression matches, or "".
std::string first_group(const std::string& text, const std::string& expression) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(expression)) ? match[1].str() : "";
}

std::int64_t spikes_of(const test::ProgramResult& ran) { return nlohmann::json::parse(ran.out)["work"]["spikes"].get<std::int64_t>(); }

TEST(SilenceDetector, TheFactorIsTheSmallestThatMakesAnAfferentFire) {
    const auto press = test::force("press", {.settings = {"press.F_max=300mN"}, .rate = 1e3});
    const auto factor = factor_to_fire(*plan_afferent("sa1"), {1e-3}, press);
    ASSERT_TRUE(factor);
    const auto fires = [&](double times) {
        auto force = press;
        for (auto& f : force) f *= times;
        return !test::spikes(*test::afferent("sa1", {.rate = 1e3}), force).empty();
    };
    EXPECT_FALSE(fires(1));
    EXPECT_TRUE(fires(*factor));
    EXPECT_FALSE(fires(*factor / 1.03));
}

TEST(SilenceDetector, NumbersOfARemedyAreRoundedUpToTwoDigits) {
    EXPECT_EQ(format_rounded_up(2.301), "2.4");
    EXPECT_EQ(format_rounded_up(2.4), "2.4");
    EXPECT_EQ(format_rounded_up(0.00211), "0.0022");
    EXPECT_EQ(format_rounded_up(99.5), "100");
}

TEST(SilenceDetector, AWarningGivesTheForceAtWhichAnAfferentFires) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond ramp-hold --rate 1kHz --json");
    const auto force_N =
        first_group(ran.err, "fa1 never fired: the largest force was 1 N; it would fire at about ([0-9.]+) times this force");
    ASSERT_FALSE(force_N.empty()) << ran.err;
    const auto document = nlohmann::json::parse(ran.out);
    ASSERT_EQ(document["silent"].size(), 1U);
    EXPECT_EQ(document["silent"][0]["afferent"], "fa1");
    const auto more = run_program(folder, "respond ramp-hold --rate 1kHz --afferent fa1 --json --set ramp-hold.F_max=" + force_N + "N");
    EXPECT_GT(spikes_of(more), 0) << more.err;
    EXPECT_EQ(more.err.find("never fired"), std::string::npos);
}

TEST(SilenceDetector, AGridUnderAnIndenterIsTreatedAsSkinWithAWarning) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond press --population 'grid 8x8' --json");
    EXPECT_EQ(ran.status, 0);
    EXPECT_GT(spikes_of(ran), 200) << ran.err;
    EXPECT_NE(
        ran.err.find(
            "the force on grid 8x8 is spread over its sites, so each site represents 4 mm2 of skin; an afferent responds to the force "
            "on 1 cm2"),
        std::string::npos)
        << ran.err;
}

TEST(SilenceDetector, RegionsWithoutFeltAreaGetThatOfTheHandUnderAnIndenterWithANote) {
    const TemporaryFolder folder;
    folder.write("own.toml", skin_patch);
    const auto ran = run_program(folder, "respond press --population own.toml --json");
    EXPECT_NE(ran.err.find("own has no felt_area; an afferent responds to the force on 1 cm2 of it, as in hand"), std::string::npos)
        << ran.err;
    folder.write("own.toml", std::string("felt_area = \"1 cm2\"\n") + skin_patch);
    const auto stated = run_program(folder, "respond press --population own.toml --json");
    EXPECT_EQ(stated.err.find("felt_area"), std::string::npos) << stated.err;
    EXPECT_GT(spikes_of(ran), 0);
    EXPECT_EQ(spikes_of(ran), spikes_of(stated));
}

TEST(SilenceDetector, ATouchThatIsTooWeakGetsASettingThatWorks) {
    const TemporaryFolder folder;
    folder.write("own.toml", std::string("felt_area = \"1 cm2\"\n") + skin_patch);
    const auto weak = run_program(folder, "respond press --population own.toml --set press.F_max=300mN --json");
    EXPECT_EQ(spikes_of(weak), 0);
    const auto setting = first_group(weak.err, "try (--set press.F_max=[0-9.]+N)");
    ASSERT_FALSE(setting.empty()) << weak.err;
    EXPECT_GT(spikes_of(run_program(folder, "respond press --population own.toml --json " + setting)), 0);

    std::string recording = "time_s,f_mN\n";
    for (int k = 0; k < 1000; ++k) recording += fmt::format("{:.3f},{}\n", k / 1000.0, k > 300 && k < 700 ? 200 : 0);
    folder.write("touch.csv", recording);
    const auto recorded = run_program(folder, "respond touch.csv --population own.toml --json");
    EXPECT_EQ(spikes_of(recorded), 0);
    const auto scale = first_group(recorded.err, "try (--scale [0-9.]+)");
    ASSERT_FALSE(scale.empty()) << recorded.err;
    EXPECT_GT(spikes_of(run_program(folder, "respond touch.csv --population own.toml --json " + scale)), 0);
}

TEST(SilenceDetector, AnAfferentOfTheThesisSuggestsTheOneCalibratedToNervesIfThereIsOne) {
    const TemporaryFolder folder;
    const bool exists = static_cast<bool>(plan_afferent("fa1-nerve"));
    const std::string weak = "respond sine --set sine.F_amp=10mN --set sine.F_mean=10mN";
    const auto silent = run_program(folder, weak + " --afferent fa1");
    ASSERT_NE(silent.err.find("fa1 never fired"), std::string::npos) << silent.err;
    EXPECT_EQ(silent.err.find("try fa1-nerve") != std::string::npos, exists) << silent.err;
    EXPECT_EQ(run_program(folder, weak + " --afferent fa1a+lif-b").err.find("-nerve"), std::string::npos);
}

TEST(SilenceDetector, AnIndenterBesideTheSkinGetsTheRemedyToMoveIt) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond press --population fingertip --set contact.x=1m --set contact.y=1m --quiet");
    EXPECT_NE(ran.err.find("received no force"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("--set contact.x="), std::string::npos) << ran.err;
}

TEST(NerveLimit, RatesAboveAKilohertzCauseAWarningAndItsRemedyWorks) {
    const TemporaryFolder folder;
    const std::string strong = "respond press --afferent sa1 --set press.F_max=200N --rate 20kHz --quiet";
    const auto fast = run_program(folder, strong);
    EXPECT_NE(fast.err.find("sa1: on press spikes come at up to "), std::string::npos) << fast.err;
    EXPECT_NE(fast.err.find("--set sa1.t_ref=1ms"), std::string::npos) << fast.err;
    EXPECT_EQ(run_program(folder, strong + " --set sa1.t_ref=1ms").err.find("spikes come at up to"), std::string::npos);
    EXPECT_EQ(run_program(folder, "respond press --quiet").err, "") << "the thesis's press needs no warning";
    const auto skin = run_program(
        folder, "respond press --population " + test::source_root() + "/test/skin/thesis_fingertip.toml --set press.F_max=900N --quiet");
    EXPECT_NE(skin.err.find("of 290 sa1 afferents: several spikes come within one sample of 1 ms, which is not a rate"), std::string::npos)
        << skin.err;
}

TEST(Rates, OfTwoSpikesWithinASampleAreBlankWithAWarning) {
    const TemporaryFolder folder;
    const auto ran = run_program(folder, "respond press --afferent sa1 --set press.F_max=900N --rate 1kHz --json");
    EXPECT_NE(ran.err.find("sa1: on press several spikes come within one sample of 1 ms, which is not a rate"), std::string::npos)
        << ran.err;
    int blank = 0;
    const auto rows = nlohmann::json::parse(ran.out)["rates"];
    for (const auto& row : rows)
        for (const auto* rate : {"mean_rate_Hz", "peak_rate_Hz", "first_rate_Hz", "last_rate_Hz"}) {
            blank += row[rate].is_null() && row["spikes"] > 2;
            EXPECT_TRUE(row[rate].is_null() || row[rate] <= 1001.0) << row;
        }
    EXPECT_GT(blank, 0);
}

TEST(NerveLimit, ARefractoryAfferentUnderSlowSamplesAsksForFasterOnes) {
    const TemporaryFolder folder;
    const auto slow = run_program(folder, "respond press --afferent fa1-nerve --rate 20Hz --quiet");
    EXPECT_NE(slow.err.find("several spikes come within one sample of 50 ms, so their rates are left out; record at 1 kHz or more"),
              std::string::npos)
        << slow.err;
    EXPECT_EQ(slow.err.find("check the force's unit"), std::string::npos) << slow.err;
}

TEST(Rates, OfASingleSpikeAreBlank) {
    const TemporaryFolder folder;
    const auto rates = nlohmann::json::parse(run_program(folder, "respond press --afferent sa1 --json").out)["rates"];
    const auto& retraction = rates[3];
    ASSERT_EQ(retraction["spikes"], 1);
    EXPECT_TRUE(retraction["mean_rate_Hz"].is_null());
    EXPECT_TRUE(retraction["peak_rate_Hz"].is_null());
    EXPECT_EQ(rates[0]["mean_rate_Hz"], 0.0) << "no spike in the rest";
    const auto table = run_program(folder, "respond press --afferent sa1").out;
    EXPECT_TRUE(std::regex_search(table, std::regex("retraction +1 +- +- +- +-"))) << table;
    const auto skin = nlohmann::json::parse(
        run_program(folder, "respond press --population 'grid 3x3' --contact sphere --set press.F_max=900mN --json").out);
    int single = 0;
    for (const auto& row : skin["rates"])
        if (row["spikes"] == 1) {
            ++single;
            EXPECT_TRUE(row["max_rate_Hz"].is_null() && row["rate_of_active_Hz"].is_null() && row["rate_while_touched_Hz"].is_null())
                << row;
        }
    EXPECT_GT(single, 0) << skin["rates"];
}

TEST(Bins, ShorterThanAHundredthOfASampleAreRefusedWithTheSmallestThatWorks) {
    const TemporaryFolder folder;
    for (const char* population : {"", "--population fingertip"}) {
        const auto refused = run_program(folder, fmt::format("respond press --rate 1kHz {} --bin 1ns -o out", population));
        EXPECT_EQ(refused.status, 2);
        EXPECT_NE(refused.err.find("--bin 1 ns: shorter than a hundredth of the 1 ms between samples; write 10 us or more"),
                  std::string::npos)
            << refused.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out"));
        EXPECT_EQ(
            run_program(folder, fmt::format("respond press --rate 1kHz --set press.t_hold=10ms {} --bin 10us -o out --quiet", population))
                .status,
            0);
        std::filesystem::remove_all(folder / "out");
    }
}

TEST(SkinMemory, AGridThatDoesNotFitIsRefusedWithTheMemoryItNeeds) {
    if (test::is_sanitized) GTEST_SKIP() << "sanitizers need more address space than this limit";
    const TemporaryFolder folder;
    const auto error_file = folder / "error.txt";
    const auto command = "ulimit -v 3000000; cd '" + folder.path() + "'; '" + test::program_path() +
                         "' respond press --population 'grid 2048x2048' 2>'" + error_file + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    EXPECT_NE(read_file(error_file).find("grid 2048x2048: 4194304 sites and 8388608 afferents need about 2"), std::string::npos)
        << read_file(error_file);
    EXPECT_NE(read_file(error_file).find("GB of memory, but only 3.07 GB are available"), std::string::npos) << read_file(error_file);
}

}  // namespace
}  // namespace corpuscle
