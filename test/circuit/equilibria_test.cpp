// Number of stable operating points of a circuit, and the one it reaches when it is switched on.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/analysis/equilibria.hpp"
#include "circuit/netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

/// Two stages, v_a = V_DD tanh(2 (d - v_b) / V) and vice versa, each with 1 kohm and 1 nF at its output.
std::string latch(double d) {
    return fmt::format(
        "latch\nvdd vdd 0 1\nb1 0 a i={{1m*v(vdd)*tanh(2*({}-v(b)))}}\nb2 0 b i={{-1m*v(vdd)*tanh(2*v(a))}}\n"
        "ra a 0 1k\nrb b 0 1k\nca a 0 1n\ncb b 0 1n\n.op\n",
        d);
}

struct RestStateResult {
    std::unique_ptr<AnalysisContext> bench = {};
    std::vector<Equilibrium> states = {};
    long count(bool stable) const {
        return std::count_if(states.begin(), states.end(), [&](const Equilibrium& s) { return s.is_stable == stable; });
    }
    double of(const Equilibrium& s, const char* name) const { return s.x[static_cast<std::size_t>(bench->system.unknown(name))]; }
    const Equilibrium* power_on() const {
        const auto at = std::find_if(states.begin(), states.end(), [](const Equilibrium& s) { return s.is_power_on; });
        return at == states.end() ? nullptr : &*at;
    }
};
RestStateResult looked(const std::string& text) {
    RestStateResult out;
    auto bench = AnalysisContext::make(make_circuit(text));
    if (!bench) return ADD_FAILURE() << bench.error().text(), RestStateResult();
    out.bench = std::move(*bench);
    auto states = find_equilibria(*out.bench);
    if (!states) return ADD_FAILURE() << states.error().text(), RestStateResult();
    out.states = std::move(*states);
    return out;
}

/// The roots of a = tanh(2 (d + tanh(2 a))), by bisection at sign changes.
std::vector<double> roots(double d) {
    const auto f = [&](double a) { return std::tanh(2 * (d + std::tanh(2 * a))) - a; };
    std::vector<double> out;
    constexpr int parts = 10'001;
    for (int k = 0; k < parts; ++k) {
        double low = -1.1 + 2.2 * k / parts, high = -1.1 + 2.2 * (k + 1) / parts;
        if ((f(low) > 0) == (f(high) > 0)) continue;
        for (int half = 0; half < 60; ++half) {
            const double middle = (low + high) / 2;
            ((f(middle) > 0) == (f(low) > 0) ? low : high) = middle;
        }
        out.push_back(low);
    }
    return out;
}

TEST(RestStates, OfALatchAreTwoStableAndOneUnstable) {
    for (const double d : {0.0, 0.02, -0.1}) {
        const auto found = looked(latch(d));
        const auto known = roots(d);
        ASSERT_EQ(known.size(), 3U);
        ASSERT_EQ(found.states.size(), 3U) << d;
        EXPECT_EQ(found.count(true), 2);
        std::vector<double> a;
        for (const auto& s : found.states) a.push_back(found.of(s, "v(a)"));
        std::sort(a.begin(), a.end());
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], known[k], 1e-6);
        for (const auto& s : found.states) EXPECT_EQ(s.is_stable, std::abs(found.of(s, "v(a)") - known[1]) > 1e-3);
    }
}

TEST(RestStates, OfALatchOfUnequalHalvesIsOne) {
    ASSERT_EQ(roots(0.8).size(), 1U);
    const auto found = looked(latch(0.8));
    ASSERT_EQ(found.states.size(), 1U);
    EXPECT_TRUE(found.states[0].is_stable && found.states[0].is_default && found.states[0].is_power_on);
}

/// Switched on slowly, it leaves 0 V towards the side that its asymmetry favours, and stays there.
TEST(RestStates, ALatchReachesTheSideThatItsAsymmetryFavours) {
    for (const double d : {0.02, -0.02}) {
        const auto found = looked(latch(d));
        ASSERT_NE(found.power_on(), nullptr) << d;
        EXPECT_TRUE(found.power_on()->is_stable);
        EXPECT_EQ(found.of(*found.power_on(), "v(a)") > 0, d > 0);
    }
}

TEST(RestStates, OfASchmittTriggerAreTwoWithinItsHysteresisAndOneBeyond) {
    auto text = *read_text_file(test::source_root() + "/circuits/schmitt.cir");
    text.replace(text.find("vin in 0 0"), 10, "vin in 0 {level}");
    text.erase(text.find(".dc"));
    for (const auto& [level, states] : {std::pair{0.1, 1U}, {0.24, 1U}, {0.27, 3U}, {0.35, 3U}, {0.44, 3U}, {0.47, 1U}, {0.6, 1U}}) {
        const auto found = looked(text + fmt::format(".param level={}\n.op\n", level));
        EXPECT_EQ(found.states.size(), states) << level;
        EXPECT_EQ(found.count(true), states == 3 ? 2 : 1) << level;
        ASSERT_NE(found.power_on(), nullptr);
        EXPECT_TRUE(found.power_on()->is_stable) << level;
        const double out = found.of(*found.power_on(), "v(out)");
        EXPECT_TRUE(level > 0.4 || out > 0.35) << level << ": its input rises with its supply, from below, and " << out << " V come out";
    }
}

TEST(RestStates, AreRequestedFromOp) {
    const auto found = run_netlist(latch(0.02) + ".op states 1u\n.mc 1\n");
    EXPECT_EQ(found.number("stable_states"), 2);
    EXPECT_EQ(found.number("unstable_states"), 1);
    for (const char* wrong : {".op state", ".op states 0", ".op states 1m 2m", ".op states fast"}) {
        const auto refused = run_directives(make_circuit(latch(0) + wrong + "\n"));
        ASSERT_FALSE(refused) << wrong;
        EXPECT_GT(refused.error().location.column, 0) << refused.error().text();
    }
}

}  // namespace
}  // namespace corpuscle::circuit
