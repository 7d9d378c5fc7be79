// Real recordings: every command of doc/real-recordings.md, the errors for a wrong first command, and raw files compared with cleaned ones.

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

const std::string recordings_root = test::source_root();

using test::run_program;

/// Links the folders of the recordings into `folder`.
void link_recordings(const TemporaryFolder& folder) {
    for (const char* name : {"grip_force_ati", "gait_insole_vgrf", "fbg_eskin_press", "fabric_slide_cpm"})
        std::filesystem::create_symlink(std::filesystem::absolute(test::shared_file_path(name)), folder / name);
    std::filesystem::create_symlink(recordings_root + "/examples", folder / "examples");
}

std::vector<std::string> documented_commands() {
    std::istringstream text(test::read_file(recordings_root + "/doc/real-recordings.md"));
    std::vector<std::string> out;
    for (std::string line; std::getline(text, line);) {
        if (!line.starts_with("corpuscle ")) continue;
        out.push_back(line.substr(std::string("corpuscle ").size()));
    }
    return out;
}

TEST(RealRecordings, EveryFileOfEverySetHasACommandThatReadsIt) {
    CORPUSCLE_NEEDS(test::shared_file_path("grip_force_ati"));
    const TemporaryFolder folder;
    link_recordings(folder);
    std::string all;
    for (const auto& arguments : documented_commands()) {
        const auto ran = run_program(folder, arguments);
        EXPECT_EQ(ran.status, 0) << arguments << '\n' << ran.err;
        all += arguments + " ";
        if (arguments.find("--report") != std::string::npos) {
            EXPECT_TRUE(std::filesystem::exists(folder / "answer/report.html")) << arguments;
        }
    }
    for (const char* set : {"grip_force_ati", "gait_insole_vgrf", "fbg_eskin_press", "fabric_slide_cpm"})
        for (const auto& file : std::filesystem::directory_iterator(test::shared_file_path(set))) {
            const auto name = file.path().filename().string();
            if (name.ends_with(".csv") || (name.ends_with(".txt") && name != "ATTRIBUTION.txt")) {
                EXPECT_NE(all.find(name), std::string::npos) << name << " has no command";
            }
        }
}

/// Simulates both chips under one sensor of each set that takes only seconds.
TEST(RealRecordings, AreSimulatedByTheChips) {
    CORPUSCLE_NEEDS(test::shared_file_path("fbg_eskin_press"));
    const TemporaryFolder folder;
    link_recordings(folder);
    for (const std::string arguments : {"fbg_eskin_press/fbg_press_S6_T16.csv --rate 100Hz --scale 40 --channel 11",
                                        "fabric_slide_cpm/Board10mm_F150_V-5mmps_0.csv --time-unit ms --channel 3 --scale 0.01"}) {
        const auto ran = run_program(folder, "respond " + arguments + " --afferent sa1,sa1-circuit,fa1-circuit --json");
        ASSERT_EQ(ran.status, 0) << arguments << ran.err;
        const auto summary = nlohmann::json::parse(ran.out);
        EXPECT_EQ(summary["work"]["circuits"]["not_converged"], 0);
        std::map<std::string, double> spikes;
        for (const auto& r : summary["rates"]) spikes[r["afferent"]] += r["spikes"].get<double>();
        EXPECT_GT(spikes["sa1-circuit"], 50) << arguments;
        EXPECT_NEAR(spikes["sa1-circuit"], spikes["sa1"], 0.6 * spikes["sa1"]) << arguments;
    }
}

TEST(RealRecordings, AWrongFirstCommandGetsTheRemedy) {
    CORPUSCLE_NEEDS(test::shared_file_path("grip_force_ati"));
    const TemporaryFolder folder;
    link_recordings(folder);
    const struct {
        const char *arguments, *message;
    } cases[] = {
        {"fbg_eskin_press/fbg_press_S6_T16.csv", "'fbg01' is in nm, which is not a force; use --scale S"},
        {"fbg_eskin_press/fbg_press_S6_T16.csv --scale 40",
         "Use --rate 100.04Hz to take the samples as evenly spaced, or --resample 100Hz"},
        {"fbg_eskin_press/motor_spikes_S6_T16.csv", "this file holds spikes, not force; 'corpuscle compare' reads it"},
        {"gait_insole_vgrf/GaCo01_01.txt", "but the thesis's models are fitted to 0.2 to 4 N; use --scale S"},
        {"gait_insole_vgrf/GaCo01_01.txt",
         "'ch17' is the sum of 'ch1' to 'ch8', not a sensor of its own; use --channel or --layout to exclude it"},
        {"grip_force_ati/grip_02_raw.csv", "give a rate, such as --rate 1kHz"},
        {"grip_force_ati/grip_02_raw.csv --rate 242.6Hz -c Fz", "are isolated outliers, probably transmission errors"},
        {"grip_force_ati/grip_02_clean.csv -c 1 --scale 0.002", "hum at 50 Hz is"},
        {"fabric_slide_cpm/Linen_F120_V20mmps_0.csv", "use --time-unit ms if they are milliseconds"},
        {"fabric_slide_cpm/Linen_F120_V20mmps_0.csv", "'proximity2' is 65535, the full scale of a 16-bit converter"},
    };
    for (const auto& c : cases) {
        const auto ran = run_program(folder, std::string("respond ") + c.arguments);
        EXPECT_NE(ran.err.find(c.message), std::string::npos) << c.arguments << '\n' << ran.err;
    }
}

/// Numbers of spikes of "afferent,channel" in time windows [edges[k], edges[k + 1]), s. `afferent` of a skin: without the number.
std::map<std::string, std::vector<int>> count_spikes(const std::string& path, const std::vector<double>& edges) {
    std::map<std::string, std::vector<int>> counts;
    std::istringstream text(test::read_file(path));
    for (std::string line; std::getline(text, line);) {
        const auto comma = line.rfind(',');
        if (comma == line.npos || line.ends_with("time_s")) continue;
        const auto window = std::upper_bound(edges.begin(), edges.end(), std::stod(line.substr(comma + 1))) - edges.begin();
        auto key = line.substr(0, comma);
        if (const auto number = key.find('#'); number != key.npos) key.erase(number, key.find(',') - number);
        auto& all = counts.try_emplace(std::move(key), edges.size() + 1).first->second;
        ++all[static_cast<std::size_t>(window)];
    }
    return counts;
}

/// The documented command that contains this text.
std::string documented_command_with(const std::string& text) {
    for (const auto& command : documented_commands())
        if (command.find(text) != command.npos) return command;
    ADD_FAILURE() << "no command with " << text;
    return "";
}

TEST(RealRecordings, APressOnTheSkinIsFeltByTheRightClassesAndRestIsSilent) {
    CORPUSCLE_NEEDS(test::shared_file_path("fbg_eskin_press"));
    const TemporaryFolder folder;
    link_recordings(folder);
    const auto ran = run_program(folder, documented_command_with("--zero 2s --deadband auto"));
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err.find("the noise of the sensor"), std::string::npos) << ran.err;
    auto counts = count_spikes(folder / "answer/spikes.csv", {17.2, 17.6, 21.05});  // ends of rest, onset and hold
    for (const auto& [name, in] : counts) EXPECT_EQ(in[0], 0) << name << " at rest";
    const auto all = [&](const std::string& afferent, const std::string& channel) {
        return counts.try_emplace(afferent + "," + channel, 4).first->second;
    };
    for (const char* afferent : {"sa1-nerve", "fa1-nerve", "fa2"})
        for (int phase = 1; phase <= 3; ++phase)  // the file ends in the middle of the last phase, the release
            EXPECT_GE(all(afferent, "fbg11")[static_cast<std::size_t>(phase)], phase == 3 ? 1 : 3) << afferent << " in phase " << phase;
    EXPECT_GT(all("sa1-nerve", "fbg11")[2], 100);
    for (const std::string pressed : {"fbg09", "fbg10", "fbg12", "fbg13"}) {
        EXPECT_GE(all("fa1-nerve", pressed)[1], 3) << pressed;
        EXPECT_GE(all("fa1-nerve", pressed)[3], 3) << pressed;
        EXPECT_GT(all("fa2", pressed)[1] + all("fa2", pressed)[3], 3 * all("fa2", pressed)[2]) << pressed;
    }
    for (const std::string distant : {"fbg05", "fbg06", "fbg16", "fbg17", "fbg18", "fbg19", "fbg20", "fbg21"})
        for (const char* afferent : {"sa1-nerve", "fa1-nerve", "fa2"})
            for (const int n : all(afferent, distant)) EXPECT_LE(n, 1) << afferent << distant;
}

TEST(RealRecordings, TheWarningAboutTheNoiseOfTheSkinHasARemedyThatWorks) {
    CORPUSCLE_NEEDS(test::shared_file_path("fbg_eskin_press"));
    const TemporaryFolder folder;
    link_recordings(folder);
    const std::string command =
        "respond fbg_eskin_press/fbg_press_S6_T16.csv --rate 100Hz --scale 40 --afferent fa1-nerve --out out --overwrite ";
    const auto noisy = run_program(folder, command);
    EXPECT_NE(noisy.err.find("is enough to make fa1-nerve fire. Use --zero 500ms --deadband auto"), std::string::npos) << noisy.err;
    for (const auto& [name, in] : count_spikes(folder / "out/spikes.csv", {1, 17})) EXPECT_GT(in[1], 200) << name;
    const auto quiet = run_program(folder, command + "--zero 500ms --deadband auto");
    EXPECT_EQ(quiet.err.find("the noise of the sensor"), std::string::npos) << quiet.err;
    for (const auto& [name, in] : count_spikes(folder / "out/spikes.csv", {17.2})) EXPECT_EQ(in[0], 0) << name;
}

TEST(RealRecordings, ATextureOverTaxelsExcitesTheFastClassesThroughoutTheSlide) {
    CORPUSCLE_NEEDS(test::shared_file_path("fabric_slide_cpm"));
    const TemporaryFolder folder;
    link_recordings(folder);
    const auto per_second = [&](std::string command, double start, int seconds) {
        const auto ran = run_program(folder, command);
        EXPECT_EQ(ran.status, 0) << ran.err;
        std::vector<double> edges;
        for (int k = 0; k <= seconds; ++k) edges.push_back(start + k);
        return count_spikes(folder / "answer/spikes.csv", edges);
    };
    auto slow = per_second(documented_command_with("contact.speed=20mm/s"), 4057535, 29),
         fast = per_second(documented_command_with("contact.speed=100mm/s"), 4283.419, 5);
    auto command = documented_command_with("contact.speed=100mm/s");
    auto still = per_second(command.substr(0, command.find("--set")) + "--out answer", 4283.419, 5);
    for (std::size_t second = 1; second <= 29; ++second) {
        EXPECT_GT(slow["fa1,tip"][second], 1000) << second;
        EXPECT_GT(slow["fa2,tip"][second], 100) << second;
    }
    for (std::size_t second = 1; second <= 5; ++second) {
        EXPECT_GT(fast["fa1,tip"][second], 1000) << second;
        // FA-I are best at 40 Hz, at which bumps pass in the slow slide; FA-II at the 200 Hz of the fast one.
        EXPECT_GT(slow["fa1,tip"][second], fast["fa1,tip"][second]) << second;
        EXPECT_GT(fast["fa2,tip"][second], 5 * slow["fa2,tip"][second]) << second;
        if (second == 1) continue;
        EXPECT_LT(still["fa1,tip"][second], 20) << second;
        EXPECT_NEAR(fast["sa1,tip"][second], still["sa1,tip"][second], 0.05 * still["sa1,tip"][second]) << second;
    }
}

/// The number of spikes of sa1 in each second.
std::map<int, int> by_second(const std::string& path) {
    std::istringstream text(test::read_file(path));
    std::map<int, int> counts;
    for (std::string line; std::getline(text, line);)
        if (line.starts_with("sa1,")) ++counts[static_cast<int>(std::stod(line.substr(line.rfind(',') + 1)))];
    return counts;
}

TEST(RealRecordings, RepairedFilesGiveTheSpikesOfTheCleanedOnes) {
    CORPUSCLE_NEEDS(test::shared_file_path("grip_force_ati"));
    const TemporaryFolder folder;
    link_recordings(folder);
    for (const auto& [file, rate] : {std::pair{"02", "242.64Hz"}, {"04", "242.94Hz"}, {"12", "242.38Hz"}}) {
        const std::string grip = std::string("respond grip_force_ati/grip_") + file;
        const auto raw = run_program(
            folder, grip + "_raw.csv -c Fz --rate " + rate + " --scale 0.002 --range 1..3500 --despike 1000 --notch 50Hz -o raw");
        const auto clean = run_program(folder, grip + "_clean.csv -c fz_abs_counts --scale 0.002 --notch 50Hz -o clean");
        ASSERT_EQ(raw.status + clean.status, 0) << raw.err << clean.err;
        auto ours = by_second(folder / "raw/spikes.csv"), theirs = by_second(folder / "clean/spikes.csv");
        int all = 0, difference = 0;
        for (int second = 0; second < 50; ++second) {
            EXPECT_LE(std::abs(ours[second] - theirs[second]), 2) << file << ", second " << second;
            all += theirs[second], difference += ours[second] - theirs[second];
        }
        EXPECT_GT(all, 700);
        EXPECT_LE(std::abs(difference), 0.035 * all) << file;
    }
}

}  // namespace
}  // namespace corpuscle
