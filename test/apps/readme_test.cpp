// The commands and the program of the README, and the commands of the tutorial, run as they are shown.

#include "support/program.hpp"

namespace corpuscle {
namespace {

const std::string project_root = test::source_root();

/// The lines of a page's shell blocks that call the program. Comments after '#' are removed.
std::vector<std::string> commands(const std::string& page) {
    std::istringstream text(test::read_file(project_root + "/" + page));
    std::vector<std::string> out;
    bool in_shell_block = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("```")) in_shell_block = line == "```sh";
        if (in_shell_block && line.starts_with("corpuscle ")) out.push_back(line.substr(0, line.find(" #")));
    }
    return out;
}

/// Runs the commands of a page in the order in which they are shown.
void run_commands_of(const std::string& page, std::size_t count = 6) {
    const test::TemporaryFolder folder;  // stands for the clone, with the files that a user finds in it and no others
    for (const auto* part : {"circuits", "process", "examples"})
        std::filesystem::copy(project_root + "/" + part, folder / part, std::filesystem::copy_options::recursive);
    const auto shown = commands(page);
    ASSERT_GE(shown.size(), count) << "the commands of the page were not found";
    for (const auto& command : shown) {
        const auto arguments = command.substr(std::string("corpuscle").size());
        const auto ran = test::run_program(folder, arguments);
        EXPECT_EQ(ran.status, 0) << command << '\n' << ran.err;
    }
}

TEST(Readme, EveryCommandItShowsRuns) { run_commands_of("README.md"); }

TEST(Tutorial, EveryCommandItShowsRuns) { run_commands_of("doc/tutorial.md"); }

TEST(TrialsPage, EveryCommandItShowsRuns) { run_commands_of("doc/trials.md", 5); }

TEST(FitTransistorPage, EveryCommandItShowsRuns) { run_commands_of("doc/fit-transistor.md", 3); }

TEST(Readme, ItsProgramIsTheExampleThatRuns) {
    const auto example = test::read_file(project_root + "/examples/respond.cpp"), readme = test::read_file(project_root + "/README.md");
    EXPECT_NE(readme.find("```cpp\n" + example + "```\n"), std::string::npos);
}

/// README, HACKING and all pages of a folder, relative to the root.
std::vector<std::string> pages() {
    std::vector<std::string> out = {"README.md", "HACKING.md"};
    for (const auto* folder : {"doc", "examples", "reproduction"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(project_root + "/" + folder))
            if (entry.path().extension() == ".md") out.push_back(std::filesystem::relative(entry.path(), project_root));
    return out;
}

/// A page without its blocks of code.
std::string prose_of(const std::string& page) {
    std::istringstream text(test::read_file(project_root + "/" + page));
    std::string out;
    bool in_block = false;
    for (std::string line; std::getline(text, line);)
        if (line.starts_with("```"))
            in_block = !in_block;
        else if (!in_block)
            out += line + '\n';
    return out;
}

TEST(Pages, EveryFileTheyLinkToExists) {
    EXPECT_GT(pages().size(), 30U);
    for (const auto& page : pages()) {
        const auto text = prose_of(page);
        ASSERT_FALSE(text.empty()) << page;
        for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
            const auto link = text.substr(at + 2, text.find(')', at) - at - 2), target = link.substr(0, link.find('#'));
            if (link.starts_with("http") || target.empty()) continue;  // a web address, or a heading of the same page
            EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(project_root) / std::filesystem::path(page).parent_path() / target))
                << page << " points to " << target;
        }
    }
}

}  // namespace
}  // namespace corpuscle
