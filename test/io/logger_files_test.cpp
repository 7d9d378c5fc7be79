// Recordings in the formats of loggers, spreadsheets and scripts: clocks, units, preambles, compression, and columns that are not forces.

#include <fmt/format.h>
#include <zlib.h>

#include <cstdlib>

#include "io/table/archive.hpp"
#include "support/file_writers.hpp"
#include "support/loaded_recording.hpp"
#include "support/processor_time.hpp"

namespace corpuscle {
namespace {

using test::load_recording;
using test::TemporaryFolder;
using test::try_load_recording;

std::string logger_file(const std::string& name) { return test::source_root() + "/examples/data/loggers/" + name; }

/// Reads a text as a recording.
test::LoadedRecording read_logged(const TemporaryFolder& folder, const std::string& text, const RecordingOptions& options = {},
                                  const std::string& name = "x.csv") {
    return load_recording(folder.write(name, text), options);
}

std::string error_of(const TemporaryFolder& folder, const std::string& text, const RecordingOptions& options = {},
                     const std::string& name = "x.csv") {
    return test::load_error(folder.write(name, text), options);
}

bool has_note(const test::LoadedRecording& r, const std::string& part) {
    return std::any_of(r.notes.begin(), r.notes.end(), [&](const auto& s) { return s.find(part) != s.npos; });
}

/// Rows of a ramp: row(k, t, F) with times in steps of 0.01 s and forces in steps of 0.05 N.
template <class Row>
std::string rows_of(int count, const Row& row) {
    std::string text;
    for (int k = 0; k < count; ++k) text += row(k, 0.01 * k, 0.05 * k);
    return text;
}

TEST(LoggerFiles, SevenFormatsGiveTheSameForceWithoutOptions) {
    const auto press = load_recording(logger_file("preamble.csv"));
    ASSERT_EQ(press.force[0].size(), 200U);
    EXPECT_NEAR(*std::max_element(press.force[0].begin(), press.force[0].end()), 2.4, 0.15);
    for (const auto* name : {"excel.csv", "iso-time.csv", "unix-time.csv", "slash-units.csv", "unit-row.csv", "labview.lvm"}) {
        const auto same = load_recording(logger_file(name));
        ASSERT_EQ(same.force.size(), 1U) << name;
        EXPECT_NEAR(same.clock.rate(), 100, 1e-9) << name;
        EXPECT_NEAR(same.clock.t0, 0, 1e-12) << name;
        ASSERT_EQ(same.force[0].size(), 200U) << name;
        for (std::size_t k = 0; k < 200; ++k) EXPECT_NEAR(same.force[0][k], press.force[0][k], 1e-9) << name << ", sample " << k;
    }
}

TEST(LoggerFiles, TrialsInOneFileAreRefusedWithACommandThatExtractsOne) {
    const TemporaryFolder folder;
    std::filesystem::copy(logger_file("trials.csv"), folder / "trials.csv");
    const auto message = try_load_recording(folder / "trials.csv").error().text();
    const auto at = message.find("awk ");
    ASSERT_NE(at, message.npos) << message;
    EXPECT_NE(message.find("identified by 'trial'"), message.npos) << message;
    ASSERT_EQ(std::system(("cd '" + folder.path() + "' && " + message.substr(at)).c_str()), 0) << message;
    const auto one = load_recording(folder / "trials-trial1.csv");
    EXPECT_EQ(one.names, std::vector<std::string>{"fz"});
    EXPECT_EQ(one.force[0].size(), 100U);
    EXPECT_TRUE(has_note(one, "'trial' was ignored: it identifies trials"));
    EXPECT_TRUE(has_note(load_recording(folder / "trials.csv", {.rate = 100}),
                         "the times in 'time' decrease (by up to 990 ms), as in a file with several"));
}

TEST(LoggerFiles, TrialsAreExtractedForAnySeparator) {
    for (const std::string separator : {";", "\t", " ", " , "}) {
        const TemporaryFolder folder;
        std::string text = "# of a study\nn" + separator + "subject" + separator + "t_s" + separator + "F_N\n";
        for (const std::string subject : {"S01", "S02"})
            text += rows_of(30, [&](int, double t, double F) {
                return "7" + separator + subject + separator + fmt::format("{}{}{}\n", t, separator, F);
            });
        const auto message = try_load_recording(folder.write("all.txt", text)).error().text();
        const auto at = message.find("awk ");
        ASSERT_NE(at, message.npos) << message;
        ASSERT_EQ(std::system(("cd '" + folder.path() + "' && " + message.substr(at)).c_str()), 0) << message;
        EXPECT_EQ(load_recording(folder / "all-trial1.txt").force[0].size(), 30U) << message;
    }
}

/// The command at the end of an error text; it begins with `first_word`.
std::string command_in(const std::string& message, const std::string& first_word) {
    const auto at = message.find(first_word);
    return at == message.npos ? "" : message.substr(at);
}

/// Runs the command at the end of the error for a file, and returns the path that the command writes.
std::string run_remedy(const TemporaryFolder& folder, const std::string& file, const std::string& first_word) {
    const auto command = command_in(try_load_recording(folder / file).error().text(), first_word);
    EXPECT_EQ(std::system(("cd '" + folder.path() + "' && " + command).c_str()), 0) << command;
    const auto at = command.rfind("> ");
    return at == command.npos ? "" : folder / command.substr(at + 2);
}

std::string two_trials(const std::string& end_of_line, const std::string& quote) {
    std::string text = "time_s,fz_N,trial" + end_of_line;
    for (int trial = 1; trial <= 2; ++trial)
        text += rows_of(
            10, [&](int, double t, double F) { return fmt::format("{:.2f},{:.2f},{}{}{}", t, F, quote, trial, quote) + end_of_line; });
    return text;
}

TEST(LoggerFiles, ACommandInAMessageNeverOverwritesAFile) {
    const TemporaryFolder folder;
    for (const std::string name : {"trial.csv", "x-trial1.csv", "x.csv"}) {
        folder.write(name, two_trials("\n", ""));
        const auto written = run_remedy(folder, name, "awk ");
        EXPECT_EQ(test::read_file(folder / name), two_trials("\n", "")) << name;
        EXPECT_EQ(load_recording(written).force[0].size(), 10U) << name;
    }
    EXPECT_EQ(folder.file_names().size(), 6U) << "three files, and one trial of each";
    folder.write("lines.csv", "time_s,F_N\r0,1\r1,2\r");
    EXPECT_EQ(load_recording(run_remedy(folder, "lines.csv", "tr ")).force[0], (std::vector<double>{1, 2}));
    EXPECT_EQ(test::read_file(folder / "lines.csv").size(), 19U);
}

TEST(LoggerFiles, TheCommandForOneTrialWorksWithWindowsLinesQuotesUtf16AndGzip) {
    const TemporaryFolder folder;
    const auto as_utf16 = [](const std::string& text) {
        std::string out = "\xff\xfe";
        for (const char c : text) out += c, out += '\0';
        return out;
    };
    for (const auto& text : {two_trials("\r\n", ""), two_trials("\n", "\""), as_utf16(two_trials("\r\n", ""))}) {
        folder.write("x.csv", text);
        EXPECT_EQ(load_recording(run_remedy(folder, "x.csv", text.starts_with("\xff") ? "iconv " : "awk ")).force[0].size(), 10U);
    }
    ASSERT_EQ(std::system(("gzip '" + (folder / "x.csv") + "'").c_str()), 0);
    EXPECT_EQ(load_recording(run_remedy(folder, "x.csv.gz", "zcat ")).force[0].size(), 10U);
    EXPECT_EQ(command_in(error_of(folder, "note,t_s,F_N,trial\n\"a,b\",0,1,1\n\"a,b\",1,1,1\n\"a,b\",0,1,2\n"), "make a"),
              "make a file of each")
        << "awk would split the note";
}

TEST(LoggerFiles, TrialsAreDistinguishedByAColumnThatChangesWhereTimeDecreases) {
    const TemporaryFolder folder;
    std::string text = "subject,trial,t_s,F_N\n";
    for (const std::string rows : {"S1,1", "S1,2", "S2,1"})
        text += rows_of(10, [&](int, double t, double F) { return fmt::format("{},{:.2f},{}\n", rows, t, F); });
    folder.write("x.csv", text);
    EXPECT_NE(try_load_recording(folder / "x.csv").error().text().find("identified by 'trial'"), std::string::npos);
    EXPECT_EQ(load_recording(run_remedy(folder, "x.csv", "awk ")).force[0].size(), 10U);
    EXPECT_EQ(error_of(folder, "t_s,phase,F_N\n0,rest,1\n1,rest,1\n0.5,rest,1\n2,press,1\n"),
              "x.csv:4: the time decreases from 1 s to 0.5 s; use --rate to take the rows as evenly spaced");
}

TEST(LoggerFiles, AColumnNamedAfterAUnitOfTimeIsInThatUnitAndNotAForce) {
    const TemporaryFolder folder;
    for (const auto& [name, step] : {std::pair{"millis", 10}, {"ms", 10}, {"micros", 10'000}, {"Nanoseconds", 10'000'000}}) {
        const auto r = read_logged(folder, name + std::string(",F1\n") +
                                               rows_of(20, [&](int k, double, double F) { return fmt::format("{},{}\n", k * step, F); }));
        EXPECT_NEAR(r.clock.rate(), 100, 1e-6) << name;
        EXPECT_EQ(r.names, std::vector<std::string>{"F1"}) << name;
    }
    const auto stamps = read_logged(folder, "stamp.sec,stamp.nanosec,fz\n5,0,1\n5,500000000,2\n6,0,3\n", {.rate = 2});
    EXPECT_EQ(stamps.names, std::vector<std::string>{"fz"});
    EXPECT_TRUE(has_note(stamps, "'stamp.nanosec' was ignored: ns is not a unit of force"));
}

TEST(LoggerFiles, CountersAnywhereInATableAreNotForces) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, "Status (hex),RDTSequence,FTSequence,k,Fz,Time\n" + rows_of(30, [](int k, double t, double F) {
                                           return fmt::format("0x0,{},{},{},{},{:.2f}\n", 100 + k, 35 * k + k % 3, 7 + k, F, t);
                                       }));
    EXPECT_EQ(r.names, std::vector<std::string>{"Fz"});
    for (const std::string name : {"RDTSequence", "FTSequence", "k"})
        EXPECT_TRUE(has_note(r, "'" + name + "' was ignored: it counts the rows")) << name;
    EXPECT_EQ(read_logged(folder, "Status (hex),Fz,Time\n00000000,1,0\n00000000,2,1\n").names, std::vector<std::string>{"Fz"});
}

TEST(LoggerFiles, SerialDaysOfSpreadsheetsAndMatlabAreTimes) {
    const TemporaryFolder folder;
    for (const auto& [first, message] : {std::pair{45'650.5, "serial days of a spreadsheet; 0 s is 2024-12-24 12:00:00.000"},
                                         {739'000.25, "serial days of MATLAB; 0 s is 2023-04-24 06:00:00.000"}}) {
        std::string text = "Time,F_N\n";
        for (int k = 0; k < 50; ++k) text += fmt::format("{:.11f},{}\n", first + k * 0.01 / 86'400, 0.1 * k);
        const auto r = read_logged(folder, text);
        EXPECT_NEAR(r.clock.rate(), 100, 0.01) << message;
        EXPECT_TRUE(has_note(r, message));
    }
    const auto fast = read_logged(folder, "Time,F_N\n0,1\n1e-7,1\n2e-7,1\n");
    EXPECT_TRUE(has_note(fast, "assuming seconds, which gives a rate of 1e+07 Hz; use --time-unit min if they are minutes"));
    EXPECT_TRUE(has_note(read_logged(folder, "Time,F_N\n0,1\n5000,1\n10000,1\n"), "use --time-unit us if they are microseconds"));
}

TEST(LoggerFiles, TheTimeToReadAFileIsLinearInItsSize) {
    const TemporaryFolder folder;
    const auto seconds = [&](const std::string& text) {
        folder.write("x.json", text);
        return test::processor_time([&] { static_cast<void>(try_load_recording(folder / "x.json", {}, 4096)); });
    };
    const auto columns = [](int rows) {  // as the default of pandas' to_json()
        std::string times, forces;
        for (int k = 0; k < rows; ++k) {
            times += fmt::format("{}\"{}\":{}", k > 0 ? "," : "", k, 0.01 * k);
            forces += fmt::format("{}\"{}\":1", k > 0 ? "," : "", k);
        }
        return "{\"time_s\":{" + times + "},\"fz_N\":{" + forces + "}}";
    };
    const auto quotes = [](std::size_t count) { return "time_s," + std::string(count, '"') + "\n0,1\n1,2\n"; };
    // A file of eight times the size: a linear reader takes 8 times as long, a quadratic one 64 times.
    EXPECT_LT(seconds(columns(80'000)), 24 * seconds(columns(10'000)));
    EXPECT_LT(seconds(quotes(8'000'000)), 24 * seconds(quotes(1'000'000)));
}

TEST(LoggerFiles, OpeningALargeJsonDocumentCanBeStopped) {
    const TemporaryFolder folder;
    std::string text = "[";
    for (int k = 0; k < 20'000; ++k) text += fmt::format("{}{{\"t\":{},\"F_N\":1}}", k > 0 ? "," : "", k);
    int call_count = 0;
    const auto recording =
        try_load_recording(folder.write("x.json", text + "]"), {.should_continue = [&](double) { return ++call_count < 3; }});
    ASSERT_FALSE(recording);
    EXPECT_EQ(recording.error().code, ErrorCode::interrupted);
    EXPECT_EQ(call_count, 3);
}

TEST(LoggerFiles, JsonTrueAndFalseAreNotForces) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, R"([{"t":0,"F_N":1,"contact":true},{"t":1,"F_N":2,"contact":false}])", {}, "x.json");
    EXPECT_EQ(r.names, std::vector<std::string>{"F"});
    EXPECT_TRUE(has_note(r, "'contact' was ignored: it holds words, not numbers"));
}

TEST(LoggerFiles, ASecondSegmentOfALabviewFileEndsWithACommandThatKeepsTheFirst) {
    const TemporaryFolder folder;
    const std::string segment = "Channels\t1\nSamples\t3\n***End_of_Header***\nX_Value\tFz\tComment\n0\t1\n0.01\t2\n0.02\t3\n\n";
    folder.write("first.lvm", "LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tOne\n***End_of_Header***\n\n" + segment + segment);
    for (const auto& options : {RecordingOptions{}, RecordingOptions{.bad_fields = BadFields::drop}, RecordingOptions{.rate = 100}})
        EXPECT_NE(test::load_error(folder / "first.lvm", options).find("another segment of the measurement begins here"),
                  std::string::npos);
    EXPECT_EQ(load_recording(run_remedy(folder, "first.lvm", "head ")).force[0], (std::vector<double>{1, 2, 3}));
}

TEST(LoggerFiles, ColumnsInOtherUnitsBesideAForceAreIgnoredAndCounted) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, "time_s,Load (N),Extension (mm),bridge_V\n0,1,5,2\n1,2,6,2\n");
    EXPECT_EQ(r.names, std::vector<std::string>{"Load"});
    EXPECT_TRUE(has_note(r, "'Extension' was ignored: mm is not a unit of force"));
    EXPECT_NE(error_of(folder, "time_s,load_%\n0,1\n1,2\n").find("'load' is in %, which is not a force"), std::string::npos);
    EXPECT_NE(error_of(folder, "time_s,Load (g)\n0,1\n1,2\n").find("'Load' is in g, which is a mass; use --unit gf"), std::string::npos);
    EXPECT_NEAR(load_recording(folder / "x.csv", {.unit = "gf"}).force[0][1], 2 * 9.80665e-3, 1e-9) << "the remedy";
    std::string heading = "time_s,F_N", first = "0,1", second = "1,2";
    for (int k = 0; k < 31; ++k) heading += fmt::format(",T{}_degC", k), first += ",20", second += ",20";
    EXPECT_TRUE(has_note(read_logged(folder, heading + "\n" + first + "\n" + second + "\n"),
                         "15 more columns were ignored because they hold no force"));
}

TEST(LoggerFiles, NumbersInAnotherNotationAreNamedWithACommandThatRewritesThem) {
    const TemporaryFolder folder;
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {"time_s,fz\n0,\u22121.5\n1,\u22122.5\n", "line 2 has '\u22121.5', which contains a typographic minus sign (U+2212)", "sed "},
        {"time_s,fz\n0,-1.5D+00\n1,-0.25D+01\n", "'-1.5D+00', which contains a Fortran exponent", "sed "},
        {"time_s,fz\n0,-1.5 N\n1,-2.5 N\n", "'-1.5 N', which contains the unit N after the number", "sed "},
        {"time_s|fz_N\n0|-1.5\n1|-2.5\n", "'0|-1.5', which contains '|' as a separator", "sed "},
        {"t:-1 F:-2\nt:0 F:-1.5\nt:1 F:-2.5\n", "'t:0', which contains a name before the number", "sed "},
        {"time_s,fz\n0,0x0A\n1,0x0B\n", "'0x0A', which contains hexadecimal digits; save the table with decimal numbers", ""},
        {"time_s,fz\n0,n/a\n1,n/a\n", "'fz' holds words, not numbers; line 2 has 'n/a'", ""},
    };
    for (const auto& [text, message, first_word] : cases) {
        const auto refused = error_of(folder, text);
        EXPECT_NE(refused.find(message), std::string::npos) << refused;
        if (first_word.empty()) continue;
        const auto repaired = load_recording(run_remedy(folder, "x.csv", first_word)).force[0];
        EXPECT_EQ(std::vector<double>(repaired.end() - 2, repaired.end()), (std::vector<double>{-1.5, -2.5})) << refused;
    }
    EXPECT_NE(error_of(folder, "time_s,fz\n0,5 mN\n1,6 mN\n").find("the unit mN after the number (use --unit mN for the new file)"),
              std::string::npos);
}

TEST(LoggerFiles, ThousandsSeparatorsAreNamedAndManyInterpolatedSamplesCauseAWarning) {
    const TemporaryFolder folder;
    for (const std::string text : {"Zeit (s);Kraft (mN)\n0,0;999,21\n0,1;1.016,21\n0,2;998,50\n",
                                   "t_s,F_mN\n0,999.21\n0.1,\"1,016.21\"\n0.2,998.5\n", "t_s,F_mN\n0,999\n0.1,\"1,016\"\n0.2,998\n"}) {
        const auto message = error_of(folder, text);
        EXPECT_NE(message.find("it contains a thousands separator; save the table without it"), std::string::npos) << message;
        EXPECT_EQ(message.find("--bad-fields"), std::string::npos) << message;
        const auto filled = load_recording(folder / "x.csv", {.bad_fields = BadFields::interpolate});
        EXPECT_TRUE(std::any_of(filled.quality.warnings.begin(), filled.quality.warnings.end(),
                                [](const auto& s) { return s.starts_with("1 of 3 samples were interpolated"); }));
    }
}

TEST(LoggerFiles, AHeaderOfColumnNumbersIsAHeader) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, ",0,1\n" + rows_of(20, [](int k, double t, double F) { return fmt::format("{},{},{}\n", k, t, F); }),
                               {.time = "0"});
    EXPECT_EQ(r.names, std::vector<std::string>{"1"});
    EXPECT_NEAR(r.clock.rate(), 100, 1e-6);
    EXPECT_TRUE(has_note(r, "'ch1' was ignored: it counts the rows (use --channel ch1 to include it)"));
    EXPECT_EQ(load_recording(folder / "x.csv", {.channels = {"ch1"}, .time = "0"}).force[0][7], 7) << "the remedy";
}

TEST(LoggerFiles, APreamblePaddedWithSeparatorsIsSkippedAboveARowOfUnits) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, "Test report;;\nOperator;Max;\nDate;24.12.2024;\n\nTime;Force\n(s);(mN)\n" +
                                           rows_of(20, [](int, double t, double F) { return fmt::format("{:.2f};{:.2f}\n", t, F); }));
    EXPECT_EQ(r.names, std::vector<std::string>{"Force"});
    EXPECT_NEAR(r.clock.rate(), 100, 1e-6);
    EXPECT_NEAR(r.force[0][10], 0.5e-3, 1e-12);
}

TEST(LoggerFiles, RowsAsChannelsMayBeginWithANameAndErrorsNameTheField) {
    const TemporaryFolder folder;
    RecordingOptions rows;
    rows.table.transpose = true;
    const auto named = read_logged(folder, "time_s,0,0.01,0.02\nfx_mN,1,2,3\nfz_N,4,5,6\n", rows);
    EXPECT_EQ(named.names, (std::vector<std::string>{"fx", "fz"}));
    EXPECT_EQ(named.force[1], (std::vector<double>{4, 5, 6}));
    EXPECT_NEAR(named.clock.rate(), 100, 1e-6);
    EXPECT_EQ(test::load_error(folder / "x.csv"),
              "x.csv: every row begins with a name, and the first row is the time; use --transpose to take each row as a channel");
    EXPECT_EQ(error_of(folder, "time_s,0,0.01,0.02\nfz_N,4,,6\n", rows),
              "x.csv:2: field 3 is not a number; use --bad-fields interpolate to fill it in, or --bad-fields drop to skip this sample in "
              "all channels");
    rows.bad_fields = BadFields::interpolate;
    EXPECT_EQ(load_recording(folder / "x.csv", rows).force[0], (std::vector<double>{4, 5, 6})) << "the remedy";
    rows.bad_fields.reset();
    rows.rate = 100;
    EXPECT_EQ(error_of(folder, "0,1,2,,4\n1,2,3,4,5\n", rows).substr(0, 32), "x.csv:1: field 4 is not a number");
}

TEST(LoggerFiles, RateAndUnitOfAJsonDocumentAreUsedAndOtherListsIgnored) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, R"({"fs":200,"unit":"mN","force":[500,1000,1500]})", {}, "x.json");
    EXPECT_EQ(r.clock.rate(), 200);
    EXPECT_NEAR(r.force[0][1], 1, 1e-12);
    const auto tagged = read_logged(folder, R"({"tags":["a","b"],"time_s":[0,1,2],"fz_N":[1,2,3]})", {}, "x.json");
    EXPECT_EQ(tagged.force, (std::vector<std::vector<double>>{{1, 2, 3}}));
    EXPECT_TRUE(has_note(tagged, "'tags' was ignored: it has 2 strings, but the table has 3 rows"));
    EXPECT_EQ(error_of(folder, "[{\"t\":NaN,\"F\":-Infinity},\n{\"t\":NaN,\"F\":}]", {}, "x.json").substr(0, 11), "x.json:2:14");
}

TEST(LoggerFiles, AColumnInSecondsOrMillisecondsIsTheTime) {
    const TemporaryFolder folder;
    for (const std::string heading :
         {"Zeit [s]", "unix_time_s", "t_s", "Elapsed Time (sec)", "Time/s", "duration [s]", "time in s", "stamp_s"}) {
        const auto r =
            read_logged(folder, heading + ";F [N]\n" + rows_of(20, [](int, double t, double F) { return fmt::format("{};{}\n", t, F); }));
        EXPECT_NEAR(r.clock.rate(), 100, 1e-6) << heading;
        EXPECT_EQ(r.names, std::vector<std::string>{"F"}) << heading;
    }
    const auto path = folder.write(
        "x.csv", "Zeit [ms];Kraft [N]\n" + rows_of(20, [](int k, double, double F) { return fmt::format("{};{}\n", 10 * k, F); }));
    EXPECT_NEAR(load_recording(path).clock.rate(), 100, 1e-6);
    for (const std::string time_name : {"Zeit [ms]", "Zeit", "Zeit_ms", "1"})
        EXPECT_NEAR(load_recording(path, {.time = time_name}).clock.rate(), 100, 1e-6) << time_name;
    EXPECT_TRUE(has_note(load_recording(path), "'Zeit' is taken as the time"));
    EXPECT_FALSE(has_note(load_recording(path, {.time = "none", .rate = 10}), "is taken as the time"));
}

TEST(LoggerFiles, AColumnWithATimeLikeNameThatDoesNotIncreaseIsNotATime) {
    const TemporaryFolder folder;
    EXPECT_NE(error_of(folder, "response_time,F_N\n0.3,1\n0.2,2\n0.4,3\n").find("no time column found"), std::string::npos);
}

TEST(LoggerFiles, DatesAndTimesOfDayAreRead) {
    const TemporaryFolder folder;
    const auto clock = [&](const std::string& first, const std::string& second, const std::string& third) {
        return read_logged(folder, "when;F_N\n" + first + ";1\n" + second + ";2\n" + third + ";3\n").clock.rate();
    };
    EXPECT_NEAR(clock("2026-03-01T12:00:00.000Z", "2026-03-01T12:00:00.005Z", "2026-03-01T12:00:00.010Z"), 200, 1e-6);
    EXPECT_NEAR(clock("2026-03-01 12:00:00.000", "2026-03-01 12:00:00.005", "2026-03-01 12:00:00.010"), 200, 1e-6);
    EXPECT_NEAR(clock("2026-03-01T12:00:00,000+01:00", "2026-03-01T12:00:00,005+01:00", "2026-03-01T12:00:00,010+01:00"), 200, 1e-6);
    EXPECT_NEAR(clock("01.03.2026 12:00:00.000", "01.03.2026 12:00:00.005", "01.03.2026 12:00:00.010"), 200, 1e-6);
    EXPECT_NEAR(clock("12:00:00.000", "12:00:00.005", "12:00:00.010"), 200, 1e-6);
    EXPECT_NEAR(clock("23:59:59.995", "00:00:00.000", "00:00:00.005"), 200, 1e-6) << "times of day that pass midnight";
    EXPECT_NEAR(clock("2026-02-28 23:59:59.995", "2026-03-01 00:00:00.000", "2026-03-01 00:00:00.005"), 200, 1e-6);
    const auto r = read_logged(folder, "time,F_N\n2026-03-01T12:00:00,1\n2026-03-01T12:00:01,2\n2026-03-01T12:00:02,3\n");
    EXPECT_EQ(r.clock.t0, 0);
    EXPECT_TRUE(has_note(r, "0 s is 2026-03-01 12:00:00.000, the first time in 'time'"));
    const auto bare = read_logged(folder, "2026-03-01T12:00:00.000,1\n2026-03-01T12:00:00.010,2\n2026-03-01T12:00:00.020,3\n");
    EXPECT_EQ(bare.force[0].size(), 3U) << "without a header the first row is a row";
    const auto two = read_logged(folder, "Date,Time,F_N\n2026-03-01,12:00:00.00,1\n2026-03-01,12:00:00.01,2\n2026-03-01,12:00:00.02,3\n");
    EXPECT_EQ(two.force.size(), 1U);
    EXPECT_NEAR(two.clock.rate(), 100, 1e-6);
}

TEST(LoggerFiles, TimesThatCannotBeReadNameTheRemedyThatWorks) {
    const TemporaryFolder folder;
    const std::string text = "time,F_N\n03/01/2026 12:00,1\n03/01/2026 12:01,2\n";
    EXPECT_NE(
        error_of(folder, text).find("'03/01/2026 12:00' where a number is expected; use --rate, such as --rate 1kHz, to take the rows"),
        std::string::npos);
    EXPECT_EQ(load_recording(folder / "x.csv", {.rate = 1000}).force[0].size(), 2U);
    EXPECT_NE(error_of(folder, "time,F_N\n12:00:00.0,1\n12:00:00.1,2\n", {.time_unit = "ms"}).find("have no unit; omit the option"),
              std::string::npos);
}

TEST(LoggerFiles, TimesSince1970AreRecognisedByTheirSize) {
    const TemporaryFolder folder;
    for (const auto& [start, step, unit] :
         {std::tuple{1772366400.0, 0.01, "s"}, {1772366400e3, 10.0, "ms"}, {1772366400e6, 1e4, "us"}, {1772366400e9, 1e7, "ns"}}) {
        std::string text = "timestamp,F_N\n";
        for (int k = 0; k < 50; ++k) text += fmt::format("{:.2f},{}\n", start + k * step, 0.1 * k);
        const auto r = read_logged(folder, text);
        EXPECT_NEAR(r.clock.rate(), 100, 1e-3) << unit;
        EXPECT_EQ(r.clock.t0, 0) << unit;
        EXPECT_TRUE(has_note(r, fmt::format("are {} since 1970; 0 s is 2026-03-01 12:00:00.000 (UTC)", unit))) << unit;
    }
}

TEST(LoggerFiles, UnitsAfterASlashAndInASeparateRowAreRecognised) {
    const TemporaryFolder folder;
    const auto slash = read_logged(folder, "Time/s,Fz/mN,v/(m/s)\n0,500,1\n1,1000,1\n");
    EXPECT_EQ(slash.names, std::vector<std::string>{"Fz"});
    EXPECT_NEAR(slash.force[0][1], 1, 1e-12);
    EXPECT_TRUE(has_note(slash, "'v' was ignored: m/s is not a unit of force"));
    const auto topics = read_logged(folder, "time,/ft/wrench/force/z,imu/x\n0,1,2\n1,1,2\n");
    EXPECT_EQ(topics.names, (std::vector<std::string>{"/ft/wrench/force/z", "imu/x"})) << "paths are names";
    const auto row = read_logged(folder, "Time;Fz;note\n[s];[mN];-\n0;500;a\n1;1000;b\n");
    EXPECT_EQ(row.names, std::vector<std::string>{"Fz"});
    EXPECT_NEAR(row.force[0][1], 1, 1e-12);
}

TEST(LoggerFiles, LinesBeforeTheTableAreSkippedAndReported) {
    const TemporaryFolder folder;
    const std::string table =
        "time_s,fx_N,fz_N\n" + rows_of(20, [](int, double t, double F) { return fmt::format("{:.2f},1,{}\n", t, F); });
    for (const std::string before :
         {"Subject: S07\n", "Subject,S07\nRate,100\nGain,2\n", "Logger 3\nSubject: S07\nRate: 100\n\n", "a;b;c;d\n\n"}) {
        const auto r = read_logged(folder, before + table);
        EXPECT_EQ(r.names, (std::vector<std::string>{"fx", "fz"})) << before;
        EXPECT_EQ(r.force[0].size(), 20U) << before;
        EXPECT_TRUE(has_note(r, "before the table")) << before;
    }
    const auto short_preamble = read_logged(folder, "Subject,S07\nRate,100\ntime_s,F_N\n0,1\n1,2\n");
    EXPECT_EQ(short_preamble.names, std::vector<std::string>{"F"});
    RecordingOptions skip;
    skip.table.skip_lines = 2;
    EXPECT_EQ(read_logged(folder, "x,y\n1,2\ntime_s,F_N\n0,1\n1,2\n", skip).names, std::vector<std::string>{"F"});
    EXPECT_NE(error_of(folder, "x,y\nfirst,second\n1,2\n3,4\n", {.rate = 10}).find("--skip LINES to skip lines before the table"),
              std::string::npos);
    skip.table.skip_lines = 100;
    EXPECT_EQ(error_of(folder, "x,y\n1,2\n", skip), "x.csv: no data in this file");
    EXPECT_NE(test::load_error(folder.write("x.npy", "?"), skip).find("--skip 100: only text files have lines to skip"), std::string::npos);
}

TEST(LoggerFiles, LineEndsOfOldMacsAreReportedWithTheRemedy) {
    const TemporaryFolder folder;
    const auto message = try_load_recording(folder.write("x.csv", "time_s,F_N\r0,1\r1,2\r")).error().text();
    const auto at = message.find("tr '");
    ASSERT_NE(at, message.npos) << message;
    ASSERT_EQ(std::system(("cd '" + folder.path() + "' && " + message.substr(at)).c_str()), 0);
    EXPECT_EQ(load_recording(folder / "x-lines.csv").force[0], (std::vector<double>{1, 2}));
}

TEST(LoggerFiles, ATruncatedOrDamagedTableIsNotTakenForAPreamble) {
    const TemporaryFolder folder;
    const std::string table = rows_of(20, [](int, double t, double F) { return fmt::format("{:.2f},{}\n", t, F); });
    EXPECT_NE(error_of(folder, "t,F\n" + table + "0.2").find("x.csv:22: 1 columns where 2 are expected"), std::string::npos);
    EXPECT_NE(error_of(folder, "t,F\n0,1\n\n0.1,2,3\n0.2,3,4\n0.3,4,5\n").find("x.csv:4: 3 columns where 2 are expected"),
              std::string::npos);
    EXPECT_NE(error_of(folder, "time,force\n0,1,5\n0.1,2,6\n0.2,2,6\n").find("x.csv:2: 3 columns where 2 are expected"), std::string::npos);
}

TEST(LoggerFiles, LabviewTablesAreReadWithTheirClockUnitsAndComments) {
    const TemporaryFolder folder;
    const auto lvm = [&](const std::string& x, const std::string& rows) {
        return read_logged(
            folder,
            "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\nX_Columns\t" + x +
                "\n***End_of_Header***\t\n\t\nChannels\t2\t\t\nY_Unit_Label\tmN\tmN\t\nX_Dimension\tTime\tTime\t\nDelta_X\t0,01\t0,01"
                "\t\n***End_of_Header***\t\t\t\n" +
                rows,
            {}, "x.lvm");
    };
    const auto one = lvm("One", "X_Value\tFz\tFx\tComment\n0,00\t500\t1\tfirst\n0,01\t600\t2\n0,02\t700\t3\t\n");
    EXPECT_EQ(one.names, (std::vector<std::string>{"Fz", "Fx"}));
    EXPECT_NEAR(one.force[0][2], 0.7, 1e-12);
    EXPECT_NEAR(one.clock.rate(), 100, 1e-9);
    const auto none = lvm("No", "X_Value\tFz\tFx\tComment\n\t500\t1\tfirst\n\t600\t2\n\t700\t3\t\n");
    EXPECT_EQ(none.names, (std::vector<std::string>{"Fz", "Fx"}));
    EXPECT_NEAR(none.clock.rate(), 100, 1e-9) << "the clock is from Delta_X";
    const auto two = lvm("Multi", "X_Value\tFz\tX_Value\tFx\tComment\n0,00\t500\t0,00\t1\n0,01\t600\t0,01\t2\n0,02\t700\t0,02\t3\n");
    EXPECT_EQ(two.names, (std::vector<std::string>{"Fz", "Fx"}));
    EXPECT_NE(error_of(folder, "LabVIEW Measurement\nSeparator\tTab\n", {}, "x.lvm").find("this LabVIEW file has no table"),
              std::string::npos);
}

TEST(LoggerFiles, AnIndexColumnIsIgnoredAndReported) {
    const TemporaryFolder folder;
    const auto line = [](int k, double t, double F) { return fmt::format("{},{:.2f},{:.3f}\n", k, t, F); };
    const auto pandas = read_logged(folder, ",time_s,fz_N\n" + rows_of(30, line));
    EXPECT_EQ(pandas.names, std::vector<std::string>{"fz"});
    EXPECT_TRUE(has_note(pandas, "'ch1' was ignored: it counts the rows (use --channel 1 to include it)"));
    EXPECT_EQ(load_recording(folder / "x.csv", {.channels = {"1"}}).force[0][7], 7) << "the remedy";
    EXPECT_EQ(load_recording(folder / "x.csv", {.channels = {"1-2"}}).names, std::vector<std::string>{"fz"});
    EXPECT_EQ(read_logged(folder, "sample,time_s,fz_N\n" + rows_of(3, line)).names, std::vector<std::string>{"fz"});
    EXPECT_EQ(read_logged(folder, "sample,fz_N\n0,1\n1,1\n0,2\n1,2\n", {.rate = 10}).names, std::vector<std::string>{"fz"})
        << "restarts in each trial";
    EXPECT_EQ(read_logged(folder, "k,time_s,fz_N\n" + rows_of(30, line)).names, std::vector<std::string>{"fz"});
    EXPECT_EQ(read_logged(folder, "k,time_s,fz_N\n" + rows_of(3, line)).names, (std::vector<std::string>{"k", "fz"}))
        << "too few rows to decide";
    EXPECT_EQ(read_logged(folder, "F_N\n1\n2\n3\n4\n5\n6\n7\n8\n9\n", {.rate = 10}).names, std::vector<std::string>{"F"})
        << "the only column";
    EXPECT_EQ(
        read_logged(folder, "a_N,b_N\n" + rows_of(30, [](int k, double, double F) { return fmt::format("{},{}\n", k, F); }), {.rate = 10})
            .names,
        (std::vector<std::string>{"a", "b"}))
        << "a column in newtons is a force whether or not it increases";
    const auto timed =
        read_logged(folder, ",fz_N\n" + rows_of(30, [](int, double t, double F) { return fmt::format("{:.2f},{}\n", t, F); }));
    EXPECT_EQ(timed.names, std::vector<std::string>{"fz"});
    EXPECT_NEAR(timed.clock.rate(), 100, 1e-6) << "an unnamed index of times";
}

TEST(LoggerFiles, AColumnInAUnitOtherThanForceIsNeverTakenAsNewtons) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, "time_s,fz,temp_C,Tx [Nm],angle_deg\n0,1,31,2,3\n1,2,31,2,3\n");
    EXPECT_EQ(r.names, std::vector<std::string>{"fz"});
    EXPECT_TRUE(has_note(r, "'temp' was ignored: C is not a unit of force (if the header is wrong, use --channel 2 --unit N)"));
    EXPECT_EQ(load_recording(folder / "x.csv", {.channels = {"2"}, .unit = "N"}).force[0][0], 31) << "the remedy";
    EXPECT_EQ(load_recording(folder / "x.csv", {.scale = 2}).names, std::vector<std::string>{"fz"}) << "nor does a scale make it one";
    EXPECT_TRUE(
        has_note(read_logged(folder, "time_s,fz_N,humidity [%]\n0,1,2\n1,1,2\n"), "'humidity' was ignored: % is not a unit of force"));
    EXPECT_NE(error_of(folder, "time_s,temp_C\n0,1\n1,1\n").find("'temp' is in C"), std::string::npos);
    EXPECT_EQ(read_logged(folder, "time_s,left_A,left_C,left_F\n0,1,2,3\n1,1,2,3\n").names,
              (std::vector<std::string>{"left_A", "left_C", "left_F"}))
        << "letters that name sensors";
    EXPECT_EQ(read_logged(folder, "time_s,force_min,force_max\n0,1,2\n1,1,2\n").names,
              (std::vector<std::string>{"force_min", "force_max"}));
}

TEST(LoggerFiles, ACommentWithAsManyFieldsAsTheDataIsTheHeader) {
    const TemporaryFolder folder;
    const auto ros = read_logged(folder, "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.wrench.force.z\n" +
                                             rows_of(30, [](int k, double, double F) {
                                                 const auto t = 1772366400000000000 + 10'000'000LL * k;
                                                 return fmt::format("{},{},{},base,{}\n", t, k, t, F);
                                             }));
    EXPECT_EQ(ros.names, std::vector<std::string>{"field.wrench.force.z"});
    EXPECT_EQ(ros.force[0].size(), 30U) << "the header is not one of the rows";
    EXPECT_NEAR(ros.clock.rate(), 100, 1e-3);
    EXPECT_EQ(read_logged(folder, "# made by hand, twice\ntime,force\n0,1\n1,2\n").names, std::vector<std::string>{"force"})
        << "the line of words below the comment is the header";
}

TEST(LoggerFiles, WordsAndEmptyColumnsAreIgnoredAndEmptyFieldsNameTheRemedy) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, "time_s,fz_N,phase,notes\n0,1,rest,\n1,2,press,\n2,3,press,\n");
    EXPECT_EQ(r.names, std::vector<std::string>{"fz"});
    EXPECT_TRUE(has_note(r, "'phase' was ignored: it holds words, not numbers"));
    EXPECT_TRUE(has_note(r, "'notes' was ignored: it is empty"));
    EXPECT_EQ(
        error_of(folder, "time_s,fz_N\n0,1\n1,\n2,3\n"),
        "x.csv:3:3: column 'fz': an empty field where a number is expected; use --bad-fields interpolate to fill it in, or --bad-fields "
        "drop to skip the row");
    EXPECT_EQ(load_recording(folder / "x.csv", {.bad_fields = BadFields::interpolate}).force[0], (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(error_of(folder, "time_s,phase\n0,rest\n1,press\n"),
              "x.csv: no column holds force values: 'phase' holds words, not numbers; line 2 has 'rest'");
}

TEST(LoggerFiles, ChannelsMayBeRangesOfNamesAndNumbersAreReportedByName) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "time_s,Channel 0_N,Channel 1_N,Channel 2_N,\"a,b_N\"\n0,1,2,3,4\n1,1,2,3,4\n");
    const auto counted = load_recording(path, {.channels = {"2-3"}});
    EXPECT_TRUE(has_note(counted, "--channel 2-3 is 'Channel 1' to 'Channel 2'"));
    for (const auto* range : {"'Channel 1'-'Channel 2'", "Channel 1-Channel 2", "Channel 1_N-Channel 2"})
        EXPECT_EQ(load_recording(path, {.channels = {range}}).names, counted.names) << range;
    EXPECT_EQ(load_recording(path, {.channels = {"a,b"}}).names, std::vector<std::string>{"a,b"});
}

TEST(LoggerFiles, ATimeUnitThatContradictsTheHeaderIsReported) {
    const TemporaryFolder folder;
    const auto r = read_logged(folder, "time_s,F_N\n0,1\n1,2\n2,3\n", {.time_unit = "ms"});
    EXPECT_NEAR(r.clock.rate(), 1000, 1e-9);
    EXPECT_TRUE(has_note(r, "--time-unit ms overrides the unit of 'time' in the header, s"));
}

std::string gzipped(const std::string& text) {
    std::string out(text.size() + 1000, '\0');
    z_stream z{};
    ::deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data())), z.avail_in = static_cast<uInt>(text.size());
    z.next_out = reinterpret_cast<Bytef*>(out.data()), z.avail_out = static_cast<uInt>(out.size());
    ::deflate(&z, Z_FINISH);
    out.resize(z.total_out);
    ::deflateEnd(&z);
    return out;
}

TEST(LoggerFiles, GzipIsDecompressedInChunksAndDamageIsReported) {
    const TemporaryFolder folder;
    const auto text = "time_s,F_N\n" + rows_of(60'000, [](int, double t, double F) { return fmt::format("{:.2f},{:.2f}\n", t, F); });
    const auto uncompressed = read_logged(folder, text);
    EXPECT_EQ(read_logged(folder, gzipped(text), {}, "x.csv.gz").force, uncompressed.force);
    const auto half = text.find("300.00,");
    EXPECT_EQ(read_logged(folder, gzipped(text.substr(0, half)) + gzipped(text.substr(half)), {}, "x.csv.gz").force, uncompressed.force)
        << "a file of two gzip members";
    EXPECT_EQ(read_logged(folder, gzipped(text) + std::string(512, '\0'), {}, "x.csv.gz").force, uncompressed.force) << "padded with zeros";
    auto complete = gzipped(text);
    EXPECT_NE(error_of(folder, complete.substr(0, complete.size() / 2), {}, "x.gz").find("this gzip file is incomplete"),
              std::string::npos);
    complete[complete.size() / 2] ^= 0x55;
    EXPECT_NE(error_of(folder, complete, {}, "x.gz").find("this gzip file is damaged"), std::string::npos);
    EXPECT_NE(error_of(folder, gzipped(text) + "more", {}, "x.gz").find("this gzip file is damaged"), std::string::npos);
    EXPECT_NE(error_of(folder, gzipped("\x93NUMPY..."), {}, "x.npy.gz").find("decompress it first: gzip -dk "), std::string::npos);
}

TEST(LoggerFiles, AGzipBombIsRefusedAtTheLimitOfALine) {
    const TemporaryFolder folder;
    EXPECT_NE(error_of(folder, gzipped(std::string(80'000'000, '1')), {}, "x.gz").find("the line is longer than 64 MB"), std::string::npos);
}

std::string utf16(const std::string& ascii, bool big, bool mark) {
    std::string out = mark ? (big ? "\xfe\xff" : "\xff\xfe") : "";
    for (const char c : ascii) (big ? (out += '\0') += c : (out += c) += '\0');
    return out;
}

TEST(LoggerFiles, Utf16IsReadWithAndWithoutItsMark) {
    const TemporaryFolder folder;
    for (const bool big : {false, true})
        for (const bool mark : {false, true}) {
            const auto r = read_logged(folder, utf16("time_s\tF_N\r\n0\t1\r\n1\t2\r\n", big, mark));
            EXPECT_EQ(r.names, std::vector<std::string>{"F"});
            EXPECT_EQ(r.force[0], (std::vector<double>{1, 2}));
        }
    const auto letters =
        utf16("time_s,", false, true) + std::string("\x4b\x00\x3d\xd8\x4b\xdc,\x00", 8) + utf16("x\n0,1,2\n1,2,3\n", false, false);
    EXPECT_EQ(read_logged(folder, letters).names.at(0), "K\xf0\x9f\x91\x8b") << "a pair of surrogates";
    EXPECT_NE(error_of(folder, utf16("t,F\n0,1\n", false, true) + "x").find("ends within a character"), std::string::npos);
}

TEST(LoggerFiles, JsonIsReadAsLinesAListOrColumns) {
    const TemporaryFolder folder;
    for (const std::string text :
         {R"({"t":0,"fz_N":1.5,"name":"x"}
{"t":0.5,"fz_N":2.5,"name":"y"}
{"t":1,"fz_N":3.5,"name":"z"}
)",
          R"([{"t":0,"fz_N":1.5}, {"t":0.5,"fz_N":2.5},
 {"t":1,"fz_N":3.5}])",
          R"({"t":[0,0.5,1],"fz_N":[1.5,2.5,3.5],"subject":"S07"})", R"({"t":{"0":0,"1":0.5,"2":1},"fz_N":{"0":1.5,"1":2.5,"2":3.5}})",
          R"({"columns":["t","fz_N"],"index":[0,1,2],"data":[[0,1.5],[0.5,2.5],[1,3.5]]})",
          R"({"samples":[{"t":0,"fz_N":1.5},{"t":0.5,"fz_N":2.5},{"t":1,"fz_N":3.5}]})"}) {
        const auto r = read_logged(folder, text, {}, "x.json");
        EXPECT_EQ(r.names, std::vector<std::string>{"fz"}) << text;
        EXPECT_EQ(r.force[0], (std::vector<double>{1.5, 2.5, 3.5})) << text;
        EXPECT_EQ(r.clock.rate(), 2) << text;
    }
    const auto nested = read_logged(folder,
                                    "{\"stamp\":\"2026-03-01T12:00:00Z\",\"force\":{\"z\":1},\"taxels\":[2,3]}\n"
                                    "{\"stamp\":\"2026-03-01T12:00:01Z\",\"force\":{\"z\":2},\"taxels\":[4,5]}\n");
    EXPECT_EQ(nested.names, (std::vector<std::string>{"force.z", "taxels.1", "taxels.2"}));
    EXPECT_EQ(nested.force[2], (std::vector<double>{3, 5}));
    const auto split = read_logged(folder, R"({"columns":["f"],"data":[[1],[2],[3]],"fs":4,"unit":"mN"})", {}, "x.json");
    EXPECT_EQ(split.clock.rate(), 4);
    EXPECT_EQ(split.force[0], (std::vector<double>{1e-3, 2e-3, 3e-3}));
    const auto rows = read_logged(folder, "[[1,2],[3,4],[5,6]]", {.rate = 10});
    EXPECT_EQ(rows.force, (std::vector<std::vector<double>>{{1, 3, 5}, {2, 4, 6}}));
}

TEST(LoggerFiles, AnErrorInAJsonDocumentNamesItsRecordAndNoLine) {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "x.json", R"([{"t":"2026-03-01T12:00:00Z","f":1},{"t":"2026-03-01T12:00:01Z","f":2},{"t":"2025-03-01T12:00:02Z","f":1}])");
    EXPECT_EQ(test::load_error(path, {.unit = "N"}).find("x.json: record 3: the time decreases from 1 s to "), 0U)
        << test::load_error(path, {.unit = "N"});
}

TEST(LoggerFiles, JsonThatIsNotATableIsRefusedWithItsLocation) {
    const TemporaryFolder folder;
    const std::pair<std::string, std::string> cases[] = {
        {"{\"t\":0,\"F\":1}\n{\"t\":1,\"F\":}\n", "x.json:2:12: this JSON is not valid"},
        {"{\"t\":0,\"F\":1}\n{\"t\":1,\"F\":null}\n{\"t\":2,\"F\":1}\n",
         "x.json:2: record 2: 'F' is not a number; use --bad-fields interpolate"},
        {"{\"t\":0,\"F\":1}\n{\"t\":1,\"F\":NaN}\n{\"t\":2,\"F\":1}\n", "x.json:2: record 2: 'F' is not a number"},
        {"{\"a\":[1,2],\"b\":[1]}", "'a' has 2 values and 'b' has 1"},
        {"{\"a\":1,\"b\":{\"c\":2}}", "no table in this JSON"},
        {std::string(1000, '[') + std::string(1000, ']'), "nested more than 16 deep"},
        {"{\"t\":0,\"F\":1e999}\n{\"t\":1,\"F\":1}\n", "a number that is too large"},
        {"[{\"t\":0,\"F\":1},{\"t\":1,", "this JSON is not valid"},
        {"[{\"t\":0,\"F\":1},\n{\"t\":1,\"F\n\":2}]", "x.json:2:10: this JSON is not valid"},
    };
    for (const auto& [text, message] : cases)
        EXPECT_NE(error_of(folder, text, {}, "x.json").find(message), std::string::npos) << error_of(folder, text, {}, "x.json");
    folder.write("x.json", "{\"t\":0,\"F\":1}\n{\"t\":1,\"F\":null}\n{\"t\":2,\"F\":3}\n");
    EXPECT_EQ(load_recording(folder / "x.json", {.bad_fields = BadFields::interpolate}).force[0], (std::vector<double>{1, 2, 3}));
}

TEST(LoggerFiles, FilesOfOtherProgramsAreNamedWithACommandThatConvertsThem) {
    const TemporaryFolder folder;
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {"x.xlsx", std::string("PK\x03\x04 [Content_Types].xml\0", 24), "pandas.read_excel('"},
        {"x.parquet", "PAR1....", "pandas.read_parquet('"},
        {"x.feather", "ARROW1..", "pandas.read_feather('"},
        {"x.tdms", std::string("TDSm\x0e\0\0\0", 8), "nptdms.TdmsFile.read('"},
        {"x.pkl", "\x80\x04\x95....", "pandas.read_pickle('"},
        {"v5.mat", "MATLAB 5.0 MAT-file, Platform: GLNXA64", "scipy.io.loadmat('"},
        {"x.bag", "#ROSBAG V2.0\n", "rostopic echo -p -b "},
        {"x.csv.bz2", "BZh91AY", "bzip2 -dk "},
        {"x.zip", std::string("PK\x03\x04 x.csv\0", 11), "unzip "},
        {"x.dat", "\x89HDF\r\n", "x.h5"},
        {"x.bin", std::string("ab\0cd", 5), "not a text file: it contains NUL bytes"},
    };
    for (const auto& [name, bytes, message] : cases)
        EXPECT_NE(error_of(folder, bytes, {}, name).find(message), std::string::npos) << error_of(folder, bytes, {}, name);
}

/// The command at the end of a message that says how to convert a file.
std::string command_in(const std::string& message) {
    const auto at = message.find("convert it like this: ");
    return at == std::string::npos ? "" : message.substr(at + 22);
}

int run_command(const TemporaryFolder& folder, const std::string& command) {
    return std::system(("cd '" + folder.path() + "' && { " + command + "; } >/dev/null 2>&1").c_str());
}

TEST(LoggerFiles, CompressedFilesAreDecompressedByTheCommandInTheMessage) {
    const std::string table = "time_s,fz_N\n0,1\n0.01,2\n0.02,3\n";
    for (const auto& [program, extension] : {std::pair{"bzip2", ".bz2"}, {"xz", ".xz"}, {"zstd", ".zst"}}) {
        const TemporaryFolder folder;
        if (run_command(folder, fmt::format("command -v {}", program)) != 0) continue;
        folder.write("plain", table);
        for (const auto& [name, unpacked] :
             {std::pair{"x.csv" + std::string(extension), "x.csv"}, {"data", "data-unpacked"}, {"a b.csv", "a b-unpacked"}}) {
            ASSERT_EQ(run_command(folder, fmt::format("{} -c < plain > '{}'", program, name)), 0);
            const auto refused = try_load_recording(folder / name);
            ASSERT_FALSE(refused);
            const auto command = command_in(refused.error().text());
            ASSERT_EQ(run_command(folder, command), 0) << command;
            EXPECT_EQ(test::read_file(folder / unpacked), table) << command;
        }
    }
}

TEST(LoggerFiles, PythonCommandsAreComplete) {
    const TemporaryFolder folder;
    if (run_command(folder, "command -v python3") != 0) GTEST_SKIP() << "no python3 here";
    for (const auto& [name, bytes] : {std::pair{"x.xlsx", std::string("PK\x03\x04 [Content_Types].xml")},
                                      {"x y.parquet", std::string("PAR1")},
                                      {"x.feather", std::string("ARROW1")},
                                      {"x.tdms", std::string("TDSm")},
                                      {"x.mat", std::string("MATLAB 5.0 MAT-file")},
                                      {"x.pkl", std::string("\x80\x04")}}) {
        const auto command = command_in(error_of(folder, bytes, {}, name));
        ASSERT_TRUE(command.starts_with("python3 -c \"")) << command;
        const auto code = "compile(\\\"\\\"\\\"" + command.substr(12, command.size() - 13) + "\\\"\\\"\\\", 'x', 'exec')";
        EXPECT_EQ(run_command(folder, "python3 -c \"" + code + "\""), 0) << command;
    }
}

TEST(LoggerFiles, AMatlabVectorOfTimesBesideTheForceIsItsClock) {
    const TemporaryFolder folder;
    const auto doubles = [](std::size_t count, double step) {
        std::string bytes;
        for (std::size_t k = 0; k < count; ++k) {
            const double x = static_cast<double>(k) * step;
            bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
        }
        return bytes;
    };
    const auto archive = make_archive({{"t_s.npy", test::npy_bytes("'<f8'", "(1, 50)", doubles(50, 0.01))},
                                       {"force_N.npy", test::npy_bytes("'<f8'", "(1, 50)", doubles(50, 0.1))}});
    const auto read = load_recording(folder.write("m.npz", test::value_or_throw(archive)));
    EXPECT_NEAR(read.clock.rate(), 100, 1e-6);
    EXPECT_EQ(read.force[0][10], 1);
}

}  // namespace
}  // namespace corpuscle
