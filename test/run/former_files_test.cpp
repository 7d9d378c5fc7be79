// Files saved by an earlier version of the program are read, or refused with a remedy. These commands saved them:
//
//   former/press.state        corpuscle stream --rate 1kHz -p sa1 --save-state press.state, after 300 frames of 1 N
//   former/press.checkpoint   corpuscle respond press --set press.t_hold=5000 --set press.F_max=0.6 --population 'grid 1x1'
//                             --checkpoint FILE, interrupted after 0.05 s

#include <filesystem>

#include "support/program.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::read_file, test::run_program, test::TemporaryFolder;

std::string former(const std::string& name) { return test::source_root() + "/test/run/former/" + name; }

std::string frames(int count) {
    std::string text;
    while (count-- > 0) text += "1.0\n";
    return text;
}

TEST(FormerFiles, AStreamContinuesFromTheStateOfAnEarlierVersion) {
    const TemporaryFolder folder;
    folder.write("before.txt", frames(300));
    folder.write("after.txt", frames(700));
    folder.write("all.txt", frames(1000));
    const auto resumed = run_program(folder, "stream --rate 1kHz -p sa1 --resume '" + former("press.state") + "' < after.txt");
    const auto complete = run_program(folder, "stream --rate 1kHz -p sa1 < all.txt");
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_NE(complete.out.find("sa1,ch1,0.5"), std::string::npos) << complete.out;
    EXPECT_EQ(resumed.out, complete.out) << "there is no spike in the first 300 ms";
}

TEST(FormerFiles, ASkinContinuesFromACheckpointOfAnEarlierVersionOrNamesTheRemedy) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(former("press.checkpoint"), folder / "now");
    std::filesystem::copy_file(former("press.checkpoint.spikes"), folder / "now.spikes");
    const std::string arguments = "respond press --set press.t_hold=5000 --set press.F_max=0.6 --population 'grid 1x1'";
    const auto resumed = run_program(folder, arguments + " --checkpoint now -o resumed");
    if (resumed.status != 0) {  // another version number: a checkpoint belongs to the version that wrote it
        EXPECT_EQ(resumed.status, 1);
        EXPECT_NE(resumed.err.find("remove now and now.spikes to start over"), std::string::npos) << resumed.err;
        return;
    }
    EXPECT_NE(resumed.err.find("resuming after"), std::string::npos) << resumed.err;
    ASSERT_EQ(run_program(folder, arguments + " -q -o complete").status, 0);
    EXPECT_EQ(read_file(folder / "resumed/spikes.csv"), read_file(folder / "complete/spikes.csv"));
    EXPECT_EQ(read_file(folder / "resumed/afferents.csv"), read_file(folder / "complete/afferents.csv"));
}

}  // namespace
}  // namespace corpuscle
