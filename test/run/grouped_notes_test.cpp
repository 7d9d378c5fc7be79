// Notes about many inputs.

#include "run/summary/grouped_notes.hpp"

#include <gtest/gtest.h>

namespace corpuscle {
namespace {

using Texts = std::vector<std::string>;

TEST(GroupedNotes, AreOneForEachText) {
    EXPECT_EQ(grouped_notes(Texts{"a: no unit", "a: short: 3 s", "b: no unit", "plain", "c: no unit", "plain"}),
              (Texts{"a and 2 more: no unit", "a: short: 3 s", "plain", "plain"}));
    EXPECT_TRUE(grouped_notes({}).empty());
}

TEST(ShortList, HasAtMostFourNames) {
    EXPECT_EQ(short_list(Texts{"a", "b", "c", "d"}), "a, b, c, d");
    EXPECT_EQ(short_list(Texts{"a", "b", "c", "d", "e"}), "a, b, c and 2 more");
}

}  // namespace
}  // namespace corpuscle
