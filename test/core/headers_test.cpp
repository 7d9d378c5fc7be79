// Checks over all headers at once.

#include <map>
#include <regex>

#include "support/support.hpp"

namespace corpuscle {
namespace {

/// If two headers define different types with the same name in one namespace, a program that contains both is broken (one-definition
/// rule), and no compiler reports it.
TEST(Headers, NoTwoDefineATypeOfTheSameName) {
    const std::regex space("^namespace ([\\w:]+)", std::regex::multiline),
        type("^(?:struct|class|enum class|enum) (\\w+)(?= |:|\\{)(?!::)", std::regex::multiline);
    std::map<std::string, std::string> first;
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_root() + "/src")) {
        if (entry.path().extension() != ".hpp") continue;
        const auto text = test::read_file(entry.path().string());
        std::smatch in;
        if (!std::regex_search(text, in, space)) continue;
        for (std::sregex_iterator found(text.begin(), text.end(), type), end; found != end; ++found) {
            const auto name = in[1].str() + "::" + (*found)[1].str();
            const auto [at, is_new] = first.try_emplace(name, entry.path().string());
            EXPECT_TRUE(is_new || at->second == entry.path().string()) << name << ": " << at->second << " and " << entry.path();
            ++count;
        }
    }
    EXPECT_GT(count, 200);
}

}  // namespace
}  // namespace corpuscle
