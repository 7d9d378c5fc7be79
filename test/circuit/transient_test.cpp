// Transients compared with closed forms, and the period of an oscillator compared between settings.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "circuit/device/source_waveform.hpp"
#include "circuit/netlist_runner.hpp"
#include "circuit/oscillator.hpp"

namespace corpuscle::circuit {
namespace {

TEST(Transient, ACapacitorChargesWithItsTimeConstant) {
    const auto run = run_netlist("rc\nv1 in 0 pulse(0 1 1m 1u 1u 5m 20m)\nr1 in out 1k\nc1 out 0 1u\n.tran 10u 6m 0 100u\n");
    const auto t = run.curve("time"), v = run.curve("v(out)");
    ASSERT_GT(t.size(), 50U);
    for (std::size_t k = 0; k < t.size(); ++k) {
        if (t[k] < 1.001e-3) continue;
        const double exact = 1 - 1e3 * (std::exp(1e-3) - 1) * std::exp(-(t[k] - 1e-3) / 1e-3);
        // the error per step may be 1e-4 of a volt plus 10 uV; errors of about ten steps per time constant accumulate
        EXPECT_NEAR(v[k], exact, 10 * 1.1e-4) << t[k];
    }
}

TEST(Transient, ATankRingsAtItsFrequency) {
    const auto run =
        run_netlist("tank\nl1 a 0 1m\nc1 a 0 1u\nr1 a 0 1k\n.ic v(a)=1\n.tran 1u 2m 0 1u uic\n.meas tran tenth when v(a)=0 cross=10\n");
    // v = exp(-alpha t) (cos(omega t) - alpha / omega sin(omega t)), alpha = 1 / 2RC
    const double alpha = 500, omega = std::sqrt(1e9 - alpha * alpha);
    const double exact = (9.5 * 3.141592653589793 - std::atan(alpha / omega)) / omega;
    EXPECT_NEAR(run.number("tenth"), exact, 1e-3 * exact);
}

TEST(Transient, BreakpointsOfASourceAreAmongThePoints) {
    const auto run = run_netlist("corners\nv1 a 0 pwl(0 0 1m 0 1.5m 1 3m -1)\nr1 a 0 1k\nc1 a 0 1n\n.tran 10u 4m\n");
    const auto t = run.curve("time"), v = run.curve("v(a)");
    for (const auto& [at, expected] : {std::pair{1e-3, 0.0}, {1.5e-3, 1.0}, {3e-3, -1.0}, {4e-3, -1.0}}) {
        const auto k = std::find(t.begin(), t.end(), at);
        ASSERT_NE(k, t.end()) << at;
        EXPECT_NEAR(v[static_cast<std::size_t>(k - t.begin())], expected, 1e-9);
    }
}

TEST(SourceWaveform, FollowsSpice) {
    Waveform pulse;
    pulse.shape = Waveform::Shape::pulse, pulse.numbers = {1, 3, 1e-3, 1e-4, 2e-4, 5e-4, 2e-3, 2};
    const SourceWaveform p(pulse, 1e-5, 1);
    for (const auto& [t, v] :
         {std::pair{0.0, 1.0}, {1.05e-3, 2.0}, {1.3e-3, 3.0}, {1.7e-3, 2.0}, {2e-3, 1.0}, {3.05e-3, 2.0}, {5.05e-3, 1.0}})
        EXPECT_NEAR(p.at(t), v, 1e-9) << t;
    double t = 0;
    for (const double corner : {1e-3, 1.1e-3, 1.6e-3, 1.8e-3, 3e-3, 3.1e-3}) EXPECT_NEAR(t = p.next_breakpoint(t), corner, 1e-15);
    Waveform sine;
    sine.shape = Waveform::Shape::sine, sine.numbers = {0.5, 2, 100, 1e-3, 10};
    const SourceWaveform s(sine, 1e-5, 1);
    EXPECT_NEAR(s.at(0.5e-3), 0.5, 1e-12);
    EXPECT_NEAR(s.at(8e-3), 0.5 + 2 * std::sin(6.283185307179586 * 0.7) * std::exp(-0.07), 1e-12);
    Waveform rise;
    rise.shape = Waveform::Shape::exponential, rise.numbers = {0, 1, 1e-3, 2e-3, 5e-3, 1e-3};
    const SourceWaveform e(rise, 1e-5, 1);
    EXPECT_NEAR(e.at(3e-3), 1 - std::exp(-1), 1e-12);
    EXPECT_NEAR(e.at(6e-3), (1 - std::exp(-2.5)) - (1 - std::exp(-1)), 1e-12);
}

TEST(Transient, AnOscillatorKeepsItsPeriod) {
    const auto run = run_netlist(oscillator_netlist("0.4"));
    const auto t = run.curve("time"), s = run.curve("v(s)");
    std::vector<double> spikes;
    for (std::size_t k = 1; k < t.size(); ++k)
        if (s[k - 1] < 0.35 && s[k] >= 0.35) spikes.push_back(t[k - 1] + (t[k] - t[k - 1]) * (0.35 - s[k - 1]) / (s[k] - s[k - 1]));
    ASSERT_GT(spikes.size(), 8U);
    const double first = spikes[2] - spikes[1];
    EXPECT_NEAR(first, 0.029, 0.003);
    for (std::size_t k = 3; k < spikes.size(); ++k) EXPECT_NEAR(spikes[k] - spikes[k - 1], first, 1e-3 * first) << k;
}

}  // namespace
}  // namespace corpuscle::circuit
