// Errors, results that hold a value or an error, and how TRY hands an error on.

#include "core/error.hpp"

#include <vector>

#include "core/text/ascii_text.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Error, StatesTheKnownPartsOfItsLocation) {
    EXPECT_EQ(bad_input("no force").text(), "no force");
    EXPECT_EQ(bad_input("no force", {"a.csv"}).text(), "a.csv: no force");
    EXPECT_EQ(bad_input("no force", {"a.csv", 3}).text(), "a.csv:3: no force");
    EXPECT_EQ(bad_input("no force", {"a.csv", 3, 7}).text(), "a.csv:3:7: no force");
    EXPECT_EQ(bad_input("no force", {"", 3, 7}).text(), "line 3:7: no force");
    EXPECT_EQ(bad_input("no force", {"a.csv", 0, 7}).text(), "a.csv: no force");  // a column without its line says nothing
}

/// A value that is long enough to be allocated, so that a sanitizer sees a copy that is missing or destroyed twice.
Result<std::string> long_text(bool fails) {
    if (fails) return bad_usage("a message of more than a few characters, with a remedy");
    return std::string(100, 'x');
}

TEST(Result, IsCopiedMovedAndAssignedWhateverEitherSideHolds) {
    for (const bool before : {false, true})
        for (const bool after : {false, true}) {
            Result<std::string> result = long_text(before);
            const Result<std::string> source = long_text(after);
            result = source;
            ASSERT_EQ(bool(result), !after);
            const Result<std::string> copy = result, moved = std::move(result);
            for (const auto* r : {&copy, &moved, &source}) {
                if (after)
                    EXPECT_EQ(r->error().message, long_text(true).error().message);
                else
                    EXPECT_EQ(**r, *long_text(false));
            }
        }
}

Result<std::size_t> total_length(const std::vector<bool>& fails, std::size_t& tried) {
    std::size_t length = 0;
    for (const bool f : fails) {
        ++tried;
        length += TRY(long_text(f)).size();
    }
    return length;
}

TEST(Try, IsTheValueOrReturnsTheErrorAtOnce) {
    std::size_t tried = 0;
    EXPECT_EQ(*total_length({false, false, false}, tried), 300u);
    EXPECT_EQ(tried, 3u);
    const auto failed = total_length({false, true, false}, tried = 0);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::bad_usage);
    EXPECT_EQ(failed.error().message, long_text(true).error().message);
    EXPECT_EQ(tried, 2u);
}

TEST(AsciiText, JoinsTextsAndSplitsThemAgain) {
    const std::vector<std::string> names = {"sa1", "", "fa1"};
    EXPECT_EQ(joined(names), "sa1, , fa1");
    EXPECT_EQ(joined(names, " or "), "sa1 or  or fa1");
    EXPECT_EQ(joined(std::vector<std::string>{}), "");
    EXPECT_EQ(joined(std::vector<std::string>{"sa1"}), "sa1");
    const auto text = joined(names, ",");
    const auto parts = split(text, ',');
    EXPECT_EQ(std::vector<std::string>(parts.begin(), parts.end()), names);
    EXPECT_EQ(joined(parts, ","), "sa1,,fa1");
    EXPECT_EQ(split("", ',').size(), 1u);
}

}  // namespace
}  // namespace corpuscle
