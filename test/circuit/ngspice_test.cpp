// Runs the same netlists in Debian's ngspice and in Corpuscle and compares every common curve at every point.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/ngspice.hpp"

namespace corpuscle::circuit::test {
namespace {

/// Compares two plots. Absolute tolerances cover ngspice's own errors: 1e-7 of a curve's largest value, and its current tolerance.
void compare_plots(const Plot& result, const Plot& reference, double tolerance) {
    ASSERT_EQ(result.point_count(), reference.point_count()) << result.name;
    std::size_t compared = 0;
    for (const auto& c : reference.curves) {
        const auto* other = result.find_curve(corpuscle_name(c.name));
        if (other == nullptr) continue;
        ++compared;
        if (other->name == "inoise_total") continue;  // ngspice's is 12 % off where the gain falls: see the closed form below
        double largest = 0;
        if (c.type != "frequency")  // ngspice leaves its imaginary part uninitialized
            for (const auto& x : c.values) largest = std::max(largest, std::abs(x));
        const double floor = (c.type == "current" ? 2e-15 : 1e-9) + 1e-7 * largest;
        for (std::size_t k = 0; k < c.values.size(); ++k)
            EXPECT_LE(std::abs(other->values[k] - (c.type == "frequency" ? c.values[k].real() : c.values[k])),
                      tolerance * std::abs(c.type == "frequency" ? c.values[k].real() : c.values[k]) + floor)
                << c.name << " at point " << k << ": Corpuscle " << other->values[k] << ", ngspice " << c.values[k];
    }
    const auto inner =
        std::count_if(result.curves.begin(), result.curves.end(), [](const Curve& c) { return c.name.find('#') != std::string::npos; });
    EXPECT_GE(compared + 1 + static_cast<std::size_t>(inner), result.curves.size()) << "too few curves are in both results";
}

class DeckComparison : public testing::TestWithParam<std::string> {};

TEST_P(DeckComparison, AgreesWithNgspice) {
    if (is_another_formula(GetParam())) GTEST_SKIP() << "this ngspice has another formula";
    const std::string deck = deck_path(GetParam());
    const auto raw = std::filesystem::temp_directory_path() / ("corpuscle-" + GetParam() + "-" + std::to_string(getpid()) + ".raw");
    const auto log = run_ngspice(deck, raw);
    const auto reference = read_raw_file(raw);
    std::filesystem::remove(raw);
    ASSERT_FALSE(reference.empty()) << log;
    const auto outcome = run_corpuscle(deck);
    for (const auto& plot : reference) {
        bool found = false;
        for (const auto& result : outcome.plots())
            if (result.name == plot.name || (plot.name == "Operating Point" && result.name == plot.name)) {
                found = true;
                compare_plots(result, plot, result.is_complex ? 1e-3 : 1e-5);
            }
        if (!found) ADD_FAILURE() << "Corpuscle has no plot '" << plot.name << "'";
    }
}

INSTANTIATE_TEST_SUITE_P(Ngspice, DeckComparison, testing::ValuesIn(deck_names()), [](const auto& one) {
    std::string name = one.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(Transistor, HasTheSameCurrentAsExpressionsInNgspice) {
    int decks_seen = 0;
    for (const auto& name : deck_names()) {
        if (!name.starts_with("uicm_")) continue;
        ++decks_seen;
        SCOPED_TRACE(name);
        const std::string deck = deck_path(name);
        const TemporaryFolder folder;
        folder.write("native.cir", with_native_transistors(deck));
        (void)run_ngspice(deck, folder / "ngspice.raw");
        const auto reference = read_raw_file(folder / "ngspice.raw");
        ASSERT_EQ(reference.size(), 1U);
        const auto result = run_corpuscle(folder / "native.cir").plots();
        ASSERT_EQ(result.size(), 1U);
        compare_plots(result[0], reference[0], 1e-5);
    }
    EXPECT_EQ(decks_seen, 4);
}

TEST(Noise, IntegratesToTheClosedForms) {
    const auto outcome = run_corpuscle(deck_path("noise_rc"));
    const double white = 4 * 1.380649e-23 * 300.15 * 100e3, corner = 1 / (2 * M_PI * 100e3 * 10e-9);
    ASSERT_EQ(outcome.numbers.size(), 2U);
    EXPECT_NEAR(outcome.numbers[0].second, std::sqrt(white * corner * (std::atan(1e6 / corner) - std::atan(1 / corner))),
                2e-3 * outcome.numbers[0].second);
    EXPECT_NEAR(outcome.numbers[1].second, std::sqrt(white * (1e6 - 1)), 1e-9);
}

TEST(Measures, AgreeWithNgspice) {
    for (const std::string name : {"measures_dc", "measures_ac"}) {
        const std::string deck = deck_path(name);
        const auto log = run_ngspice(deck, "");
        const auto outcome = run_corpuscle(deck);
        EXPECT_GE(outcome.numbers.size(), 3U);
        for (const auto& [what, value] : outcome.numbers) {
            const double reference = logged_number(log, what);
            EXPECT_NEAR(value, reference, std::abs(reference) * 2e-5) << what << "\n" << log;
        }
    }
}

}  // namespace
}  // namespace corpuscle::circuit::test
