// Documents link to files that exist, name tests that exist, and quote files exactly: "<!-- examples/own_neuron/qif.hpp -->", then a block
// of code. doc/quote.py writes the blocks.

#include <regex>

#include "support/program.hpp"

namespace corpuscle {
namespace {

struct Quotation {
    std::string file, text;
};

/// Blocks of code behind a comment that names a file.
std::vector<Quotation> quotations_in(const std::string& document) {
    std::vector<Quotation> out;
    std::istringstream in(document);
    std::string previous;
    for (std::string line; std::getline(in, line); previous = line) {
        if (!line.starts_with("```") || !previous.starts_with("<!-- ") || !previous.ends_with(" -->")) continue;
        Quotation quotation{previous.substr(5, previous.size() - 9), ""};
        while (std::getline(in, line) && line != "```") quotation.text += line + "\n";
        out.push_back(std::move(quotation));
    }
    return out;
}

TEST(Documents, QuoteFilesExactly) {
    std::size_t quoted = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_root() + "/doc")) {
        if (entry.path().extension() != ".md") continue;
        for (const auto& [file, text] : quotations_in(test::read_file(entry.path().string()))) {
            ++quoted;
            EXPECT_EQ(text, test::read_file(test::source_root() + "/" + file))
                << entry.path().filename() << " quotes " << file << "; run doc/quote.py doc/" << entry.path().filename().string();
        }
    }
    EXPECT_GE(quoted, 4U);
}

/// A page without its blocks of code, where "](" may be a lambda.
std::string without_code(const std::string& page) {
    std::istringstream in(page);
    std::string out;
    bool is_code = false;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("```")) is_code = !is_code;
        if (!is_code) out += line + "\n";
    }
    return out;
}

TEST(Documents, LinkToFilesThatExist) {
    for (const auto* page : {"HACKING.md", "doc/architecture.md", "doc/data-flow.md", "doc/errors.md", "doc/determinism.md",
                             "doc/stability.md", "doc/own-neuron.md", "doc/own-device.md"}) {
        const auto text = without_code(test::read_file(test::source_root() + "/" + page));
        ASSERT_FALSE(text.empty()) << page;
        for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
            const auto link = text.substr(at + 2, text.find(')', at) - at - 2), target = link.substr(0, link.find('#'));
            if (link.starts_with("http") || target.empty()) continue;  // another site, or within the page
            EXPECT_TRUE(
                std::filesystem::exists(std::filesystem::path(test::source_root()) / std::filesystem::path(page).parent_path() / target))
                << page << " links to " << target;
        }
    }
}

/// Every test file, one after another.
std::string test_sources() {
    std::string all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_root() + "/test"))
        if (entry.path().extension() == ".cpp") all += test::read_file(entry.path().string());
    return all;
}

TEST(Documents, NameTestsThatExist) {
    const auto sources = test_sources(), page = test::read_file(test::source_root() + "/doc/determinism.md");
    const std::regex name("`([A-Z][A-Za-z0-9]*)\\.([A-Z][A-Za-z0-9]*)`");
    std::size_t named = 0;
    for (std::sregex_iterator it(page.begin(), page.end(), name), end; it != end; ++it, ++named)
        EXPECT_NE(sources.find("(" + it->str(1) + ", " + it->str(2) + ")"), std::string::npos) << it->str() << " is not a test";
    EXPECT_GE(named, 15U);
}

}  // namespace
}  // namespace corpuscle
