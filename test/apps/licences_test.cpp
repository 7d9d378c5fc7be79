// The licences of what goes out with the program: with its pages, and with its sources.

#include "support/program.hpp"

namespace corpuscle {
namespace {

TEST(Licences, EveryPageThatHoldsTheChartLibraryHoldsItsLicence) {
    std::size_t templates = 0;
    for (const auto& file : std::filesystem::directory_iterator(test::project_root() + "/apps/report")) {
        const auto text = test::read_file(file.path().string());
        if (file.path().extension() != ".html" || text.find("{{dygraphs.js}}") == std::string::npos) continue;
        EXPECT_NE(text.find("{{licence.html}}"), std::string::npos) << file.path();
        ++templates;
    }
    EXPECT_GE(templates, 4U);
    const test::TemporaryFolder folder;
    for (const auto* words : {"respond press --out answer --report page.html", "study fig24 --report page.html"}) {
        ASSERT_EQ(test::run_program(folder, words).status, 0) << words;
        const auto page = test::read_file(folder / "page.html");
        EXPECT_NE(page.find("Copyright (c) 2006, 2009, 2011, 2012, 2013, 2017 Dan Vanderkam"), std::string::npos) << words;
        EXPECT_NE(page.find("The above copyright notice and this permission notice shall be included"), std::string::npos) << words;
        std::filesystem::remove(folder / "page.html");
    }
}

TEST(Licences, TheNoticeNamesEveryLibraryThatIsCompiledIn) {
    const auto notice = test::read_file(test::project_root() + "/NOTICE");
    for (const auto* work : {"dygraphs", "CLI11", "nlohmann-json", "toml++", "fmt", "xsimd", "Frances Y. Kuo and Stephen Joe"})
        EXPECT_NE(notice.find(work), std::string::npos) << work;
}

}  // namespace
}  // namespace corpuscle
