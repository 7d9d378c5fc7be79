// Stable operating points of a circuit, and the point that it reaches when it is switched on.

#include <fmt/format.h>
#include <algorithm>
#include <numbers>
#include <random>

#include "circuit/analysis/equilibria.hpp"
#include "circuit/netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

/// A latch of two stages, v_a = V_DD tanh(2 (d - v_b)) and v_b = -V_DD tanh(2 v_a), each with 1 kohm and 1 nF at its output. `d` (V) makes
/// it asymmetric.
std::string latch(double d) {
    return fmt::format(
        "latch\nvdd vdd 0 1\nb1 0 a i={{1m*v(vdd)*tanh(2*({}-v(b)))}}\nb2 0 b i={{-1m*v(vdd)*tanh(2*v(a))}}\n"
        "ra a 0 1k\nrb b 0 1k\nca a 0 1n\ncb b 0 1n\n.op\n",
        d);
}

struct RestStateResult {
    std::unique_ptr<AnalysisContext> context = {};
    std::vector<Equilibrium> states = {};
    long count(bool stable) const {
        return std::count_if(states.begin(), states.end(), [&](const Equilibrium& s) { return s.is_stable == stable; });
    }
    double value(const Equilibrium& s, const char* name) const { return s.x[static_cast<std::size_t>(context->system.unknown(name))]; }
    const Equilibrium* power_on() const {
        const auto at = std::find_if(states.begin(), states.end(), [](const Equilibrium& s) { return s.is_power_on; });
        return at == states.end() ? nullptr : &*at;
    }
};
RestStateResult find_states(const std::string& text) {
    RestStateResult out;
    auto context = AnalysisContext::make(make_circuit(text));
    if (!context) return ADD_FAILURE() << context.error().text(), RestStateResult();
    out.context = std::move(*context);
    auto states = find_equilibria(*out.context);
    if (!states) return ADD_FAILURE() << states.error().text(), RestStateResult();
    out.states = std::move(*states);
    return out;
}

/// All roots of a = tanh(2 (d + tanh(2 a))), by bisection at sign changes.
std::vector<double> roots(double d) {
    const auto f = [&](double a) { return std::tanh(2 * (d + std::tanh(2 * a))) - a; };
    std::vector<double> out;
    constexpr int interval_count = 10'001;
    for (int k = 0; k < interval_count; ++k) {
        double low = -1.1 + 2.2 * k / interval_count, high = -1.1 + 2.2 * (k + 1) / interval_count;
        if ((f(low) > 0) == (f(high) > 0)) continue;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = (low + high) / 2;
            ((f(middle) > 0) == (f(low) > 0) ? low : high) = middle;
        }
        out.push_back(low);
    }
    return out;
}

TEST(RestStates, ALatchHasTwoStableAndOneUnstable) {
    for (const double d : {0.0, 0.02, -0.1}) {
        const auto result = find_states(latch(d));
        const auto known = roots(d);
        ASSERT_EQ(known.size(), 3U);
        ASSERT_EQ(result.states.size(), 3U) << d;
        EXPECT_EQ(result.count(true), 2);
        std::vector<double> a;
        for (const auto& s : result.states) a.push_back(result.value(s, "v(a)"));
        std::sort(a.begin(), a.end());
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], known[k], 1e-6);
        for (const auto& s : result.states) EXPECT_EQ(s.is_stable, std::abs(result.value(s, "v(a)") - known[1]) > 1e-3);
    }
}

TEST(RestStates, AVeryAsymmetricLatchHasOne) {
    ASSERT_EQ(roots(0.8).size(), 1U);
    const auto result = find_states(latch(0.8));
    ASSERT_EQ(result.states.size(), 1U);
    EXPECT_TRUE(result.states[0].is_stable && result.states[0].is_default && result.states[0].is_power_on);
}

/// When it is switched on slowly, the latch leaves 0 V towards the side that its asymmetry favours, and stays there.
TEST(RestStates, ALatchReachesTheSideThatItsAsymmetryFavours) {
    for (const double d : {0.02, -0.02}) {
        const auto result = find_states(latch(d));
        ASSERT_NE(result.power_on(), nullptr) << d;
        EXPECT_TRUE(result.power_on()->is_stable);
        EXPECT_EQ(result.value(*result.power_on(), "v(a)") > 0, d > 0);
    }
}

TEST(RestStates, ASchmittTriggerHasTwoStableWithinItsHysteresisAndOneOutside) {
    auto text = *read_text_file(test::source_root() + "/circuits/schmitt.cir");
    text.replace(text.find("vin in 0 0"), 10, "vin in 0 {level}");
    text.erase(text.find(".dc"));
    for (const auto& [level, states] : {std::pair{0.1, 1U}, {0.24, 1U}, {0.27, 3U}, {0.35, 3U}, {0.44, 3U}, {0.47, 1U}, {0.6, 1U}}) {
        const auto result = find_states(text + fmt::format(".param level={}\n.op\n", level));
        EXPECT_EQ(result.states.size(), states) << level;
        EXPECT_EQ(result.count(true), states == 3 ? 2 : 1) << level;
        ASSERT_NE(result.power_on(), nullptr);
        EXPECT_TRUE(result.power_on()->is_stable) << level;
        const double out = result.value(*result.power_on(), "v(out)");
        EXPECT_TRUE(level > 0.4 || out > 0.35) << level << ": the input reaches its level from below, but v(out) is " << out << " V";
    }
}

TEST(RestStates, AreCountedByOp) {
    const auto result = run_netlist(latch(0.02) + ".op states 1u\n.mc 1\n");
    EXPECT_EQ(result.number("stable_states"), 2);
    EXPECT_EQ(result.number("unstable_states"), 1);
    for (const char* wrong : {".op state", ".op states 0", ".op states 1m 2m", ".op states fast"}) {
        const auto refused = run_directives(make_circuit(latch(0) + wrong + "\n"));
        ASSERT_FALSE(refused) << wrong;
        EXPECT_GT(refused.error().location.column, 0) << refused.error().text();
    }
}

/// The fastest growing disturbance of the operating point of a netlist.
std::optional<UnstableMode> unstable_mode_of(const std::string& text) {
    auto context = AnalysisContext::make(make_circuit(text));
    if (!context) return ADD_FAILURE() << context.error().text(), std::nullopt;
    const auto point = find_operating_point((*context)->newton);
    if (!point) return ADD_FAILURE() << point.error().text(), std::nullopt;
    return find_unstable_mode((*context)->newton, point->x);
}

// Values over many decades make nearly singular matrices and tanks of high quality, whose disturbances turn many times before they end.
TEST(Stability, OfAPassiveCircuitIsHardlyEverDenied) {
    std::mt19937 random(7);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const auto value = [&](int low, int high) {
        const int decade = low + pick(high - low + 1), step = pick(80);
        return std::pow(10.0, decade) * (1 + 0.1 * step);
    };
    constexpr int circuits = 2000;
    int denied = 0;
    for (int k = 0; k < circuits; ++k) {
        std::string text = fmt::format("passive {}\nv1 n0 0 1\n", k);
        const int nodes = 2 + pick(5);
        for (int e = 0; e < 3 * nodes; ++e) {
            const int a = pick(nodes);
            const int b = pick(nodes + 1) - 1;
            if (a == b) continue;
            const auto ends = fmt::format("n{} {}", a, b < 0 ? "0" : fmt::format("n{}", b));
            const int kind = pick(3);
            if (kind == 0) text += fmt::format("r{} {} {}\n", e, ends, value(-6, 6));
            if (kind == 1) text += fmt::format("c{} {} {}\n", e, ends, value(-15, -4));
            if (kind == 2) {
                const double inductance = value(-9, -2), loss = value(-3, 3);
                text += fmt::format("l{0} m{0} {1} {2}\nr{0}l {3} m{0} {4}\n", e, ends.substr(ends.find(' ') + 1), inductance,
                                    ends.substr(0, ends.find(' ')), loss);
            }
        }
        for (int n = 1; n < nodes; ++n) text += fmt::format("rg{0} n{0} 0 1g\n", n);
        denied += unstable_mode_of(text + ".op\n").has_value();
    }
    EXPECT_LE(denied, circuits / 200) << "of " << circuits << " passive circuits, one in 200 may be called unstable";
}

TEST(Stability, OfATankWithANegativeConductanceIsDenied) {
    for (const double q : {0.7, 3.0})
        for (const double f : {1e2, 1e6, 1e10}) {
            const double c = 1e-3 / (2 * std::numbers::pi * f), l = 1e3 / (2 * std::numbers::pi * f);
            EXPECT_TRUE(unstable_mode_of(fmt::format("tank\nl1 a 0 {}\nc1 a 0 {}\nb1 a 0 i=-{}*v(a)\n.op\n", l, c, 1e-3 / q)))
                << q << " " << f;
            EXPECT_FALSE(unstable_mode_of(fmt::format("tank\nl1 a 0 {}\nc1 a 0 {}\nb1 a 0 i={}*v(a)\n.op\n", l, c, 1e-3 / q)))
                << q << " " << f;
        }
}

}  // namespace
}  // namespace corpuscle::circuit
