// The examples of doc/page-protocol.md, sent in their order.

#include <algorithm>
#include <set>

#include "page/ask.hpp"
#include "support/support.hpp"

namespace corpuscle::page {
namespace {

/// The requests in a document: each JSON object that begins with the key "request".
std::vector<std::string> requests_in(const std::string& document) {
    std::vector<std::string> out;
    for (auto at = document.find(R"({"request")"); at != document.npos; at = document.find(R"({"request")", at + 1)) {
        int depth = 0;
        bool is_text = false;
        for (auto end = at; end < document.size(); ++end) {
            if (document[end] == '"') is_text = !is_text;
            if (!is_text) depth += document[end] == '{' ? 1 : document[end] == '}' ? -1 : 0;
            if (depth > 0) continue;
            out.push_back(document.substr(at, end + 1 - at));
            break;
        }
    }
    return out;
}

/// The requests that the engine has, which it lists if one does not exist.
std::set<std::string> known_requests(PageEngine& engine) {
    const auto error = ask(engine, R"({"request": "?"})").error();
    const auto begin = error.find("there are ") + 10;
    std::set<std::string> out;
    std::istringstream list(error.substr(begin, error.find(')', begin) - begin));
    for (std::string name; std::getline(list >> std::ws, name, ',');) out.insert(name);
    return out;
}

/// The request `read` gets its array; the others need none.
TEST(PageProtocol, EachExampleOfTheDocumentWorksInTheOrderOfTheDocument) {
    PageEngine engine;
    const auto requests = requests_in(test::read_file(test::source_root() + "/doc/page-protocol.md"));
    const std::string recording = "fz_raw\n0\n100\n200\n";
    const std::vector<std::uint8_t> file(recording.begin(), recording.end());
    std::set<std::string> sent;
    for (const auto& text : requests) {
        ASSERT_TRUE(Json::accept(text)) << text;
        const auto name = Json::parse(text)["request"].get<std::string>();
        const auto answer = name == "read" ? ask(engine, text, "file", file) : ask(engine, text);
        EXPECT_EQ(answer.error(), "") << text;
        sent.insert(name);
        if (name == "read") {
            EXPECT_EQ(answer.numbers("force.0"), (std::vector{0.0, 1.0, 2.0}));
        }
    }
    EXPECT_EQ(sent, known_requests(engine));
}

}  // namespace
}  // namespace corpuscle::page
