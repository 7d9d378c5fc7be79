// The curve between rows for --resample: straight lines, or a cubic B-spline.

#include "io/recording/row_curve.hpp"

#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

/// The curve at `per_row` times in each interval of rows at 0, 1, 2 ... s.
std::vector<double> curve_of(const std::vector<double>& rows, int per_row, Interpolation kind) {
    RowCurve curve(kind);
    std::size_t next = 0;
    const auto read_row = [&](RowCurve::Row& row) -> Result<bool> {
        if (next == rows.size()) return false;
        row.force = {rows[next]}, row.t = static_cast<double>(next);
        return ++next, true;
    };
    std::vector<double> out;
    for (int k = 0;; ++k) {
        const double t = static_cast<double>(k) / per_row;
        while (!curve.has_begun() || curve.time() < t)
            if (const bool more = test::value_or_throw(curve.advance(read_row)); !more) return out;
        out.push_back(curve.force(0, t));
    }
}

TEST(RowCurve, ReproducesStraightLinesAndShiftsParabolasByAConstant) {
    std::vector<double> line, parabola;
    for (int k = 0; k < 12; ++k) line.push_back(2 - 3.0 * k), parabola.push_back(1.0 * k * k);
    const auto lines = curve_of(line, 5, Interpolation::smooth), parabolas = curve_of(parabola, 5, Interpolation::smooth);
    ASSERT_EQ(lines.size(), 56U);
    for (std::size_t k = 5; k <= 50; ++k) {  // without the ends, where rows are repeated
        const double t = static_cast<double>(k) / 5;
        EXPECT_NEAR(lines[k], 2 - 3 * t, 1e-12);
        EXPECT_NEAR(parabolas[k], t * t + 1.0 / 3, 1e-12);
    }
    EXPECT_EQ(curve_of({0, 2, 1}, 2, Interpolation::linear), (std::vector<double>{0, 1, 2, 1.5, 1}));
    EXPECT_EQ(curve_of({6}, 2, Interpolation::smooth), (std::vector<double>{6}));
}

TEST(RowCurve, IsSmoothAndStaysInTheRangeOfFourRows) {
    EXPECT_TRUE(rc::check("any rows", [] {
        const auto numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-100, 100));
        RC_PRE(numbers.size() >= 4U);
        const std::vector<double> rows(numbers.begin(), numbers.end());
        constexpr int n = 16;
        const auto curve = curve_of(rows, n, Interpolation::smooth);
        RC_ASSERT(curve.size() == (rows.size() - 1) * n + 1);
        double largest = 0;  // third difference of the rows, which repeat at the ends
        for (std::size_t k = 0; k < curve.size(); ++k) {
            const std::size_t b = k / n, first = b == 0 ? 0 : b - 1, last = std::min(b + 2, rows.size() - 1);
            const auto [low, high] = std::minmax_element(rows.begin() + static_cast<std::ptrdiff_t>(first),
                                                         rows.begin() + static_cast<std::ptrdiff_t>(last) + 1);
            RC_ASSERT(curve[k] >= *low - 1e-9 && curve[k] <= *high + 1e-9);
            largest = std::max({largest, std::abs(*low), std::abs(*high)});
        }
        // The third difference of a curve without jumps of its curvature shrinks with the third power of the step.
        for (std::size_t k = 3; k < curve.size(); ++k)
            RC_ASSERT(std::abs(curve[k] - 3 * curve[k - 1] + 3 * curve[k - 2] - curve[k - 3]) <= 8 * largest / (n * n * n) + 1e-9);
    }));
}

TEST(RowCurve, GivesTheSameSamplesForAnyBlocksAndNeedsEvenRows) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", "0\n1\n4\n2\n2\n2\n2\n2\n5\n");
    const RecordingOptions options{.rate = 10, .resample = 70, .unit = "N", .interpolation = Interpolation::smooth};
    const auto samples = test::load_recording(path, options, 1).force;
    EXPECT_EQ(samples[0].size(), 57U);
    for (const std::size_t block : {3, 7, 1000}) EXPECT_EQ(test::load_recording(path, options, block).force, samples);
    for (std::size_t k = 28; k <= 42; ++k) EXPECT_EQ(samples[0][k], 2) << "four equal rows";
    EXPECT_NE(
        test::load_error(path, {.rate = 10, .unit = "N", .interpolation = Interpolation::smooth}).find("add a rate, such as --resample"),
        std::string::npos);
    const auto uneven = folder.write("uneven.csv", "time,f_N\n0,1\n0.1,2\n0.9,3\n1,4\n1.4,2\n");
    EXPECT_NE(test::load_error(uneven, {.resample = 20, .interpolation = Interpolation::smooth}).find("add --rate 2.8571Hz"),
              std::string::npos);
    EXPECT_EQ(test::load_error(uneven, {.rate = 2.8571, .resample = 20, .interpolation = Interpolation::smooth}), "read");
}

}  // namespace
}  // namespace corpuscle
