// Shear as users give it: recordings of three-axis sensors and tilted contacts, in commands.

#include <fmt/format.h>
#include <algorithm>

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::read_file, test::run_program;

/// A recording of two three-axis sensors at 1 kHz, pressed with 3 N and pulled to the right with `pull` (N) from 0.1 s on.
std::string pulled_grid(double pull) {
    std::string out = "time_s,r1c1.Fx_N,r1c1.Fy_N,r1c1.Fz_N,r1c2.Fx_N,r1c2.Fy_N,r1c2.Fz_N\n";
    for (int k = 0; k < 500; ++k) out += fmt::format("{:.3f},{},0,{},0,0,0\n", k * 1e-3, k < 100 ? 0 : pull, k < 100 ? 0 : 3);
    return out;
}

/// The number of lines.
long lines_in(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(ShearProgram, APopulationFeelsTheShearOfARecording) {
    const TemporaryFolder folder;
    folder.write("right.csv", pulled_grid(2)), folder.write("left.csv", pulled_grid(-2)), folder.write("none.csv", pulled_grid(0));
    folder.write("skin.toml",
                 "[sites]\nrows = 1\ncolumns = 2\npitch = \"2 mm\"\n[[class]]\nafferent = \"sa1\"\nper_site = 1\n"
                 "direction_gain = 1\ndirection = 0\n");
    const auto spikes = [&](const std::string& name) {
        const auto done = run_program(folder, fmt::format("respond {0}.csv --population skin.toml -o {0}", name));
        EXPECT_EQ(done.status, 0) << done.err;
        EXPECT_EQ(done.err.find("the shear has no effect"), std::string::npos);
        return lines_in(read_file(folder / (name + "/spikes.csv")));
    };
    const auto none = spikes("none"), right = spikes("right"), left = spikes("left");
    EXPECT_GT(right, none + 3);
    EXPECT_LT(left, none - 3);
    EXPECT_NE(read_file(folder / "right/afferents.csv").find(",0.000\n"), std::string::npos);
    const auto unfelt = run_program(folder, "respond right.csv --population 'grid 1x2' -o grid");
    EXPECT_NE(unfelt.err.find("the shear has no effect: no class of grid"), std::string::npos) << unfelt.err;
}

TEST(ShearProgram, ATiltedContactReachesAFingertip) {
    const TemporaryFolder folder;
    for (const char* azimuth : {"90", "270"})
        EXPECT_EQ(run_program(folder, fmt::format("respond press --population fingertip --set contact.tilt=20 --set contact.azimuth={0} -o "
                                                  "t{0}",
                                                  azimuth))
                      .status,
                  0);
    EXPECT_NE(read_file(folder / "t90/spikes.csv"), read_file(folder / "t270/spikes.csv"));
    const auto summary = read_file(folder / "t90/summary.json");
    EXPECT_NE(summary.find("contact.tilt"), std::string::npos);
    const auto wrong = run_program(folder, "respond press --population fingertip --set contact.azimuth=90 -o wrong");
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("give contact.tilt, such as contact.tilt=20"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace corpuscle
