// Frames with fewer forces than the skin has sites, and a list of its sites: in commands as a user types them.

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::run_program;

TEST(SiteLayout, SitesAreListedInFrameOrderAndALayoutSelectsTheSitesOfAFrame) {
    const TemporaryFolder folder;
    const auto listed = run_program(folder, "list 'grid 2x2' --sites");
    EXPECT_EQ(listed.out, "name,x_mm,y_mm,region\nr1c1,0,0,grid\nr1c2,2,0,grid\nr2c1,0,2,grid\nr2c2,2,2,grid\n");
    EXPECT_EQ(nlohmann::json::parse(run_program(folder, "list hand --sites --json").out)["sites"].size(), 4793U);
    EXPECT_EQ(run_program(folder, "list hand fingertip --sites").status, 2);
    EXPECT_NE(run_program(folder, "list hnad --sites").err.find("did you mean 'hand'?"), std::string::npos);
    folder.write("sites.csv", listed.out);
    folder.write("own.toml", "[sites]\nlist = \"sites.csv\"\n[[class]]\nafferent = \"sa1\"\nper_site = 1\n");
    EXPECT_EQ(run_program(folder, "list own.toml --sites").out, listed.out)
        << "the output can be read as the list of sites of a population";

    std::string one, all;
    for (int k = 0; k < 400; ++k) {
        const auto force = std::to_string(std::min(3.0, 0.05 * k));
        one += force + "\n", all += "0,0," + force + ",0\n";
    }
    folder.write("one", one), folder.write("all", all), folder.write("layout.csv", "channel,name\n1,r2c1\n");
    const auto few = run_program(folder, "stream --population 'grid 2x2' --rate 1kHz --layout layout.csv --quiet <one");
    EXPECT_EQ(few.status, 0) << few.err;
    EXPECT_GT(few.out.size(), 100U);
    EXPECT_EQ(few.out, run_program(folder, "stream --population 'grid 2x2' --rate 1kHz --quiet <all").out);
}

}  // namespace
}  // namespace corpuscle
