// Responses, notes, warnings and report pages of the public interface.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "corpuscle.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::json;

/// The text of the error that a call throws; "" if it throws none.
template <class Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(RespondInterface, HasTheWarningsAndNotesOfTheCommandLine) {
    const auto fast = respond_to("press", {.afferents = {"sa1"}, .settings = {"press.F_max=1kN"}});
    ASSERT_EQ(fast.warnings.size(), 1U);
    EXPECT_NE(fast.warnings[0].find("a nerve fibre fires at no more than about 1 kHz"), std::string::npos);
    EXPECT_EQ(Json::parse(fast.summary())["warnings"][0], fast.warnings[0]);
    const auto silent = respond_to("press", {.settings = {"press.F_min=0", "press.F_max=1mN"}});
    EXPECT_TRUE(silent.warnings.empty());
    ASSERT_EQ(silent.silence_notes().size(), 2U);
    EXPECT_TRUE(silent.silence_notes()[1].starts_with("fa1 never fired: the largest force was 0.001 N; it would fire at about "));
    EXPECT_EQ(Json::parse(silent.summary())["silent"].size(), 2U);
    const auto skin = respond_to("press", {.population = "grid 3x3", .settings = {"press.F_min=0", "press.F_max=1mN"}});
    ASSERT_EQ(skin.warnings.size(), 1U);
    EXPECT_TRUE(skin.warnings[0].starts_with("no afferent fired: "));
}

TEST(RespondInterface, OptionsOfARecordingAreThoseOfTheCommandLine) {
    const test::TemporaryFolder folder;
    const auto path = folder.write("x.csv", "1,2,3,4\n5,6,7,8\n");
    const auto channels = [&](const Options& options) { return read_recording(path, options).channels.size(); };
    EXPECT_EQ(channels({{"rate", "1kHz"}, {"transpose", "true"}}), 2U);
    EXPECT_EQ(channels({{"rate", "1kHz"}, {"no-transpose", "true"}}), 4U);
    EXPECT_EQ(error_of([&] { channels({{"rate", "1kHz"}, {"transpose", "true"}, {"no-transpose", "true"}}); }),
              "transpose and no-transpose exclude each other; give one of them");
    EXPECT_EQ(error_of([&] { channels({{"rate", "1kHz"}, {"rate", "2kHz"}}); }), "rate is given twice; give it once");
}

TEST(RespondInterface, ASkinUnderATouchByNameHasItsTotalForce) {
    const auto scan = respond_to("scan", {.population = "fingertip"}, 500);
    ASSERT_TRUE(scan.skin_force);
    EXPECT_EQ(scan.skin_force->name, "scan");
    EXPECT_EQ(scan.skin_force->channels, std::vector<std::string>{"scan"});
    EXPECT_EQ(scan.skin_force->rate, 500);
    ASSERT_EQ(scan.skin_force->samples.size(), 1U);
    const auto& force = scan.skin_force->samples[0];
    EXPECT_EQ(static_cast<double>(force.size()), scan.duration * 500);
    EXPECT_NEAR(*std::max_element(force.begin(), force.end()), 2, 1e-9);  // of `corpuscle list contact`
    EXPECT_FALSE(respond(stimulus("press", {}, 1000), {.population = "grid 2x2"}).skin_force) << "the caller has it";
    EXPECT_FALSE(respond_to("press").skin_force) << "afferents on channels";
}

TEST(RespondInterface, CopiesAreInTheSummaryAndSpreadsNeedThem) {
    const auto made = respond_to("press", {.afferents = {"sa1"}, .copies = 3, .spreads = {"sa1.f_B=10%"}});
    EXPECT_EQ(Json::parse(made.summary())["copies"]["per_afferent"], 3);
    EXPECT_NE(error_of([] { respond_to("press", {.spreads = {"sa1.f_B=10%"}}); }).find("needs --copies N"), std::string::npos);
    EXPECT_NE(error_of([] { respond_to("press", {.copies = 4'000'000'000}); }).find("the largest number is 1000000"), std::string::npos);
    EXPECT_EQ(error_of([] { respond_to("press", {.afferents = {"sa1", "sa1"}}); }), "--afferent sa1: sa1 is given twice");
}

TEST(RespondInterface, AReportIsMadeOnRequestAndDoesNotChangeTheSpikes) {
    for (const std::string population : {"", "grid 3x3"}) {
        Simulation simulation{.population = population};
        const auto plain = respond_to("press", simulation);
        EXPECT_FALSE(plain.report);
        for (const auto detail : {ReportDetail::brief, ReportDetail::complete}) {
            simulation.report = detail;
            const auto reported = respond_to("press", simulation);
            EXPECT_EQ(reported.times, plain.times);
            const auto page = reported.report("my command");
            EXPECT_NE(page.find(R"("command":"my command")"), std::string::npos);
            EXPECT_LT(page.size(), 2'000'000U);
        }
    }
}

TEST(RespondInterface, AReportReplacesOnlyReports) {
    const test::TemporaryFolder folder;
    const auto page = respond_to("press", {.report = ReportDetail::brief}).report("");
    write_report(folder / "page.html", page);
    write_report(folder / "page.html", page);
    EXPECT_EQ(test::read_file(folder / "page.html"), page);
    folder.write("own.html", "<p>mine</p>");
    EXPECT_NE(error_of([&] { write_report(folder / "own.html", page); }).find("own.html"), std::string::npos);
    EXPECT_EQ(test::read_file(folder / "own.html"), "<p>mine</p>");
    EXPECT_NE(error_of([&] { check_report(folder / "page.pdf"); }).find("the name must end in .html, such as "), std::string::npos);
    EXPECT_NE(error_of([&] { check_report(""); }), "");
    EXPECT_NE(error_of([&] { check_report(std::string("a\0b.html", 8)); }), "");
}

TEST(RespondInterface, AForceKeepsItsOriginUnlessItsChannelsChange) {
    auto force = stimulus("press", {"press.F_max=2N"});
    const auto named = Json::parse(respond_to("press", {.settings = {"press.F_max=2N"}}).summary());
    EXPECT_EQ(Json::parse(respond(force).summary()), named);
    force.origin = load_origin(save_origin(*force.origin));
    EXPECT_EQ(Json::parse(respond(force).summary()), named);
    force.samples.push_back(force.samples[0]), force.channels.push_back("second");
    const auto changed = Json::parse(respond(force).summary());
    EXPECT_TRUE(changed["inputs"][0]["phases"].empty());
    EXPECT_NE(error_of([] { load_origin("{}"); }), "");
    EXPECT_NE(error_of([] { load_origin("not JSON"); }), "");
}

}  // namespace
}  // namespace corpuscle
