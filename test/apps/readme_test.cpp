// What the README shows is what runs.

#include "support/program.hpp"

namespace corpuscle {
namespace {

const std::string project_root = test::root();

/// The lines of the README's shell blocks that call the program, without what stands behind a '#'.
std::vector<std::string> commands() {
    std::istringstream text(test::read_file(project_root + "/README.md"));
    std::vector<std::string> out;
    bool shell = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("```")) shell = line == "```sh";
        if (shell && line.starts_with("corpuscle ")) out.push_back(line.substr(0, line.find(" #")));
    }
    return out;
}

TEST(Readme, EveryCommandItShowsRuns) {
    const test::Folder folder;  // the clone, with what a user finds in it and nothing else
    for (const auto* part : {"circuits", "process", "examples"})
        std::filesystem::copy(project_root + "/" + part, folder / part, std::filesystem::copy_options::recursive);
    const auto shown = commands();
    ASSERT_GE(shown.size(), 6U);
    for (const auto& command : shown) {
        const auto words = command.substr(std::string("corpuscle").size());
        const auto ran = test::run(folder, words);
        EXPECT_EQ(ran.status, 0) << command << '\n' << ran.err;
    }
}

TEST(Readme, ItsProgramIsTheExampleThatRuns) {
    const auto example = test::read_file(project_root + "/examples/respond.cpp"), readme = test::read_file(project_root + "/README.md");
    EXPECT_NE(readme.find("```cpp\n" + example + "```\n"), std::string::npos);
}

TEST(Readme, EveryPageItPointsToIsThere) {
    for (const auto* page : {"README.md", "HACKING.md", "doc/concepts.md", "doc/afferents.md", "doc/recordings.md", "doc/fixed-point.md",
                             "doc/measures.md", "doc/circuits.md", "doc/chips.md", "doc/lanes.md", "doc/populations.md",
                             "doc/real-recordings.md", "doc/live.md", "doc/events.md"}) {
        const auto text = test::read_file(project_root + "/" + page);
        ASSERT_FALSE(text.empty()) << page;
        for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
            const auto target = text.substr(at + 2, text.find(')', at) - at - 2);
            if (target.starts_with("http")) continue;
            EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(project_root) / std::filesystem::path(page).parent_path() / target))
                << page << " points to " << target;
        }
    }
}

}  // namespace
}  // namespace corpuscle
