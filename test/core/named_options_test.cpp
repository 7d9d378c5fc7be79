// Options that a program names, as a page and Python do.

#include "core/text/option.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

/// Variables, and their options.
struct Targets {
    std::optional<bool> transpose;
    bool absolute = false;
    std::optional<std::string> unit;
    std::optional<double> rate;
    std::vector<std::string> channels;
    std::vector<double> notch;

    OptionGroup group() {
        return {"",
                {{"--transpose", &transpose, "", ""},
                 excluding("--transpose", {"--no-transpose", &transpose, "", ""}),
                 {"--abs", &absolute, "", ""},
                 {"--unit", &unit, "UNIT", ""},
                 {"--rate", value_reader(rate, quantity_of("Hz")), "HZ", ""},
                 {"--channel,-c", &channels, "CHANNEL", ""},
                 repeatable({"--notch", list_reader(notch, quantity_of("Hz")), "HZ", ""})}};
    }
};

using Texts = std::vector<std::pair<std::string, std::string>>;

/// The error of the first option that is refused; "" if all are accepted.
std::string set_all(Targets& to, const Texts& options) {
    NamedOptions named(to.group());
    for (const auto& [name, text] : options)
        if (const auto ok = named.set(name, text); !ok) return ok.error().message;
    return "";
}

std::string error_of(const Texts& options) {
    Targets unused;
    return set_all(unused, options);
}

TEST(NamedOptions, ANegatedFlagSetsFalseAndIsNotGivenIfItIsFalse) {
    for (const auto& [options, expected] : {std::pair{Texts{{"transpose", "true"}}, std::optional(true)},
                                            {Texts{{"no-transpose", "true"}}, std::optional(false)},
                                            {Texts{{"transpose", "false"}}, std::optional(false)},
                                            {Texts{{"no-transpose", "false"}}, std::optional<bool>()},
                                            {Texts{{"no-transpose", "false"}, {"transpose", "true"}}, std::optional(true)}}) {
        Targets to;
        EXPECT_EQ(set_all(to, options), "");
        EXPECT_EQ(to.transpose, expected) << options[0].first << " = " << options[0].second;
    }
}

TEST(NamedOptions, ThoseThatExcludeEachOtherAreRefusedInEitherOrder) {
    EXPECT_EQ(error_of({{"transpose", "true"}, {"no-transpose", "true"}}),
              "transpose and no-transpose exclude each other; give one of them");
    EXPECT_EQ(error_of({{"no-transpose", "true"}, {"transpose", "true"}}),
              "no-transpose and transpose exclude each other; give one of them");
}

TEST(NamedOptions, OneThatIsGivenTwiceIsRefusedUnlessItIsAListOrAFlag) {
    EXPECT_EQ(error_of({{"rate", "1kHz"}, {"unit", "N"}, {"rate", "2kHz"}}), "rate is given twice; give it once");
    EXPECT_EQ(error_of({{"unit", "N"}, {"unit", "mN"}}), "unit is given twice; give it once");
    Targets to;
    EXPECT_EQ(set_all(to, {{"channel", "1"}, {"channel", "2"}, {"notch", "50"}, {"notch", "60Hz"}, {"abs", "true"}, {"abs", "true"}}), "");
    EXPECT_EQ(to.channels, (std::vector<std::string>{"1", "2"}));
    EXPECT_EQ(to.notch, (std::vector{50.0, 60.0}));
    EXPECT_TRUE(to.absolute);
}

}  // namespace
}  // namespace corpuscle
