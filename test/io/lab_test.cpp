// Recordings with faults: bad fields, outliers, hum, offsets, layouts, and the notes on them.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "io/text/dialect.hpp"
#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;
using LabRows = std::vector<std::vector<double>>;

using LabRecording = test::LoadedRecording;
using test::try_load_recording;

LabRecording read_lab(const std::string& path, const RecordingOptions& options, std::size_t block = 5) {
    return test::load_recording(path, options, block);
}

std::string lab_error(const TemporaryFolder& folder, const std::string& text, const RecordingOptions& options) {
    return test::load_error(folder.write("x.csv", text), options);
}

bool mentions(const std::vector<std::string>& messages, const std::string& part) {
    return std::any_of(messages.begin(), messages.end(), [&](const auto& s) { return s.find(part) != std::string::npos; });
}

double quality_metric(const LabRecording& r, std::string_view name, std::uint32_t channel = 0) {
    for (const auto& f : r.quality.metrics)
        if (f.name == name && f.channel == channel) return f.value;
    return -1;
}

TEST(BadFields, AreErrorsByDefault) {
    const TemporaryFolder folder;
    const std::string text = "F_N\n1\n2\nNaN\n4\n";
    EXPECT_EQ(lab_error(folder, text, {.rate = 10}),
              "x.csv:4:1: column 'F': 'NaN' where a number is expected; use --bad-fields interpolate to fill it in, or --bad-fields "
              "drop to skip the row");
    EXPECT_EQ(read_lab(folder / "x.csv", {.rate = 10, .bad_fields = BadFields::interpolate}).force, (LabRows{{1, 2, 3, 4}}));
    EXPECT_EQ(read_lab(folder / "x.csv", {.rate = 10, .bad_fields = BadFields::drop}).force, (LabRows{{1, 2, 4}}));
}

TEST(BadFields, OneBadFieldDropsItsRowInEveryChannel) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "a_N,b_N\n1,2\n3,x\n5,6\n7\n9,10\n");
    EXPECT_EQ(read_lab(path, {.rate = 10, .bad_fields = BadFields::drop}).force, (LabRows{{1, 5, 9}, {2, 6, 10}}));
    EXPECT_EQ(read_lab(path, {.rate = 10, .bad_fields = BadFields::interpolate}).force, (LabRows{{1, 3, 5, 7, 9}, {2, 4, 6, 8, 10}}));
}

TEST(BadFields, DroppedRowsDoNotChangeTheTimesOfOthers) {
    const TemporaryFolder folder;
    std::string text = "t_s,F_N\n";
    std::vector<double> expected;
    for (int k = 0; k < 40; ++k) {
        text += fmt::format("{},{}\n", k, k >= 10 && k < 15 ? "bad" : std::to_string(k));
        expected.push_back(k);
    }
    const auto path = folder.write("x.csv", text);
    const auto refused = try_load_recording(path, {.bad_fields = BadFields::drop});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("not evenly spaced"), std::string::npos);
    EXPECT_EQ(read_lab(path, {.resample = 1, .bad_fields = BadFields::drop}).force, (LabRows{expected}));
}

TEST(BadFields, ARowWithABadTimeIsDroppedAndReported) {
    const TemporaryFolder folder;
    std::string text = "t_s,F_N\n";
    for (int k = 0; k < 40; ++k) text += k == 30 ? "xx,99\n" : fmt::format("{},1\n", k);
    EXPECT_NE(
        lab_error(folder, text, {}).find("x.csv:32:1: column 't': 'xx' where a number is expected; use --bad-fields drop to skip the row"),
        std::string::npos);
    for (const auto rate : {std::optional<double>(), std::optional<double>(1)}) {
        const auto r = read_lab(folder / "x.csv", {.rate = rate, .bad_fields = BadFields::drop});
        EXPECT_EQ(r.force, (LabRows{std::vector<double>(39, 1)}));
        EXPECT_TRUE(mentions(r.quality.descriptions, "1 rows with a bad field were dropped"));
    }
    const auto untimed = folder.write("y.csv", "time,F_N\nmorning,1\nnoon,2\n");
    EXPECT_EQ(read_lab(untimed, {.rate = 1, .bad_fields = BadFields::drop}).force, (LabRows{{1, 2}}))
        << "with --rate, times need not be readable";
}

TEST(BadFields, AMissingTimeIsInterpolatedIfTimesAreEven) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "t_s,F_N\n0,0\n1,1\n?,2\n3,3\n4,4\n");
    const auto r = read_lab(path, {.bad_fields = BadFields::interpolate});
    EXPECT_EQ(r.force, (LabRows{{0, 1, 2, 3, 4}}));
    EXPECT_EQ(r.clock.rate(), 1);
}

TEST(Range, SamplesOutsideAreBadAndInterpolatedByDefault) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "F_N\n1\n999\n3\n4\n");
    EXPECT_EQ(read_lab(path, {.rate = 10, .range = std::pair{0.0, 10.0}}).force, (LabRows{{1, 2, 3, 4}}));
    EXPECT_EQ(read_lab(path, {.rate = 10, .range = std::pair{0.0, 10.0}, .bad_fields = BadFields::drop}).force, (LabRows{{1, 3, 4}}));
    EXPECT_EQ(lab_error(folder, "F_N\n1\n999\n3\n", {.rate = 10, .range = std::pair{0.0, 10.0}, .bad_fields = BadFields::error}),
              "x.csv:3: 'F': 999 is outside --range 0..10");
}

TEST(Offset, IsSubtractedBeforeTheScaleAndAfterTheSign) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "F\n-512\n-612\n512\n");
    RecordingOptions options{.rate = 10, .scale = 0.01, .absolute = true};
    options.offset = 512;
    EXPECT_EQ(read_lab(path, options).force, (LabRows{{0, 1, 0}}));
}

TEST(Conditioning, DoesNotDependOnTheBlocks) {
    const TemporaryFolder folder;
    std::string text = "t_s,F_N\n";
    for (int k = 0; k < 3000; ++k)
        text +=
            fmt::format("{:.3f},{}\n", k * 0.004, k % 41 == 0 ? "x" : fmt::format("{:.4f}", k % 29 == 0 ? 900.0 : 2 + std::sin(0.05 * k)));
    const auto path = folder.write("x.csv", text);
    RecordingOptions options;
    options.bad_fields = BadFields::interpolate;
    options.despike = {{5.0}};
    options.notch = {50};
    options.lowpass = 30;
    const auto undivided = read_lab(path, options, 100'000);
    ASSERT_EQ(undivided.force[0].size(), 3000U);
    for (const std::size_t block : {1, 7, 4096}) EXPECT_EQ(read_lab(path, options, block).force, undivided.force);
    for (std::size_t k = 200; k < 3000; ++k) EXPECT_NEAR(undivided.force[0][k], 2 + std::sin(0.05 * static_cast<double>(k)), 0.25);
    options.resample = 100;
    const auto slower = read_lab(path, options, 4096);
    EXPECT_EQ(read_lab(path, options, 3).force, slower.force);
    EXPECT_NEAR(slower.force[0][100], undivided.force[0][250], 1e-9);
}

TEST(Conditioning, RefusesAValueTooLargeForTheFilters) {
    const TemporaryFolder folder;
    RecordingOptions options{.rate = 100};
    options.notch = {12};
    EXPECT_EQ(lab_error(folder, "F_N\n0\n-1.7e308\n1.7e308\n-1.7e308\n1.7e308\n", options),
              "x.csv: 'F': sample 2 is not finite after processing: a value in the file is too large for --scale or the filters");
}

TEST(SensorLayout, NamesAndLocatesSensorsAndIgnoresOtherChannels) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "time_s,a_N,b_N,total_N\n0,1,2,3\n1,1,2,3\n");
    const auto layout = folder.write("layout.csv", "# sensor positions\nchannel,name,x_mm,y_mm\n2,heel,10,-20\na,toe,0.5,1\n");
    const auto r = read_lab(path, {.layout = layout});
    ASSERT_EQ(r.channels.size(), 2U);
    EXPECT_EQ(r.channels[0].name, "heel");
    EXPECT_EQ(r.force, (LabRows{{2, 2}, {1, 1}}));
    EXPECT_DOUBLE_EQ(r.channels[0].position->x, 0.01);
    EXPECT_DOUBLE_EQ(r.channels[1].position->y, 0.001);
    const auto one = read_lab(path, {.channels = {"b"}, .layout = layout});
    EXPECT_EQ(one.channels[0].name, "heel");
}

TEST(SensorLayout, ErrorsNameLineColumnAndTheExpectedValue) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "time_s,a_N,b_N\n0,1,2\n1,1,2\n");
    const auto wrong = [&](const std::string& text) {
        const auto layout = folder.write("l.csv", text);
        auto message = try_load_recording(path, {.layout = layout}).error().text();
        return message.substr(message.find("l.csv"));
    };
    EXPECT_EQ(wrong("sensor,x,y\nc,1,2\n"), "l.csv:2:1: no channel 'c'; did you mean 'a'?; there are 2: a, b");
    EXPECT_EQ(wrong("sensor,x,y\na,1,2\n1,3,4\n"), "l.csv:3:1: channel '1' occurs twice");
    EXPECT_EQ(wrong("sensor,x,y\na,1,east\n"), "l.csv:2:5: 'east' where a coordinate is expected");
    EXPECT_EQ(wrong("sensor,x_N\na,1\n"), "l.csv:1:8: 'x' is in 'N', which is not a length; use m, cm, mm or um, or no unit");
    EXPECT_EQ(wrong("who,x\na,1\n"), "l.csv:1: a layout needs a column 'channel' (and may have name, x, y, z); this header has: who, x");
    EXPECT_EQ(wrong("sensor,x\na\n"), "l.csv:2: 1 columns where 2 are expected");
    EXPECT_EQ(wrong("sensor,x\n"), "l.csv: the layout lists no sensors");
}

TEST(QualityReport, WarnsOnlyOfMisleadingData) {
    const TemporaryFolder folder;
    std::string good = "t_s,F_N\n", heavy = good, negative = good, weak = good, full = "t_s,F\n";
    for (int k = 0; k < 2000; ++k) {
        const double F = 1 + std::sin(0.01 * k), t = k * 0.01;
        good += fmt::format("{:.2f},{:.4f}\n", t, F);
        heavy += fmt::format("{:.2f},{:.4f}\n", t, 100 * F);
        negative += fmt::format("{:.2f},{:.4f}\n", t, -F);
        weak += fmt::format("{:.2f},{:.4f}\n", t, F / 100);
        full += fmt::format("{:.2f},{}\n", t, std::min(4095, k % 500 * 20));
    }
    const auto quality = [&](const std::string& text, const RecordingOptions& options = {}) {
        return read_lab(folder.write("x.csv", text), options, 500).quality;
    };
    EXPECT_TRUE(quality(good).warnings.empty());
    EXPECT_TRUE(quality(good).descriptions.empty());
    EXPECT_TRUE(mentions(quality(heavy).warnings, "up to 200 N, but the thesis's models are fitted to 0.2 to 4 N"));
    EXPECT_TRUE(mentions(quality(negative).warnings, "but a press must be positive"));
    EXPECT_TRUE(mentions(quality(weak).descriptions, "all forces are below 0.2 N"));
    EXPECT_NEAR(quality_metric(read_lab(folder.write("x.csv", good), {}), "below_0.2N"), 0.205,
                0.02);  // the fraction of each period in which 1 + sin < 0.2 N: (pi - 2 asin 0.8) / 2 pi
    EXPECT_TRUE(mentions(quality(full, {.scale = 1e-3}).warnings, "is 4095, the full scale of a 12-bit converter"));
}

TEST(Dialect, ParsePlainNumberAgreesWithParseNumber) {
    EXPECT_TRUE(rc::check("numbers as text in every dialect", [] {
        const auto dialect = *rc::gen::element(Dialect{',', false}, Dialect{';', true}, Dialect{' ', true}, Dialect{'\t', true});
        const auto digits = *rc::gen::inRange(0, 17);
        const double value = static_cast<double>(*rc::gen::inRange<std::int64_t>(-1'000'000'000'000, 1'000'000'000'000)) / 1e4;
        auto text = *rc::gen::element(fmt::format("{:.{}f}", value, digits % 5), fmt::format("{:.{}g}", value, digits + 1),
                                      fmt::format("{:.{}f}", value / 1e8, digits), fmt::format("{}.", digits), fmt::format(".{}", digits),
                                      std::string("-"), std::string("."), std::string(""), std::string("1e5"), std::string("0x10"));
        const std::size_t size = text.size();
        text += *rc::gen::element<std::string>("", std::string(1, dialect.separator), "x", "9", "\n") + std::string(16, '\0');
        const char *p = text.data(), *const end = text.data() + size;
        double plain, general;
        if (!dialect.parse_plain_number(p, end, plain)) return;
        RC_ASSERT(p == end);
        RC_ASSERT(dialect.parse_number({text.data(), size}, general));
        RC_ASSERT(plain == general && std::signbit(plain) == std::signbit(general));
    }));
}

}  // namespace
}  // namespace corpuscle
