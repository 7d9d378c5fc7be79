// The level of a sensor at rest, which --zero subtracts.

#include "io/quality/filters.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder, test::value_or_throw;

TEST(RestLevel, IsTheMedianOfTheRestPeriodInWhichTheForceIsZero) {
    auto rest = value_or_throw(RestLevel::make(0.05, value_or_throw(make_clock(100.0))));
    std::vector<double> out;
    for (const double x : {3.0, 1.0, 100.0, 2.0, 2.5, 4.5, 2.5, -1.0}) out.push_back(rest.next(x));
    EXPECT_EQ(out, (std::vector<double>{0, 0, 0, 0, 0, 2, 0, -3.5}));
    EXPECT_TRUE(rest.is_known());
    EXPECT_EQ(rest.level(), 2.5);
    RestLevel none;
    EXPECT_EQ(none.next(7), 7);
}

TEST(RestLevel, APeriodBelowOneSampleIsAnErrorAndARecordingShorterThanThePeriodAWarning) {
    const TemporaryFolder folder;
    folder.write("short.csv", "1\n1\n1\n2\n2\n2\n");
    const auto respond = [&](const std::string& zero) { return run_program(folder, "respond short.csv --rate 1kHz --unit N " + zero); };
    EXPECT_NE(respond("--zero 10us").err.find("--zero 1e-05s: at 1000 Hz the rest period must be between 0.001 and"), std::string::npos);
    EXPECT_NE(respond("--zero 0s").err.find("must be above 0"), std::string::npos);
    EXPECT_NE(respond("--zero 1s").err.find("the recording is shorter than the rest period of --zero"), std::string::npos);
    EXPECT_NE(respond("--zero 3ms").err.find("the level at rest, 1 N, was subtracted"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle
