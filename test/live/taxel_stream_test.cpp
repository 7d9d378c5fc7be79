// Frames of taxels: live, in batches, resumed, and through the C interface they give the spikes of the recording.

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "corpuscle.h"
#include "live/input/frame_source.hpp"
#include "support/program.hpp"
#include "support/test_paths.hpp"

namespace corpuscle {
namespace {

using test::read_file, test::run_program, test::source_root, test::TemporaryFolder, test::value_or_throw;

/// The spikes "sa1#17,palm,0.123" of a text in the order of its lines, sorted.
std::vector<std::string> sorted_spikes(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        if (line.find("time_s") == line.npos) out.push_back(line);
    std::sort(out.begin(), out.end());
    return out;
}

std::string palm_example() { return fmt::format("--population hand --taxels '{0}/examples/taxels/palm.csv' --rate 1kHz", source_root()); }
std::string palm_recording() { return "'" + source_root() + "/examples/data/palm.csv'"; }

TEST(TaxelStream, LiveFramesGiveTheSpikesOfTheRecording) {
    const TemporaryFolder folder;
    const auto offline = run_program(folder, "respond " + palm_recording() + " " + palm_example() + " -o out --quiet");
    ASSERT_EQ(offline.status, 0) << offline.err;
    const auto spikes = sorted_spikes(read_file(folder / "out/spikes.csv"));
    ASSERT_GT(spikes.size(), 100U);
    const std::vector<std::string> ways = {"< " + palm_recording(), "--in " + palm_recording() + " --pace fast",
                                           "--batch-frames 7 < " + palm_recording()};
    for (const auto& more : ways) {
        const auto live = run_program(folder, "stream --quiet " + palm_example() + " " + more);
        EXPECT_EQ(live.status, 0) << live.err;
        EXPECT_EQ(sorted_spikes(live.out), spikes) << more;
    }
}

TEST(TaxelStream, ARestLevelIsSubtractedLiveAsOffline) {
    const TemporaryFolder folder;
    std::string frames = "a,b\n", zeroed = "a,b\n";
    for (int k = 0; k < 800; ++k) {
        const double press = k < 100 ? 0 : std::min(3.0, 0.02 * (k - 100));
        frames += fmt::format("{},{}\n", 1.5 + press, -0.25 + press / 2), zeroed += fmt::format("{},{}\n", press, press / 2);
    }
    folder.write("frames", frames), folder.write("zeroed", zeroed);
    folder.write("taxels.csv", "name,x_mm,y_mm,width_mm,height_mm\na,3,3,6,6\nb,11,11,6,6\n");
    const std::string skin = " --population 'grid 8x8' --taxels taxels.csv --rate 1kHz --unit N --quiet";
    const auto expected = sorted_spikes(run_program(folder, "stream" + skin + " < zeroed").out);
    ASSERT_GT(expected.size(), 100U);
    EXPECT_EQ(sorted_spikes(run_program(folder, "stream --zero 100ms" + skin + " < frames").out), expected);
    const auto offline = run_program(folder, "respond frames --zero 100ms -o out" + skin);
    EXPECT_EQ(offline.status, 0) << offline.err;
    EXPECT_EQ(sorted_spikes(read_file(folder / "out/spikes.csv")), expected);
}

TEST(TaxelStream, ATextureSlidesLiveAsOffline) {
    const TemporaryFolder folder;
    const std::string texture =
        " --set contact.roughness=0.05 --set contact.grain=1mm --set contact.speed=80mm/s --set contact.t_start=0.1s ";
    const auto offline = run_program(folder, "respond " + palm_recording() + " " + palm_example() + texture + " -o out --quiet");
    ASSERT_EQ(offline.status, 0) << offline.err;
    const auto spikes = sorted_spikes(read_file(folder / "out/spikes.csv"));
    const std::vector<std::string> ways = {"< " + palm_recording(), "--batch-frames 7 < " + palm_recording(),
                                           "--in " + palm_recording() + " --pace fast"};
    for (const auto& more : ways) {
        const auto live = run_program(folder, "stream --quiet " + palm_example() + texture + more);
        EXPECT_EQ(live.status, 0) << live.err;
        EXPECT_EQ(sorted_spikes(live.out), spikes) << more;
    }
    const auto without = sorted_spikes(run_program(folder, "stream --quiet " + palm_example() + " < " + palm_recording()).out);
    EXPECT_NE(spikes, without);
    const auto saved = run_program(folder, "stream --save-state s " + palm_example() + texture + "< " + palm_recording());
    EXPECT_NE(saved.err.find("a saved state does not contain the position of the texture; remove --save-state and --resume"),
              std::string::npos)
        << saved.err;
}

TEST(TaxelStream, AResumedStreamContinuesWithTheLastFrame) {
    const TemporaryFolder folder;
    const auto text = read_file(source_root() + "/examples/data/palm.csv");
    auto split = text.size() / 2;
    split = text.find('\n', split) + 1;
    const auto header = text.substr(text.find("r1c1"), text.find('\n', text.find("r1c1")) + 1 - text.find("r1c1"));
    folder.write("first", text.substr(0, split)), folder.write("second", header + "bad frame\n" + text.substr(split));
    folder.write("all", text.substr(0, split) + "bad frame\n" + text.substr(split));
    const auto stream = "stream --quiet " + palm_example();
    const auto whole = run_program(folder, stream + " < all");
    const auto first = run_program(folder, stream + " --save-state now < first");
    ASSERT_EQ(first.status, 0) << first.err;
    const auto second = run_program(folder, stream + " --resume now < second");
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(sorted_spikes(first.out + second.out), sorted_spikes(whole.out));
    EXPECT_NE(run_program(folder, "stream --population hand --rate 1kHz --resume now < first").err.find("frame of 16 forces"),
              std::string::npos);
}

TEST(TaxelStream, ShearOfThreeAxisTaxelsIsFeltLiveAsOffline) {
    const TemporaryFolder folder;
    folder.write(
        "own.toml",
        "[sites]\nrows = 8\ncolumns = 8\npitch = \"2 mm\"\n[[class]]\nafferent = \"sa1\"\nper_site = 1\nsigma = \"2 mm\"\ndirection_gain "
        "= 0.5\n");
    std::string frames = "b.Fx,b.Fy,b.Fz,a.Fx,a.Fy,a.Fz\n", turned = frames, bare;
    for (int k = 0; k < 600; ++k) {
        const double press = 2 * std::min(1.0, 0.01 * k) + 0.001 * (k % 7), pull = k < 200 ? 0 : 0.5 + 0.01 * (k % 5);
        frames += fmt::format("{},{},{},{},{},{}\n", 0, pull, press, pull, -pull, press);
        turned += fmt::format("{},{},{},{},{},{}\n", pull, 0, -press, -pull, -pull, -press);  // in the axes of the second table
        bare += fmt::format("{},{},{},{},{},{}\n", pull, -pull, press, 0, pull, press);
    }
    folder.write("frames.csv", frames), folder.write("turned.csv", turned), folder.write("bare.csv", bare);
    const std::string columns = "name,x_mm,y_mm,width_mm,height_mm,rotation_deg,x_axis,y_axis,z_axis\n";
    folder.write("taxels.csv", columns + "a,3,3,6,6,20,+x,+y,\nb,8,4,6,6,50,,,\n");
    folder.write("other.csv", columns + "a,3,3,6,6,20,+y,-x,out\nb,8,4,6,6,50,+y,-x,out\n");
    const std::string skin = " --population own.toml --rate 1kHz --unit N --quiet --taxels ";
    const auto offline = run_program(folder, "respond frames.csv -o out" + skin + "taxels.csv");
    ASSERT_EQ(offline.status, 0) << offline.err;
    const auto spikes = sorted_spikes(read_file(folder / "out/spikes.csv"));
    ASSERT_GT(spikes.size(), 100U);
    const std::vector<std::string> ways = {"taxels.csv < frames.csv", "taxels.csv --batch-frames 7 < frames.csv",
                                           "taxels.csv --in frames.csv --pace fast", "taxels.csv < bare.csv"};
    for (const auto& more : ways) EXPECT_EQ(sorted_spikes(run_program(folder, "stream" + skin + more).out), spikes) << more;
    folder.write("normal.csv", "a,b\n1,1\n2,2\n");
    EXPECT_NE(run_program(folder, "respond normal.csv" + skin + "taxels.csv").err.find("the taxels have axes, but normal has one force"),
              std::string::npos);
}

TEST(TaxelStream, MistakesAreErrorsThatNameTheRemedy) {
    const TemporaryFolder folder;
    folder.write("taxels.csv", "name,x_mm,y_mm\na,0,0\nb,2,0\n");
    const std::pair<std::string, std::string> cases[] = {
        {"stream --taxels taxels.csv --rate 1kHz < /dev/null", "--taxels needs a skin; add --population hand"},
        {"respond press --taxels taxels.csv", "--taxels"},
        {"stream --population 'grid 2x2' --taxels taxels.csv --layout x --rate 1kHz < /dev/null", "use --taxels only"},
        {"respond press --population 'grid 2x2' --taxels taxels.csv --contact flat", "use one"},
        {"respond press --population 'grid 2x2' --taxels taxels.csv", "taxels.csv:3:3: press has 1 channel, but taxels.csv has 2 taxels"}};
    for (const auto& [command, message] : cases) {
        const auto ran = run_program(folder, command);
        EXPECT_NE(ran.status, 0) << command;
        EXPECT_NE(ran.err.find(message), std::string::npos) << ran.err;
    }
    folder.write("wide", "1,2,3\n");
    const auto wide = run_program(folder, "stream --population 'grid 2x2' --taxels taxels.csv --rate 1kHz < wide");
    EXPECT_NE(wide.err.find("frame 1 has 3 numbers; 'taxels.csv' has 2 taxels, so a frame must have 2 numbers"), std::string::npos)
        << wide.err;
}

TEST(CHeader, SimulatesFramesOfTaxels) {
    const TemporaryFolder folder;
    const auto file = folder.write("taxels.csv", "name,x_mm,y_mm,width_mm,height_mm\na,3,3,6,6\nb,11,11,6,6\n");
    auto* skin = corpuscle_create_taxels("grid 8x8", file.c_str(), 1000, nullptr, 0);
    ASSERT_TRUE(skin) << corpuscle_error();
    EXPECT_EQ(corpuscle_frame_size(skin), 2U);
    EXPECT_EQ(corpuscle_sites(skin), 64U);
    long count = 0;
    const double frame[] = {3, 2};
    const auto add = [](void* to, const corpuscle_spike*) { ++*static_cast<long*>(to); };
    for (int k = 0; k < 500; ++k) EXPECT_EQ(corpuscle_push(skin, frame, 2, add, &count), 0);
    EXPECT_GT(count, 10);
    EXPECT_EQ(corpuscle_push(skin, frame, 1, add, &count), CORPUSCLE_BAD_INPUT);
    EXPECT_STREQ(corpuscle_error(), "a frame has 1 forces, but those of these taxels have 2");
    corpuscle_destroy(skin);
    EXPECT_EQ(corpuscle_create_taxels("grid 8x8", nullptr, 1000, nullptr, 0), nullptr);
    EXPECT_EQ(corpuscle_create_taxels("sa1", file.c_str(), 1000, nullptr, 0), nullptr);
    EXPECT_NE(std::string(corpuscle_error()).find("taxels need a skin"), std::string::npos) << corpuscle_error();
}

}  // namespace
}  // namespace corpuscle
