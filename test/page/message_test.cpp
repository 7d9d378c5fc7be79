#include "page/message.hpp"

#include <cmath>

#include "page/ask.hpp"

namespace corpuscle::page {
namespace {

std::vector<std::byte> bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span<const char>(text.data(), text.size()));
    return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> sample_message() {
    MessageWriter writer;
    writer.head["request"] = "advance";
    writer.add("force", std::span<const double>(std::vector{0.5, 1.5}));
    writer.add("name", "abc");
    writer.add("unit", std::span<const std::uint32_t>(std::vector<std::uint32_t>{7, 8, 9}));
    return writer.finish();
}

TEST(PageMessage, IsReadAsItWasWritten) {
    const auto bytes = sample_message();
    EXPECT_EQ(bytes.size() % 8, 0U);
    const auto message = read_message(bytes);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->head.dump(), R"({"request":"advance"})");
    ASSERT_EQ(message->arrays.size(), 3U);
    EXPECT_EQ(*numbers_of(*message->find("force")), (std::vector{0.5, 1.5}));
    EXPECT_EQ(message->find("name")->data.size(), 3U);
    EXPECT_EQ(message->find("unit")->count, 3U);
    EXPECT_EQ(message->find("missing"), nullptr);
}

TEST(PageMessage, MayBeTheTextOfItsHead) {
    const auto message = read_message(bytes_of(R"({"request": "catalogue"})"));
    ASSERT_TRUE(message);
    EXPECT_EQ(message->head["request"], "catalogue");
}

TEST(PageMessage, ThatIsNestedDeeplyIsAnError) {
    constexpr int depth = 120'000;
    for (const auto& [open, close] : {std::pair("[", "]"), std::pair(R"({"x":)", "}")}) {
        std::string text = R"({"request": )";
        for (int k = 0; k < depth; ++k) text += open;
        text += "1";
        for (int k = 0; k < depth; ++k) text += close;
        const auto message = read_message(bytes_of(text + "}"));
        ASSERT_FALSE(message);
        EXPECT_EQ(message.error().message, "values in the head of the message are nested more than 16 deep");
    }
    EXPECT_TRUE(read_message(bytes_of(R"({"request": [[[[{"x": 1}]]]]})")));
}

TEST(PageMessage, ThatIsCutOffAnywhereIsAnError) {
    const auto bytes = sample_message();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto message = read_message(std::span(bytes).first(size));
        ASSERT_FALSE(message) << size;
        EXPECT_FALSE(message.error().message.empty());
    }
}

TEST(PageMessage, WithNumbersThatAreNotFiniteIsRefused) {
    MessageWriter writer;
    writer.add("force", std::span<const double>(std::vector{0.5, std::nan("")}));
    const auto bytes = writer.finish();
    const auto numbers = numbers_of(*read_message(bytes)->find("force"));
    ASSERT_FALSE(numbers);
    EXPECT_EQ(numbers.error().message, "element 1 of the array 'force' is nan, not a finite number");
}

TEST(PageMessage, NamesTheTypesThatAnArrayCanHave) {
    auto bytes = sample_message();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    bytes[text.find("f64")] = std::byte{'g'};
    EXPECT_EQ(read_message(bytes).error().message, "the array 'force' has the type 'g64'; types are f32, f64, u32 and u8");
}

}  // namespace
}  // namespace corpuscle::page
