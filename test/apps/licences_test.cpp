// The licences of the libraries that are distributed with the program, its pages and its sources.

#include "support/program.hpp"

namespace corpuscle {
namespace {

TEST(Licences, EveryPageWithTheChartLibraryContainsItsLicence) {
    std::size_t templates = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(test::source_root() + "/src/report")) {
        if (file.path().extension() != ".html") continue;
        const auto text = test::read_file(file.path().string());
        if (text.find("{{dygraph.min.js}}") == std::string::npos) continue;
        EXPECT_NE(text.find("{{licence.html}}"), std::string::npos) << file.path();
        ++templates;
    }
    EXPECT_GE(templates, 4U);
    const test::TemporaryFolder folder;
    for (const auto* arguments : {"respond press --out answer --report page.html", "study fig24 --report page.html"}) {
        ASSERT_EQ(test::run_program(folder, arguments).status, 0) << arguments;
        const auto page = test::read_file(folder / "page.html");
        EXPECT_NE(page.find("Copyright (c) 2006, 2009, 2011, 2012, 2013, 2017 Dan Vanderkam"), std::string::npos) << arguments;
        EXPECT_NE(page.find("The above copyright notice and this permission notice shall be included"), std::string::npos) << arguments;
        std::filesystem::remove(folder / "page.html");
    }
}

TEST(Licences, TheNoticeNamesEveryLibraryThatIsCompiledIn) {
    const auto notice = test::read_file(test::source_root() + "/NOTICE");
    for (const auto* library : {"dygraphs", "CLI11", "nlohmann-json", "toml++", "fmt", "xsimd", "Frances Y. Kuo and Stephen Joe"})
        EXPECT_NE(notice.find(library), std::string::npos) << library;
}

}  // namespace
}  // namespace corpuscle
