// The work of a rank ends with a result that can be sent, also after an exception.

#include "run/ranks.hpp"

#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Ranks, AnExceptionInTheirWorkIsAnErrorToSend) {
    EXPECT_TRUE(static_cast<bool>(without_exceptions([] { return Result<void>(); })));
    EXPECT_EQ(without_exceptions([]() -> Result<void> { return bad_usage("as it was"); }).error().code, ErrorCode::bad_usage);
    EXPECT_NE(
        without_exceptions([]() -> Result<void> { throw std::bad_alloc(); }).error().message.find("not enough memory; use fewer ranks"),
        std::string::npos);
    EXPECT_EQ(without_exceptions([]() -> Result<void> { throw std::runtime_error("its text"); }).error().message, "its text");
}

}  // namespace
}  // namespace corpuscle
