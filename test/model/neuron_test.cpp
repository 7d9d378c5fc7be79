// Every neuron without a receptor, under currents with known responses.

#include <algorithm>
#include <cmath>

#include "model/models.hpp"
#include "model/parameter_values.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

struct NeuronRun {
    std::vector<double> times;     // s
    std::vector<double> membrane;  // V: first probe, at the end of each step
    std::int64_t truncated_steps = 0;
};

/// Runs a neuron under current(t) (A) for `seconds` in steps of dt (s).
template <template <class> class N>
NeuronRun run(ParameterValues<N<double>> p, const std::function<double(double)>& current, double seconds, double dt,
              Method method = Method::exact) {
    const N<double> neuron(p, dt, method);
    auto state = neuron.start();
    NeuronRun out;
    for (long k = 1; k <= std::lround(seconds / dt); ++k) {
        const double end = current(static_cast<double>(k) * dt),
                     from = method == Method::exact ? current(static_cast<double>(k - 1) * dt) : end;
        out.truncated_steps += neuron.step(state, Current<double>{from, end},
                                           [&](bool, double x) { out.times.push_back((static_cast<double>(k - 1) + x) * dt); });
        double parts[std::size(N<double>::recordables)];
        neuron.record(state, parts);
        out.membrane.push_back(parts[0]);
    }
    return out;
}

/// A current (A) under which the neuron fires at tens of hertz.
template <template <class> class N>
double strong_current() {
    return 5e-6;
}

template <template <class> class N>
constexpr bool has_refractory_time =
    std::any_of(std::begin(N<double>::parameters), std::end(N<double>::parameters), [](const auto& p) { return p.name == "t_ref"; });

TEST(Neuron, EachIsSilentAndConstantAtRest) {
    for_each_type(Neurons{}, []<template <class> class N>(ModelTag<N>) {
        for (const auto method : {Method::exact, Method::backward_euler}) {
            const auto result = run<N>({}, [](double) { return 0.0; }, 2, 1e-4, method);
            EXPECT_TRUE(result.times.empty()) << N<double>::name;
            for (const double v : result.membrane) ASSERT_NEAR(v, result.membrane[0], 1e-9) << N<double>::name << " drifts at rest";
        }
    });
}

TEST(Neuron, EachFiresFasterWithMoreCurrent) {
    for_each_type(Neurons{}, []<template <class> class N>(ModelTag<N>) {
        const auto slow = run<N>({}, [](double) { return 2.5e-6; }, 2, 1e-4), fast = run<N>({}, [](double) { return 10e-6; }, 2, 1e-4);
        EXPECT_GT(slow.times.size(), 2U) << N<double>::name;
        EXPECT_GT(fast.times.size(), slow.times.size()) << N<double>::name;
    });
}

TEST(Neuron, EachStaysAtTheResetVoltageForItsRefractoryTime) {
    for_each_type(Neurons{}, []<template <class> class N>(ModelTag<N>) {
        if constexpr (!has_refractory_time<N>) {
            EXPECT_TRUE(N<double>::name == "izhikevich" || N<double>::name == "adex") << "their recovery variable is their refractoriness";
        } else {
            for (const double t_ref : {0.4e-3, 5e-3, 20e-3})
                for (const auto method : {Method::exact, Method::backward_euler}) {
                    const ParameterValues<N<double>> p{{"t_ref", t_ref}};
                    const auto result = run<N>(p, [](double) { return 1e-3; }, 0.5, 1e-3, method);  // far above any threshold
                    ASSERT_GT(result.times.size(), 5U) << N<double>::name;
                    for (std::size_t k = 1; k < result.times.size(); ++k)
                        ASSERT_GE(result.times[k] - result.times[k - 1], t_ref - 1e-12) << N<double>::name;
                    if (t_ref < 5e-3) continue;
                    const auto sample =
                        static_cast<std::size_t>(result.times[0] / 1e-3);  // the step of the first spike ends in its refractory time
                    EXPECT_NEAR(result.membrane[sample], p("V_reset"), 1e-12) << N<double>::name;
                }
        }
    });
}

TEST(Neuron, LifBsIntervalsAreTheChargeOverTheNetCurrent) {
    const auto result = run<LifB>({}, [](double) { return strong_current<LifB>(); }, 1, 1e-3);
    ASSERT_GT(result.times.size(), 10U);
    EXPECT_NEAR(result.times[0], 500e-9 * 0.5 / 4.5e-6, 1e-12);
    for (std::size_t k = 1; k < result.times.size(); ++k) EXPECT_NEAR(result.times[k] - result.times[k - 1], 500e-9 * 0.25 / 4.5e-6, 1e-12);
}

TEST(Neuron, LifAsFiringRateMatchesTheClosedForm) {  // errata B5b
    const ParameterValues<LifA<double>> p{{"C_m", 1e-6}, {"R_m", 1e6}, {"E_L", 0}, {"V_th", 1}, {"V_reset", 0.5}};
    for (const double dt : {1e-4, 1e-2, 1.0}) {  // exact for any step, because the current is linear in each step
        const auto result = run<LifA>(p, [](double) { return 2e-6; }, 10, dt);
        ASSERT_GT(result.times.size(), 10U);
        for (std::size_t k = 1; k < result.times.size(); ++k)
            EXPECT_NEAR(1 / (result.times[k] - result.times[k - 1]), 2.466303, 1e-6) << dt;
    }
}

TEST(Neuron, IntegrateAndFireNeuronsFollowARampOfCurrentExactlyAtAnyStep) {
    const auto ramp = [](double t) { return 20e-6 * t; };
    const auto fine_b = run<LifB>({}, ramp, 1, 1e-5), coarse_b = run<LifB>({}, ramp, 1, 0.05);
    ASSERT_EQ(fine_b.times.size(), coarse_b.times.size());
    for (std::size_t k = 0; k < fine_b.times.size(); ++k) EXPECT_NEAR(fine_b.times[k], coarse_b.times[k], 1e-10) << k;
    const auto fine_a = run<LifA>({}, ramp, 1, 1e-5), coarse_a = run<LifA>({}, ramp, 1, 0.05);
    ASSERT_EQ(fine_a.times.size(), coarse_a.times.size());
    for (std::size_t k = 0; k < fine_a.times.size(); ++k) EXPECT_NEAR(fine_a.times[k], coarse_a.times[k], 1e-10) << k;
    const auto fine = run<Adaptive>({}, ramp, 1, 1e-5), coarse = run<Adaptive>({}, ramp, 1, 0.05);
    ASSERT_EQ(fine.times.size(), coarse.times.size());
    for (std::size_t k = 0; k < fine.times.size(); ++k) EXPECT_NEAR(fine.times[k], coarse.times[k], 1e-8) << k;
}

TEST(Neuron, AllSpikesOfAStepAreReturnedUpToALimitThatIsReported) {
    const auto many = run<LifB>({}, [](double) { return 50e-6; }, 0.5, 0.05);  // 396 Hz: about twenty spikes per step
    EXPECT_NEAR(static_cast<double>(many.times.size()), (49.5e-6 * 0.5 / 500e-9 - 0.5) / 0.25 + 1, 1);
    EXPECT_EQ(many.truncated_steps, 0);
    const auto too_many = run<LifB>({}, [](double) { return 50e-6; }, 0.5, 0.5);
    EXPECT_EQ(too_many.times.size(), static_cast<std::size_t>(max_spikes_per_step));
    EXPECT_EQ(too_many.truncated_steps, 1);
    EXPECT_EQ(run<LifA>({}, [](double) { return 50e-6; }, 0.5, 0.5).truncated_steps, 1);
    EXPECT_EQ(run<Adaptive>({}, [](double) { return 500e-6; }, 0.5, 0.5).truncated_steps, 1);
}

TEST(Neuron, LifBStaysAtRestUntilTheCurrentExceedsTheLeak) {
    const auto result = run<LifB>({}, [](double t) { return 1e-6 * t; }, 2, 0.2);  // reaches the leak of 0.5 uA in the middle of a step
    const double charge_to_fire = 500e-9 * 0.5;  // C, from rest. The net charge until time t (s) is 1e-6 (t - 0.5)^2 / 2
    ASSERT_EQ(result.times.size(), 8U);
    for (std::size_t k = 0; k < 8; ++k)
        EXPECT_NEAR(result.times[k], 0.5 + std::sqrt(2 * charge_to_fire * (1 + 0.5 * static_cast<double>(k)) / 1e-6), 1e-9);
}

TEST(Neuron, AdaptiveFiresAllSpikesWhileTheCurrentIsPositiveWithinAStep) {
    // The current falls from 100 uA to 0, or to -50 uA, in one step of 50 ms. All spikes occur while it is positive.
    for (const double end : {0.0, -50e-6}) {
        const auto coarse = run<Adaptive>({}, [=](double t) { return 100e-6 + (end - 100e-6) * t / 0.05; }, 0.05, 0.05);
        const auto fine = run<Adaptive>({}, [=](double t) { return 100e-6 + (end - 100e-6) * t / 0.05; }, 0.05, 1e-6);
        ASSERT_GT(fine.times.size(), 3U);
        ASSERT_EQ(coarse.times.size(), fine.times.size());
        for (std::size_t k = 0; k < fine.times.size(); ++k) EXPECT_NEAR(coarse.times[k], fine.times[k], 1e-8);
    }
}

TEST(Neuron, AdexWithoutARestingStateStartsAtTheRestingPotential) {
    const ParameterValues<Adex<double>> p{{"Delta_T", 0.1}};
    const Adex<double> neuron(p, 1e-4, Method::exact);
    EXPECT_EQ(neuron.start().v, p("E_L"));
}

TEST(Neuron, IzhikevichFiresAsPublished) {
    // Regular spiking at I = 10 in the units of Izhikevich's paper (mV, ms), simulated independently with a step of 1 us. The steady
    // interval is 44.2 ms.
    double v = -70, w = -14, last = 0, interval = 0;
    for (double t = 0; t < 1000; t += 1e-3) {
        const double dv = 0.04 * v * v + 5 * v + 140 - w + 10, dw = 0.02 * (0.2 * v - w);
        v += 1e-3 * dv, w += 1e-3 * dw;
        if (v > 30) v = -65, w += 8, interval = t - last, last = t;
    }
    const auto result = run<Izhikevich>({}, [](double) { return 10 / 2.5e6; }, 1, 1e-4);
    ASSERT_GT(result.times.size(), 5U);
    EXPECT_NEAR(result.times.back() - result.times[result.times.size() - 2], interval * 1e-3, 0.02e-3);
}

TEST(Neuron, AdexMatchesAFineEulerIntegration) {
    double v = -70.6e-3, w = 0;
    std::vector<double> right;
    for (double t = 0, h = 1e-7; t < 0.3; t += h) {
        const double I = 1.5e-9;
        const double dv = (-30e-9 * (v + 70.6e-3) + 30e-9 * 2e-3 * std::exp((v + 50.4e-3) / 2e-3) - w + I) / 281e-12,
                     dw = (4e-9 * (v + 70.6e-3) - w) / 144e-3;
        v += h * dv, w += h * dw;
        if (v > -40.4e-3) v = -70.6e-3, w += 80.5e-12, right.push_back(t);
    }
    const auto result = run<Adex>({}, [](double) { return 1.5e-9 / 3e-4; }, 0.3, 1e-4);
    ASSERT_EQ(result.times.size(), right.size());
    for (std::size_t k = 0; k < right.size(); ++k) EXPECT_NEAR(result.times[k], right[k], 0.1e-3) << k;
    EXPECT_GT(right[right.size() - 1] - right[right.size() - 2], 1.5 * (right[1] - right[0])) << "it adapts";
}

TEST(Neuron, SlopesByDualsMatchFiniteDifferencesForEveryParameter) {
    for_each_type(Neurons{}, []<template <class> class N>(ModelTag<N>) {
        constexpr double dt = 1e-4;
        constexpr int steps = 400;
        for (std::size_t parameter = 0; parameter < std::size(N<double>::parameters); ++parameter) {
            const auto& field = N<double>::parameters[parameter];
            if (field.name == "substep") continue;                      // it determines the number of substeps, an integer
            const auto spike_and_end = [&](auto neuron, auto number) {  // time of the last spike, in steps; membrane at the end
                using T = decltype(number);
                auto state = neuron.start();
                T last{};
                for (int k = 0; k < steps; ++k) {
                    const double from = 4e-6 + 1e-6 * k / steps, to = 4e-6 + 1e-6 * (k + 1) / steps;
                    (void)neuron.step(state, Current<T>{T(from), T(to)}, [&](bool, T x) { last = T(static_cast<double>(k)) + x; });
                }
                T parts[std::size(N<double>::recordables)];
                neuron.record(state, parts);
                return std::pair(last, parts[0]);
            };
            ParameterValues<N<double>> p;
            if constexpr (has_refractory_time<N>) p = {{"t_ref", 1.3e-3}};  // at 0 the derivative is one-sided
            const auto dual = spike_and_end(N<num::Dual>(DualValues<N<double>>{p, parameter}, dt, Method::exact), num::Dual{});
            const double scale = p[parameter] != 0 ? std::abs(p[parameter]) : field.unit == "V" ? 1e-2 : field.unit == "s" ? 1e-3 : 1e-6;
            const auto moved = [&](double by) {
                auto q = p;
                q[parameter] += by;
                return spike_and_end(N<double>(q, dt, Method::exact), 0.0);
            };
            const double h = 1e-6 * scale;
            const auto up = moved(h), down = moved(-h);
            const double time_slope = (up.first - down.first) / (2 * h), membrane_slope = (up.second - down.second) / (2 * h);
            EXPECT_NEAR(dual.first.d * scale, time_slope * scale, 1e-4 * (1 + std::abs(time_slope * scale)))
                << N<double>::name << '.' << field.name << ": time of a spike";
            EXPECT_NEAR(dual.second.d * scale, membrane_slope * scale, 1e-4 * (1e-2 + std::abs(membrane_slope * scale)))
                << N<double>::name << '.' << field.name << ": membrane";
        }
    });
}

}  // namespace
}  // namespace corpuscle
