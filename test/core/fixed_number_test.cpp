// Numbers with a fixed number of decimals.

#include "core/text/fixed_number.hpp"

#include <bit>
#include <limits>

#include "core/random.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

std::string fixed(double x, int decimals) {
    fmt::memory_buffer text;
    append_fixed(text, x, decimals);
    return fmt::to_string(text);
}

TEST(FixedNumber, IsTheSameTextAsThatOfTheLibrary) {
    const double largest = std::numeric_limits<double>::max(), infinity = std::numeric_limits<double>::infinity();
    for (const double x :
         {0.0, -0.0, 0.5, 1.5, 2.5, 0.0005, -0.0004, 9.9999999995, 999999.9999999, 1e15, 1e22, largest, infinity, -infinity})
        for (int decimals = 0; decimals < 10; ++decimals) EXPECT_EQ(fixed(x, decimals), fmt::format("{:.{}f}", x, decimals));
    for (std::uint32_t k = 0; k < 100'000; ++k) {
        const auto w = philox({k, 0, 0, 0}, 1);
        const int decimals = static_cast<int>(w[0] % 10);
        const double any = std::bit_cast<double>(std::uint64_t{w[2]} << 32 | w[3]), tie = (w[1] % 100'000) * 0.0005, usual = w[1] * 1e-7;
        for (const double x : {any, tie, -tie, usual}) ASSERT_EQ(fixed(x, decimals), fmt::format("{:.{}f}", x, decimals)) << x;
    }
}

}  // namespace
}  // namespace corpuscle
