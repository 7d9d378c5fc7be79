// Overrides of parameters: which are used, and how an unused one is reported.

#include "core/parameter_override.hpp"

#include <gtest/gtest.h>

#include <array>

#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

TEST(ParameterOverride, IsUnusedOnlyIfNoPartOfARunUsesIt) {
    const auto all = test::parse_settings({"press.F_max=2N", "sa1.f_B=25Hz", "sine.f=9Hz", "sa9.f_B=25Hz"}, "--set");
    auto unused = all;
    keep_unused(unused, value_or_throw(plan_afferent("sa1", all)).unused);
    EXPECT_EQ(unused.size(), 3u);
    for (const auto* force : {"press", "press+sine"}) keep_unused(unused, value_or_throw(make_stimulus(force, all, 1e3, 0)).unused);
    ASSERT_EQ(unused.size(), 1u) << "press is a part of both forces, sine of one";
    EXPECT_EQ(unused[0], all[3]);
    const std::array<std::string_view, 3> targets = {"sa1", "press", "sine"};
    const auto refused = check_all_used(unused, targets);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::bad_usage);
    EXPECT_EQ(refused.error().text(),
              "--set sa9.f_B=25Hz: nothing here is named 'sa9'; did you mean 'sa1'? (parameters of sa1, press, sine can be set)");
    EXPECT_TRUE(check_all_used({}, targets));
}

TEST(ParameterOverride, ErrorsOfAFileHaveItsLine) {
    const std::array<std::string_view, 1> targets = {"sa1"};
    const auto at_line = [](std::string target, std::string parameter, std::string value, long line) {
        ParameterOverride given{std::move(target), std::move(parameter), std::move(value)};
        given.typed = given.text(), given.location = {"skin.toml", line, 5};
        return given;
    };
    const auto unknown = check_all_used(std::array{at_line("sb1", "f_B", "25Hz", 7)}, targets);
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::bad_input);
    EXPECT_EQ(unknown.error().text(),
              "skin.toml:7:5: sb1.f_B=25Hz: nothing here is named 'sb1'; did you mean 'sa1'? (parameters of sa1 can be set)");
    const auto text_of = [&](const std::vector<ParameterOverride>& overrides) {
        const auto planned = plan_afferent("sa1", overrides);
        return planned ? std::string("accepted") : planned.error().text();
    };
    EXPECT_EQ(text_of({at_line("sa1", "C_m", "1pF", 2), at_line("sa1", "f_B", "25ms", 3)}),
              "skin.toml:3:5: sa1.f_B: '25ms' is a time; expected a value in Hz, such as '2 Hz'");
    EXPECT_EQ(text_of({at_line("sa1", "C_m", "1pF", 2), at_line("sa1", "V_reset", "600mV", 3)}),
              "skin.toml:3:5: sa1: V_reset = 0.6 must be below V_th = 0.5")
        << "the line that is wrong by itself";
    EXPECT_EQ(text_of({at_line("sa1", "V_th", "300mV", 2), at_line("sa1", "V_reset", "400mV", 3)}),
              "skin.toml:2:5: sa1: V_reset = 0.4 must be below V_th = 0.3")
        << "only both together are wrong";
}

}  // namespace
}  // namespace corpuscle
