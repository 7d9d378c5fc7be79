#include "run/run_inputs.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/recording/recording.hpp"
#include "report/envelope.hpp"
#include "report/respond/respond_report.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/summary/run_summary.hpp"
#include "support/property.hpp"
#include "support/sinks.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

struct RunFiles {
    std::string spikes, traces, document;
    RunStats work;
};

RunFiles run(const TemporaryFolder& folder, const std::vector<std::string>& stimuli, const std::vector<std::string>& names,
             std::size_t block) {
    std::vector<std::unique_ptr<ForceSource>> sources;
    std::vector<AfferentPlan> plans;
    for (const auto& s : stimuli) sources.push_back(test::value_or_throw(make_stimulus(s, 2e3, 9)));
    for (const auto& n : names) plans.push_back(test::value_or_throw(plan_afferent(n)));
    const auto spikes = test::make_sink(spikes_format, folder.path()), probes = test::make_sink(probes_format, folder.path());
    RunSummary summary;
    Sink* sinks[] = {spikes.get(), probes.get(), &summary};
    RespondOptions options;
    options.block = block;
    const auto work = test::value_or_throw(corpuscle::run(sources, plans, sinks, options));
    EXPECT_TRUE(spikes->commit());
    EXPECT_TRUE(probes->commit());
    return {test::read_file(folder / "spikes.csv"), test::read_file(folder / "probes.csv"),
            summary.document(plans, work, options, {}).dump(), work};
}

TEST(Respond, FilesDoNotDependOnTheBlock) {
    const std::vector<std::string> stimuli = {"press", "press+noise"}, names = {"sa1", "fa1-lee", "sa1b+izhikevich"};
    const TemporaryFolder one;
    const auto undivided = run(one, stimuli, names, 1 << 20);
    for (const std::size_t block : {1, 2, 7, 64, 333, 1999, 2000}) {
        const TemporaryFolder other;
        const auto parts = run(other, stimuli, names, block);
        EXPECT_EQ(undivided.spikes, parts.spikes) << block;
        EXPECT_EQ(undivided.traces, parts.traces) << block;
        EXPECT_EQ(undivided.document, parts.document) << block;
    }
}

TEST(Respond, SpikesAreInOrderOfTimeOneInputAfterAnother) {
    const TemporaryFolder folder;
    const auto ran = run(folder, {"press", "press"}, {"sa1", "fa1"}, 64);
    std::istringstream lines(ran.spikes);
    std::string line, channel;
    std::getline(lines, line);
    EXPECT_EQ(line, "afferent,channel,time_s");
    double last = 0;
    int count = 0;
    while (std::getline(lines, line)) {
        const auto first = line.find(','), second = line.rfind(',');
        const auto spike_channel = line.substr(first + 1, second - first - 1);
        const double t = std::stod(line.substr(second + 1));
        if (spike_channel != channel) last = 0, channel = spike_channel;
        EXPECT_GE(t, last);
        last = t, ++count;
    }
    EXPECT_EQ(channel, "press (2)") << "a second source of the same name gets another name";
    EXPECT_EQ(count, ran.work.spikes);
    EXPECT_EQ(ran.work.samples, 4000);
    EXPECT_EQ(ran.work.afferent_steps, 8000);
}

TEST(Respond, ProbeFilesAreReadBackAsRecordings) {
    const TemporaryFolder folder;
    const auto ran = run(folder, {"press"}, {"sa1"}, 64);
    EXPECT_TRUE(
        ran.traces.starts_with("time_s,press_N,sa1.press.I_A [A],sa1.press.I_B [A],sa1.press.I_C [A],sa1.press.I [A],sa1.press.u [V]\n"));
    RecordingOptions options;
    options.channels = {"press"};
    const auto reread = test::value_or_throw(open_recording(folder / "probes.csv", options));
    EXPECT_EQ(reread->clock().rate(), 2000);
    const auto read = test::value_or_throw(read_channel(*reread)), expected = test::force("press", {.rate = 2e3});
    ASSERT_EQ(read.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(read[k], expected[k], 1e-8);
}

TEST(Respond, StopsOnRequestAndReportsIt) {
    std::vector<std::unique_ptr<ForceSource>> sources;
    sources.push_back(test::value_or_throw(make_stimulus("press", 10e3, 0)));
    const auto plan = test::value_or_throw(plan_afferent("sa1"));
    RespondOptions options;
    int blocks = 0;
    options.block = 100;
    options.should_continue = [&](double) { return ++blocks < 3; };
    const auto work = corpuscle::run(sources, std::span(&plan, 1), {}, options);
    ASSERT_FALSE(work);
    EXPECT_EQ(work.error().code, ErrorCode::interrupted);
    EXPECT_EQ(blocks, 3);
}

TEST(Respond, ARateTooLowForAnAfferentIsReported) {
    std::vector<std::unique_ptr<ForceSource>> sources;
    sources.push_back(test::value_or_throw(make_stimulus("press", 500, 0)));
    const auto fa2 = test::value_or_throw(plan_afferent("fa2")), sa1 = test::value_or_throw(plan_afferent("sa1"));
    EXPECT_EQ(
        rate_warnings(sources, std::span(&fa2, 1)).at(0),
        "fa2 on press: the sample rate is 500 Hz, but this afferent needs 1000 Hz or more: vibration above 250 Hz is missing, and the "
        "afferent responds to the slower part of the force only");
    const auto fa1 = test::value_or_throw(plan_afferent("fa1-nerve"));
    EXPECT_TRUE(rate_warnings(sources, std::span(&fa1, 1)).empty()) << "500 Hz serve";
    EXPECT_TRUE(rate_warnings(sources, std::span(&sa1, 1)).empty());
}

TEST(OutputFile, LeavesNothingBehindUnlessItIsComplete) {
    const TemporaryFolder folder;
    {
        auto f = test::value_or_throw(OutputFile::create(folder / "new/half.txt"));
        (void)f.write("half");
    }
    EXPECT_TRUE(folder.file_names().empty()) << "neither the partial file nor its new directory is left";
    auto f = test::value_or_throw(OutputFile::create(folder / "whole.txt"));
    EXPECT_TRUE(f.write("whole"));
    EXPECT_TRUE(f.commit());
    EXPECT_EQ(folder.file_names(), std::vector<std::string>{"whole.txt"});
    EXPECT_EQ(test::read_file(folder / "whole.txt"), "whole");
    EXPECT_FALSE(OutputFile::create(folder.path()));
}

TEST(RespondReport, KeepsItsSizeLimitForAnyNumberOfInputs) {
    const auto points_of = [](int inputs) {
        std::vector<std::unique_ptr<ForceSource>> sources;
        for (int k = 0; k < inputs; ++k) sources.push_back(test::value_or_throw(make_stimulus("press", 20e3, 0)));
        const auto plan = test::value_or_throw(plan_afferent("sa1"));
        RespondReport report(100'000);
        RunSummary summary;
        Sink* sinks[] = {&report, &summary};
        (void)test::value_or_throw(corpuscle::run(sources, std::span(&plan, 1), sinks, {}));
        const auto page = report.page(summary, std::span(&plan, 1), "", {}, nlohmann::ordered_json::array());
        EXPECT_EQ(page.find("{{page"), std::string::npos);
        EXPECT_EQ(page.find("{{script"), std::string::npos) << "every part of the template was filled";
        const auto data = page.substr(page.find("id=\"data\">") + 10);
        const auto document = nlohmann::json::parse(data.substr(0, data.find("</script>")));
        std::size_t points = 0;
        for (const auto& t : document["traces"]) points += t["count"].get<std::size_t>() * (t["bucket"] == 1 ? 1 : 2);
        return points;
    };
    EXPECT_LE(points_of(1), 100'000U);
    EXPECT_LE(points_of(5), 100'000U);
    EXPECT_GE(points_of(5), 25'000U);
}

TEST(RespondReport, ComparesSeveralInputsFromTheirStart) {
    const auto trials_of = [](const std::vector<std::string>& stimuli) {
        std::vector<std::unique_ptr<ForceSource>> sources;
        for (const auto& name : stimuli) sources.push_back(test::value_or_throw(make_stimulus(name, 1e3, 0)));
        const auto plan = test::value_or_throw(plan_afferent("sa1"));
        RespondReport report(100'000, {}, true, true);
        RunSummary summary;
        Sink* sinks[] = {&report, &summary};
        (void)test::value_or_throw(corpuscle::run(sources, std::span(&plan, 1), sinks, {}));
        const auto page = report.page(summary, std::span(&plan, 1), "", {}, nlohmann::ordered_json::array());
        const auto data = page.substr(page.find("id=\"data\">") + 10);
        return nlohmann::json::parse(data.substr(0, data.find("</script>"))).value("trials", nlohmann::json());
    };
    EXPECT_TRUE(trials_of({"press"}).is_null()) << "there is nothing to compare";
    const auto two = trials_of({"press", "press"});
    ASSERT_EQ(two["trials"].size(), 2U);
    EXPECT_EQ(two["labels"].size(), 2U) << "inputs of one name are numbered";
    EXPECT_EQ(two["trials"][1]["zero"], 0.0);
    EXPECT_EQ(two["spikes"][0]["times"], two["spikes"][1]["times"]);
    EXPECT_FALSE(two["histograms"].empty());
}

TEST(Envelope, KeepsMinAndMaxOfEveryBucketForAnyLength) {
    EXPECT_TRUE(rc::check("compared with a direct computation", [] {
        const auto x = *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(1, 400), rc::gen::inRange(-1000, 1000));
        Envelope e(16);
        for (const int v : x) e.add(v);
        const auto bucket = static_cast<std::size_t>(e.bucket());
        RC_ASSERT(e.count() == (x.size() + bucket - 1) / bucket);
        RC_ASSERT(e.count() <= 16);
        for (std::size_t b = 0; b < e.count(); ++b) {
            const auto from = x.begin() + static_cast<std::ptrdiff_t>(b * bucket),
                       to = x.begin() + static_cast<std::ptrdiff_t>(std::min(x.size(), (b + 1) * bucket));
            const auto [min_value, max_value] = std::minmax_element(from, to);
            const auto* bucket_values = &e.values()[bucket == 1 ? b : 2 * b];
            RC_ASSERT(bucket_values[0] == static_cast<float>(*min_value));
            if (bucket > 1) RC_ASSERT(bucket_values[1] == static_cast<float>(*max_value));
        }
    }));
}

TEST(Base64, AgreesWithTheExamplesOfTheStandard) {  // RFC 4648, section 10
    const std::pair<const char*, const char*> cases[] = {
        {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, coded] : cases) EXPECT_EQ(base64(std::as_bytes(std::span(std::string_view(plain)))), coded);
}

}  // namespace
}  // namespace corpuscle
