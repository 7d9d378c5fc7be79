// Recordings in every common style, and the errors for those that cannot be read.

#include "io/recording/recording.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/recording/recording_formats.hpp"
#include "io/recording/row_clock.hpp"
#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

using test::try_load_recording;

test::LoadedRecording read(const std::string& path, const RecordingOptions& options = {}) { return test::load_recording(path, options); }

std::string error_text(const TemporaryFolder& folder, const std::string& text, const RecordingOptions& options = {}) {
    return test::load_error(folder.write("x.csv", text), options);
}

using Rows = std::vector<std::vector<double>>;

TEST(Recording, IsReadInEveryStyle) {
    const struct {
        const char *style, *text;
        RecordingOptions options;
        std::vector<std::string> names;
        double rate;
        Rows force;
    } cases[] = {
        {"commas and a header with units",
         "time_s,fz_N,fy_mN\n0,1,2000\n0.001,1.5,2500\n0.002,2,3000\n",
         {},
         {"fz", "fy"},
         1000,
         {{1, 1.5, 2}, {2, 2.5, 3}}},
        {"units in brackets",
         "Time [ms],Fz [N],\"F, left (mN)\"\n0,1,2000\n1,1.5,2500\n2,2,3000\n",
         {},
         {"Fz", "F, left"},
         1000,
         {{1, 1.5, 2}, {2, 2.5, 3}}},
        {"tabs without header, the time first",
         "0.0000\t1\t3\n0.0100\t2\t4\n0.0200\t3\t5\n",
         {},
         {"ch1", "ch2"},
         100,
         {{1, 2, 3}, {3, 4, 5}}},
        {"blanks, no time", "1 3\n7 4\n3 5\n", {.rate = 50}, {"ch1", "ch2"}, 50, {{1, 7, 3}, {3, 4, 5}}},
        {"blanks about commas, milliseconds not from 0",
         "timestamp_ms, a, b\n421419, 3, 9\n421439, 4, 8\n421459, 5, 7\n",
         {},
         {"a", "b"},
         50,
         {{3, 4, 5}, {9, 8, 7}}},
        {"semicolons and decimal commas", "t;F_N\n0,0;1,5\n0,5;2,5\n1,0;3,5\n", {}, {"F"}, 2, {{1.5, 2.5, 3.5}}},
        {"Windows line ends, a byte-order mark, no last line end",
         "\xef\xbb\xbft,F_gf\r\n0,100\r\n1,200",
         {},
         {"F"},
         1,
         {{0.980665, 1.96133}}},
        {"comments and blank lines", "# a cell\n\nt,F\n0,1\n% later\n1,2\n\n", {}, {"F"}, 1, {{1, 2}}},
        {"one column", "1\n2\n3\n", {.rate = 10}, {"ch1"}, 10, {{1, 2, 3}}},
        {"counts with a scale, absolute",
         "Fz,emg0\n-4,1\n6,2\n",
         {.channels = {"Fz"}, .rate = 10, .scale = 0.5, .absolute = true},
         {"Fz"},
         10,
         {{2, 3}}},
        {"a unit by option", "F\n1\n2\n", {.rate = 10, .unit = "kgf"}, {"F"}, 10, {{9.80665, 19.6133}}},
        {"signs and exponents", "t,F_N\n0,+1e0\n1,-2.5E-1\n2,.5\n", {}, {"F"}, 1, {{1, -0.25, 0.5}}},
    };
    for (const auto& c : cases) {
        const TemporaryFolder folder;
        const auto recording = try_load_recording(folder.write("x.csv", c.text), c.options);
        ASSERT_TRUE(recording) << c.style << ": " << recording.error().text();
        EXPECT_EQ(recording->names, c.names) << c.style;
        EXPECT_NEAR(recording->clock.rate(), c.rate, 1e-9) << c.style;
        ASSERT_EQ(recording->force.size(), c.force.size()) << c.style;
        for (std::size_t k = 0; k < c.force.size(); ++k) {
            ASSERT_EQ(recording->force[k].size(), c.force[k].size()) << c.style;
            for (std::size_t n = 0; n < c.force[k].size(); ++n) EXPECT_NEAR(recording->force[k][n], c.force[k][n], 1e-12) << c.style;
        }
    }
}

TEST(Recording, ChannelsAreChosenByNameNumberAndRange) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "time_s,a_N,b_N,c_N,d_N\n0,1,2,3,4\n1,5,6,7,8\n");
    const auto names = [&](std::vector<std::string> channels) { return read(path, {.channels = channels}).names; };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names({}), (Names{"a", "b", "c", "d"}));
    EXPECT_EQ(names({"c", "a_N"}), (Names{"c", "a"}));
    EXPECT_EQ(names({"2-3,1"}), (Names{"b", "c", "a"}));
    EXPECT_EQ(names({"b", "2"}), (Names{"b"}));
    EXPECT_EQ(error_text(folder, "time_s,fz_N\n0,1\n1,2\n", {.channels = {"fx"}}),
              "x.csv: no channel 'fx'; did you mean 'fz'?; there are 1: fz");
    EXPECT_EQ(error_text(folder, "time_s,fz_N\n0,1\n1,2\n", {.channels = {"1-3"}}), "x.csv: no channel '1-3'; there are 1: fz");
}

TEST(Recording, ErrorsNameFileLineColumnAndTheExpectedValue) {
    const TemporaryFolder folder;
    const std::string bad_field = "; use --bad-fields interpolate to fill it in, or --bad-fields drop to skip the row";
    EXPECT_EQ(error_text(folder, ""), "x.csv: no data in this file");
    EXPECT_EQ(error_text(folder, "# only this\n"), "x.csv: no data in this file");
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n1,x\n"), "x.csv:3:3: column 'F': 'x' where a number is expected" + bad_field);
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n1,nan\n"), "x.csv:3:3: column 'F': 'nan' where a number is expected" + bad_field);
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n1,\n"), "x.csv:3:3: column 'F': an empty field where a number is expected" + bad_field);
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n1\n"), "x.csv:3: 1 columns where 2 are expected; use --bad-fields drop to skip such rows");
    EXPECT_EQ(error_text(folder, "1,2\n3,4\n", {.rate = 10, .unit = "mV"}),
              "x.csv: 'ch1' is read as mV, which is not a force; use --scale S for S newtons per mV");
    EXPECT_EQ(error_text(folder, "F_nm\n1\n", {.rate = 10}),
              "x.csv: 'F' is in nm, which is not a force; use --scale S for S newtons per nm, --unit N if the header is wrong, "
              "or --channel to select another column");
    EXPECT_EQ(error_text(folder, "F\n1\n2\n"),
              "x.csv: no time column found (columns: F); name one with --time, or give a rate, such as --rate 1kHz");
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n2,1\n1,1\n"),
              "x.csv:4: the time decreases from 2 s to 1 s; use --rate to take the rows as evenly spaced");
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n"), "x.csv: a single sample has no rate; give one, such as --rate 1kHz");
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n0,2\n"), "x.csv: the times in 't' do not increase; give a rate, such as --rate 1kHz");
    EXPECT_EQ(error_text(folder, "t_N,F\n0,1\n1,1\n"),
              "x.csv: the time column 't' is in 'N', which is not a unit of time; give its unit with --time-unit, or another column or "
              "'none' with --time");
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n1,1\n", {.time = "z"}),
              "x.csv: no time column 'z'; did you mean 't'?; give a name, a number or 'none' (columns: t, F)");
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n", {.unit = "N", .scale = 2}),
              "--unit and --scale exclude each other: both convert the values to newtons");
    EXPECT_EQ(try_load_recording(folder.path()).error().text(), folder.path() + ": this is a directory, not a file");
    EXPECT_EQ(try_load_recording(folder / "none.csv").error().text(),
              (folder / "none.csv") + ": cannot be opened: No such file or directory");
}

TEST(Recording, CommonHeadingsAreRecognised) {
    const TemporaryFolder folder;
    const auto one = [&](const std::string& text, const RecordingOptions& options = {}) {
        return read(folder.write("x.csv", text), options);
    };
    const auto seconds = one("Time (sec),Force (Newton)\n0,1\n0.5,2\n");
    EXPECT_EQ(seconds.clock.rate(), 2);
    EXPECT_EQ(seconds.force[0][1], 2);
    EXPECT_EQ(one("time_sec,Force_N\n0,1\n0.5,2\n").clock.rate(), 2);
    const auto commented = one("# t_s fz_mN\n0 1000\n0.1 2000\n");  // as numpy.savetxt writes it
    EXPECT_EQ(commented.names, std::vector<std::string>{"fz"});
    EXPECT_NEAR(commented.force[0][1], 2, 1e-12);
    EXPECT_EQ(one("t,left_F,right_F\n0,1,2\n1,3,4\n").names, (std::vector<std::string>{"left_F", "right_F"}))
        << "_F is part of the name, not farads";
    EXPECT_EQ(one("t,F_N,\n0,1,\n1,2,\n").names, std::vector<std::string>{"F"}) << "a separator at the end makes no column";
    EXPECT_EQ(one("t,F_lbf\n0,1\n1,2\n").force[0][0], 4.4482216152605);
    EXPECT_EQ(error_text(folder, "nan,1\n2,3\n4,5\n", {.rate = 100}),
              "x.csv:1:1: column 1: 'nan' where a number is expected; use --bad-fields interpolate to fill it in, or --bad-fields drop to "
              "skip the "
              "row, or --skip LINES to skip lines before the table")
        << "nan is not a heading";
    EXPECT_EQ(error_text(folder, std::string("t,F\n\0\0", 6)), "x.csv: not a text file: it contains NUL bytes, as binary files do");
    EXPECT_EQ(error_text(folder, "t,F_furlong\n0,1\n1,2\n", {.unit = "mn"}).substr(0, 91),
              "x.csv: 'F_furlong' is read as mn, which is not a known unit of force (N, mN, gf, kgf, lbf .");
}

TEST(Recording, OptionsThatContradictTheHeaderAreReported) {
    const TemporaryFolder folder;
    EXPECT_EQ(read(folder.write("x.csv", "t,F_N\n0,1\n0.1,2\n"), {.unit = "mN"}).notes.at(0),
              "--unit mN overrides the unit of 'F' in the header, N");
    EXPECT_EQ(read(folder.write("x.csv", "t,F_N\n0,1\n0.1,2\n"), {.scale = 0.5}).notes.at(0),
              "--scale 0.5 overrides the unit of 'F' in the header, N");
    for (const char* heading : {"F_mN", "F_V", "F"})  // the same factor, no force, no unit
        for (const double scale : {1e-3, -1e-3})
            for (const auto& note : read(folder.write("x.csv", fmt::format("t,{}\n0,1\n0.1,2\n", heading)), {.scale = scale}).notes)
                EXPECT_EQ(note.find("overrides"), std::string::npos) << note;
}

TEST(Recording, MillisecondsWithoutAUnitCauseAWarningUnlessTheUnitIsGiven) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "timestamp,F_N\n421419,1\n421447,2\n421475,3\n");
    EXPECT_EQ(read(path).notes.at(0),
              "no unit for 'timestamp': assuming seconds, which gives a rate of 0.035714 Hz; use --time-unit ms if they are milliseconds");
    const auto with_unit = read(path, {.time_unit = "ms"});
    EXPECT_NEAR(with_unit.clock.rate(), 1000.0 / 28, 1e-9);
    EXPECT_NEAR(with_unit.clock.t0, 421.419, 1e-12);
    EXPECT_TRUE(with_unit.notes.empty());
}

TEST(Recording, UnreadableTimesAreIgnoredIfARateIsGiven) {
    const TemporaryFolder folder;
    const auto recording = read(folder.write("x.csv", "time,F_N\n01/02/2026 0:00,1\n01/02/2026 0:01,2\n"), {.rate = 1});
    EXPECT_EQ(recording.force, (Rows{{1, 2}}));
    EXPECT_EQ(recording.notes.at(0),
              "the times were ignored (column 'time': '01/02/2026 0:00' where a number is expected); the recording starts at 0 s");
}

TEST(Recording, ARateCloseToAnIntegerIsThatInteger) {
    EXPECT_EQ(test::value_or_throw(make_clock(999.9128, 0, 1e-3)).rate(), 1000);
    EXPECT_EQ(test::value_or_throw(make_clock(199.81, 0, 1e-3)).rate(), 200);
}

TEST(Recording, AnUnevenClockIsRefusedUnlessAnOptionReplacesItOrInterpolates) {
    const TemporaryFolder folder;
    const std::string bursts = "time_s,F_N\n0,0\n0.001,1\n0.002,2\n0.003,3\n0.1,4\n0.101,5\n0.102,6\n0.2,7\n";
    EXPECT_EQ(error_text(folder, bursts).substr(0, 150),
              "x.csv: the times in 'time' are not evenly spaced: mean rate 35 Hz, steps from 1 ms to 98 ms, jitter up to 82.71 ms. "
              "Use --rate 35Hz to take the sample");
    const auto path = folder / "x.csv";
    const auto even = read(path, {.rate = 35});
    EXPECT_EQ(even.force[0], (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(even.notes.at(0), "the uneven times in 'time' (steps from 1 ms to 98 ms) were replaced by an even clock of 35 Hz");
    const auto interpolated = read(path, {.resample = 20});
    ASSERT_EQ(interpolated.force[0].size(), 5U);
    const double expected[] = {0, 3 + 47.0 / 97, 4, 6 + 48.0 / 98, 7};
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(interpolated.force[0][static_cast<std::size_t>(k)], expected[k], 1e-9);
    EXPECT_EQ(interpolated.notes.at(0), "the uneven times in 'time' (steps from 1 ms to 98 ms) were interpolated at 20 Hz");
    EXPECT_EQ(error_text(folder, "t,F\n0,1\n0,2\n1,3\n4,4\n", {.resample = 2}),
              "x.csv:3: the time 0 s occurs twice; use --rate to take the rows as evenly spaced");
}

TEST(Recording, RoundedTimesAreEvenAndTheirRateIsTheSimplest) {
    const TemporaryFolder folder;
    std::string text = "time_s,F_N\n";
    for (int k = 0; k < 2000; ++k) text += fmt::format("{:.3f},{}\n", k / 242.6, k);  // rounded to the millisecond
    const auto recording = read(folder.write("x.csv", text));
    EXPECT_NEAR(recording.clock.rate(), 242.6, 0.03);
    EXPECT_EQ(recording.force[0].size(), 2000U);
    text = "t,F\n";
    for (int k = 0; k < 1000; ++k) text += fmt::format("{:.4f},{}\n", 5 + k * 0.01 + (k % 3 == 1 ? 1e-4 : 0), k);
    EXPECT_EQ(read(folder.write("y.csv", text)).clock.rate(), 100);
    EXPECT_EQ(read(folder / "y.csv").clock.t0, 5);
}

TEST(Recording, AClockThatContradictsTheRateIsReported) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "time_s,F\n0,1\n0.01,2\n0.02,3\n");
    EXPECT_EQ(read(path).notes.at(0), "no unit for 'F': assuming newtons");
    EXPECT_EQ(read(path, {.rate = 50}).notes.at(0), "--rate is 50 Hz, but the mean rate of the times in 'time' is 100 Hz");
}

TEST(Recording, AHeaderWithoutRowsHasNoSamplesWithAndWithoutResampling) {  // found by fuzzing
    const TemporaryFolder folder;
    EXPECT_TRUE(read(folder.write("x.csv", "F_N\n"), {.rate = 30, .resample = 30}).force[0].empty());
    EXPECT_TRUE(read(folder / "x.csv", {.rate = 30}).force[0].empty());
}

TEST(Recording, ResamplingAtItsOwnRateChangesNothing) {
    const TemporaryFolder folder;
    std::string text = "F_N\n";
    for (int k = 0; k < 100; ++k) text += fmt::format("{}\n", k * k);
    const auto path = folder.write("x.csv", text);
    const auto same = read(path, {.rate = 30, .resample = 30}), twice = read(path, {.rate = 30, .resample = 60});
    ASSERT_EQ(same.force[0].size(), 100U);
    ASSERT_EQ(twice.force[0].size(), 199U);
    for (std::size_t k = 0; k < 100; ++k) {
        EXPECT_NEAR(same.force[0][k], static_cast<double>(k * k), 1e-6);
        EXPECT_NEAR(twice.force[0][2 * k], static_cast<double>(k * k), 1e-6);
        if (k < 99) {
            EXPECT_NEAR(twice.force[0][2 * k + 1], static_cast<double>(k * k) + static_cast<double>(k) + 0.5, 1e-6);
        }
    }
}

TEST(Recording, EveryTextDialectIsReadBackAsItWasWritten) {
    EXPECT_TRUE(rc::check("round trip of tables of random numbers, in every dialect", [] {
        const auto columns = *rc::gen::inRange<std::size_t>(1, 6), rows = *rc::gen::inRange<std::size_t>(1, 200);
        const auto separator = *rc::gen::element<std::string>(",", "\t", ";", " ");
        const auto end = *rc::gen::element<std::string>("\n", "\r\n");
        const bool header = *rc::gen::arbitrary<bool>();
        // In one column without a header, 1,5 would be read as two numbers, so it has no decimal comma.
        const bool comma = *rc::gen::arbitrary<bool>() && (columns == 1 ? header : separator == "\t" || separator == ";");
        std::vector<std::vector<double>> values(columns);
        for (auto& c : values)
            c = *rc::gen::container<std::vector<double>>(rows,
                                                         rc::gen::map(rc::gen::inRange(-1000000, 1000000), [](int x) { return x / 1e3; }));
        std::string text;
        for (std::size_t c = 0; header && c < columns; ++c)
            text += (c ? separator : "") + fmt::format("F{}_N", c) + (c + 1 == columns ? end : "");
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c) {
                auto number = fmt::format("{}", values[c][r]);
                if (comma) std::replace(number.begin(), number.end(), '.', ',');
                text += (c ? separator : "") + number + (c + 1 == columns ? end : "");
            }
        const auto path = (std::filesystem::temp_directory_path() / fmt::format("corpuscle-round-trip-{}.csv", ::getpid())).string();
        std::ofstream(path, std::ios::binary) << text;
        const auto recording = try_load_recording(path, {.time = "none", .rate = 100});
        std::filesystem::remove(path);
        RC_ASSERT(static_cast<bool>(recording));
        RC_ASSERT(recording->force == values);
    }));
}

TEST(ClockAnalysis, FindsTheFarthestSampleInOnePass) {
    EXPECT_TRUE(rc::check("compared with a computation in two passes", [] {
        const auto jitter = *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(2, 200), rc::gen::inRange(0, 1000));
        ClockAnalysis analysis;
        std::vector<double> t;
        for (std::size_t k = 0; k < jitter.size(); ++k) t.push_back(static_cast<double>(k) + jitter[k] * 1e-3), analysis.add(t.back());
        const double step = (t.back() - t[0]) / static_cast<double>(t.size() - 1);
        double late = 0, early = 0;
        for (std::size_t k = 0; k < t.size(); ++k)
            late = std::max(late, t[k] - t[0] - static_cast<double>(k) * step),
            early = std::min(early, t[k] - t[0] - static_cast<double>(k) * step);
        RC_ASSERT(std::abs(analysis.peak_to_peak_jitter() - (late - early)) < 1e-9);
    }));
}

TEST(ClockAnalysis, AClockThatSlowsSteadilyIsAnalysedInLittleMemory) {  // every sample is on the convex hull, which is thinned
    ClockAnalysis analysis;
    std::vector<double> t;
    for (int k = 0; k < 300'000; ++k) t.push_back(1e-3 * k + 1e-11 * k * static_cast<double>(k)), analysis.add(t.back());
    const double step = (t.back() - t[0]) / static_cast<double>(t.size() - 1);
    double early = 0;
    for (std::size_t k = 0; k < t.size(); ++k) early = std::min(early, t[k] - static_cast<double>(k) * step);
    EXPECT_NEAR(analysis.peak_to_peak_jitter(), -early, 1e-6 * -early);
}

TEST(ClockAnalysis, CountsGapsRelativeToTheUsualStep) {
    ClockAnalysis analysis;
    double t = 0;
    for (int k = 0; k < 1000; ++k) analysis.add(t), t += k % 100 == 50 ? 0.03 : 0.01;
    EXPECT_EQ(analysis.gap_count(), 10);
}

TEST(Recording, TheFirstPassThroughTheTimesCanBeStopped) {
    const TemporaryFolder folder;
    RecordingOptions options;
    options.should_continue = [](double) { return false; };
    const auto recording = try_load_recording(folder.write("x.csv", "t_s,F_N\n0,1\n1,2\n2,3\n"), options);
    ASSERT_FALSE(recording);
    EXPECT_EQ(recording.error().code, ErrorCode::interrupted);
}

TEST(Recording, MoreChannelsThanCanBeSimulatedAtOnceAreRefused) {
    const TemporaryFolder folder;
    std::string text;
    for (int c = 0; c < 140'000; ++c) text += c ? ",1" : "1";
    EXPECT_EQ(error_text(folder, text + "\n", {.rate = 10}),
              "x.csv: 140000 channels are more than the limit of 131072; select some, such as --channel 1-1000");
}

TEST(Recording, APressOnTheElectronicSkinIsRead) {
    const auto path = test::shared_file_path("fbg_eskin_press/fbg_press_S6_T16.csv");
    CORPUSCLE_NEEDS(path);
    EXPECT_NE(try_load_recording(path).error().text().find("is in nm, which is not a force"), std::string::npos);
    const auto refused = try_load_recording(path, {.scale = 40});
    ASSERT_FALSE(refused) << "its samples arrive in bursts";
    EXPECT_NE(refused.error().text().find("not evenly spaced: mean rate 100.0"), std::string::npos) << refused.error().text();
    const auto press = read(path, {.rate = 100, .scale = 40});
    ASSERT_EQ(press.names.size(), 21U);
    EXPECT_EQ(press.names[10], "fbg11");
    ASSERT_EQ(press.force[0].size(), 2125U);
    const auto train = [&](const std::string& afferent, std::size_t channel) {
        return spike_times(test::spikes(*test::afferent(afferent, {.rate = 100}), press.force[channel]), press.clock);
    };
    // Contact lasts from 17.2 to 21.2 s; the force is largest at fbg11.
    const auto sa1 = train("sa1", 10), fa1 = train("fa1", 10);
    int windows_with_spikes = 0;
    for (double t = 17.5; t < 20.5; t += 0.5)
        windows_with_spikes += std::any_of(sa1.begin(), sa1.end(), [&](double s) { return s >= t && s < t + 0.5; });
    EXPECT_EQ(windows_with_spikes, 6) << "SA-I fires in every half second of the hold";
    EXPECT_GT(fa1.size(), 2U) << "FA-I fires at the faster edges";
    EXPECT_LT(fa1.size(), sa1.size() / 4);
    for (std::size_t c = 0; c < 21; ++c)
        for (const auto* afferent : {"sa1", "fa1"})
            for (const double t : train(afferent, c))
                EXPECT_TRUE(t > 17.0 && t < 21.5) << afferent << " on fbg" << c + 1 << " is not silent at rest: " << t;
}

TEST(Recording, TheInsolesTimesAreReadUnchanged) {
    const auto path = test::shared_file_path("gait_insole_vgrf/GaCo01_01.txt");
    CORPUSCLE_NEEDS(path);
    const auto walk = read(path, {.channels = {"1-16"}, .scale = 0.008});
    EXPECT_NEAR(walk.clock.rate(), 100.007, 1e-3) << "12119 rows from 0 to 121.172 s, rounded to 0.1 ms";
    EXPECT_EQ(walk.notes.at(0),
              "no header: the first column increases evenly and is taken as the time (use --time none if it is a channel)");
    EXPECT_EQ(walk.names.size(), 16U);
    EXPECT_EQ(walk.force[0].size(), 12119U);
    EXPECT_NEAR(walk.force[0][0], 199.1 * 0.008, 1e-12);
}

}  // namespace
}  // namespace corpuscle
