// Every recording option, for respond, for a stream of the same recording, and for live frames.

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/stream/stream.hpp"
#include "io/table/npz.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder;

/// A recording option with a value, for a text file of one channel in mN at 1 kHz; or for the file `recording`.
struct OptionCase {
    std::string option, value;
    std::string more = "";  ///< further options that it needs
    std::string recording = "touch.csv";
};

const OptionCase option_cases[] = {
    {"--rate", "2kHz", "--unit mN"},
    {"--unit", "gf"},
    {"--scale", "2mN"},
    {"--offset", "200", "--unit mN"},
    {"--calibrate", "zero=-100,load=1500@2N", ""},
    {"--abs", "", "--unit mN"},
    {"--notch", "50Hz", "--unit mN"},
    {"--lowpass", "20Hz", "--unit mN"},
    {"--zero", "50ms", "--unit mN"},
    {"--deadband", "150mN", "--unit mN"},
    {"--layout", "layout.csv", "--unit mN"},
    {"--range", "0..1900", "--unit mN"},
    {"--bad-fields", "interpolate", "--unit mN --range 0..1900"},
    {"--channel", "2", "--unit mN", "two.csv"},
    {"--despike", "500", "--unit mN"},
    {"--resample", "2kHz", "--unit mN"},
    {"--interpolation", "smooth", "--unit mN --resample 2kHz"},
    {"--time", "1", "--unit mN", "timed.csv"},
    {"--time-unit", "ms", "--unit mN --time 1", "timed.csv"},
    {"--skip", "2", "--unit mN", "skipped.csv"},
    {"--dataset", "b", "--unit mN", "arrays.npz"},
    {"--transpose", "", "--unit mN", "wide.csv"},
    {"--no-transpose", "", "--unit mN"},
};

/// Readings in mN: presses with a ripple of 50 Hz, negative readings, and an outlier.
std::vector<int> touch_readings() {
    std::vector<int> out;
    for (int k = 0; k < 2000; ++k) out.push_back(k == 700 ? 3000 : k % 500 < 100 ? -100 : 1500 + (k % 20 < 10 ? 200 : -200));
    return out;
}

/// Writes the recordings of the cases.
void write_recordings(const TemporaryFolder& folder) {
    std::string touch, two, timed = "t,f\n", skipped = "5 6\n7 8\n", wide;
    for (int k = 0; const int x : touch_readings()) {
        touch += std::to_string(x) + "\n", skipped += std::to_string(x) + "\n";
        two += "0," + std::to_string(x) + "\n", timed += std::to_string(k++) + "," + std::to_string(x) + "\n";
        wide += (wide.empty() ? "" : ",") + std::to_string(x);
    }
    folder.write("touch.csv", touch), folder.write("two.csv", two), folder.write("timed.csv", timed);
    folder.write("skipped.csv", skipped), folder.write("wide.csv", wide + "\n");
    NpzWriter arrays;
    const auto all = touch_readings();
    arrays.add("a", std::vector<double>(all.size(), 0.0)), arrays.add("b", std::vector<double>(all.begin(), all.end()));
    folder.write("arrays.npz", test::value_or_throw(arrays.bytes()));
    folder.write("layout.csv", "channel,name,x_mm,y_mm\n1,ch1,0,0\n");
}

/// The lines "sa1,0.123" of a spike file, without the names of the channels, which differ between a recording and live frames.
std::vector<std::string> spikes_in(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        if (line.find("time_s") == line.npos) out.push_back(line.substr(0, line.find(',')) + line.substr(line.rfind(',')));
    std::sort(out.begin(), out.end());
    return out;
}

std::string arguments_of(const OptionCase& c) {
    const bool needs_rate = c.option != "--rate" && c.recording != "timed.csv";
    return fmt::format(" {} {} {}{}", c.option, c.value, c.more, needs_rate ? " --rate 1kHz" : "");
}

TEST(ImportOptions, AreAllListedWithTheirEffectOnLiveFrames) {
    const TemporaryFolder folder;
    const auto help = run_program(folder, "stream --help-all").out;
    const auto begin = help.find("\nRecordings:");
    std::istringstream group(help.substr(begin, help.find("\nSpikes:") - begin));
    std::vector<std::string> names = {"--rate"};
    for (std::string line; std::getline(group, line);)
        if (const auto at = line.find("--"); at < 6) names.push_back(line.substr(at, line.find(' ', at) - at));
    std::vector<std::string> listed, tried;
    for (const auto& o : live_options) listed.emplace_back(o.option);
    for (const auto& c : option_cases) tried.push_back(c.option);
    for (auto* all : {&names, &listed, &tried}) std::sort(all->begin(), all->end());
    EXPECT_EQ(listed, names);
    EXPECT_EQ(tried, names);
}

TEST(ImportOptions, TheTableOfTheDocumentIsThatOfTheProgram) {
    const auto document = test::read_file(test::source_root() + "/doc/live.md");
    std::string table = "| option | live frames |\n| --- | --- |\n";
    for (const auto& o : live_options)
        table += fmt::format("| `{}` | {}{} |\n", o.option, o.effect == LiveEffect::refused ? "refused: " : "", o.text);
    EXPECT_NE(document.find(table), document.npos) << table;
}

TEST(ImportOptions, GiveTheSameSpikesForRespondAndForAStreamOfTheRecording) {
    const TemporaryFolder folder;
    write_recordings(folder);
    for (const auto& c : option_cases) {
        const auto offline = run_program(folder, "respond " + c.recording + arguments_of(c) + " -o result --overwrite --quiet");
        ASSERT_EQ(offline.status, 0) << c.option << offline.err;
        const auto stream = run_program(folder, "stream --in " + c.recording + arguments_of(c) + " --pace fast --quiet");
        ASSERT_EQ(stream.status, 0) << c.option << stream.err;
        const auto spikes = spikes_in(test::read_file(folder / "result/spikes.csv"));
        EXPECT_GT(spikes.size(), 10U) << c.option;
        EXPECT_EQ(spikes_in(stream.out), spikes) << c.option;
    }
}

TEST(ImportOptions, GiveTheSpikesOfTheRecordingForLiveFramesOrAreRefusedWithTheReason) {
    const TemporaryFolder folder;
    write_recordings(folder);
    for (const auto& c : option_cases) {
        const auto* const o =
            std::find_if(std::begin(live_options), std::end(live_options), [&](const auto& x) { return x.option == c.option; });
        const auto file = o->effect == LiveEffect::refused ? "touch.csv" : c.recording;
        const auto live = run_program(folder, "stream" + arguments_of(c) + " --quiet < " + file);
        if (o->effect == LiveEffect::refused) {
            EXPECT_EQ(live.status, 2) << c.option;
            EXPECT_NE(live.err.find(o->text), live.err.npos) << c.option << live.err;
            continue;
        }
        ASSERT_EQ(live.status, 0) << c.option << live.err;
        const auto recorded = run_program(folder, "stream --in " + file + arguments_of(c) + " --pace fast --quiet");
        EXPECT_EQ(spikes_in(live.out) == spikes_in(recorded.out), o->effect == LiveEffect::same) << c.option << live.out;
    }
}

TEST(ImportOptions, OfFiltersAreRefusedWithASavedState) {
    const TemporaryFolder folder;
    for (const std::string option : {"--lowpass 20Hz", "--notch 50Hz"}) {
        const auto ran = run_program(folder, "stream --rate 1kHz --save-state s.state " + option + " < /dev/null");
        EXPECT_EQ(ran.status, 2);
        EXPECT_NE(ran.err.find("a saved state does not contain the filters; remove --save-state"), ran.err.npos) << ran.err;
    }
}

TEST(ImportOptions, ANetlistInAStreamIsRefusedWithTheCommandForIt) {
    const TemporaryFolder folder;
    for (const std::string option : {"--population sa1-circuit", "--population sa1,sa1-circuit", "--set sa1-circuit.C_u=4pF"}) {
        const auto ran = run_program(folder, "stream --in press --pace fast " + option);
        EXPECT_EQ(ran.status, 2);
        EXPECT_NE(
            ran.err.find("a stream simulates models, not netlists and NIR graphs; type: corpuscle respond press --afferent sa1-circuit"),
            ran.err.npos)
            << ran.err;
    }
}

}  // namespace
}  // namespace corpuscle
