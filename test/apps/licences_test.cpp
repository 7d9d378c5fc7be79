// The licences of the libraries that are distributed with the program and its sources.

#include "support/program.hpp"

namespace corpuscle {
namespace {

TEST(Licences, TheNoticeNamesEveryLibraryThatIsCompiledIn) {
    const auto notice = test::read_file(test::source_root() + "/NOTICE");
    for (const auto* library : {"CLI11", "nlohmann-json", "toml++", "fmt", "xsimd", "Frances Y. Kuo and Stephen Joe"})
        EXPECT_NE(notice.find(library), std::string::npos) << library;
}

}  // namespace
}  // namespace corpuscle
