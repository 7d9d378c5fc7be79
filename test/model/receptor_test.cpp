// Every receptor without a neuron, and named afferents with known behaviour.

#include <fmt/format.h>

#include <cmath>

#include "model/models.hpp"
#include "model/parameter_values.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Receptor, HighPassUnderARampIsExactAtAnyStep) {
    const double f = 20, w = 2 * M_PI * f, slope = 3;
    for (const double dt : {1e-6, 1e-4, 1e-2, 0.3}) {
        const HighPass<double> filter(f, dt, Method::exact);
        double x = 0;
        for (int k = 1; k <= 10; ++k) {
            x = filter.next(x, slope * dt);
            EXPECT_NEAR(x, slope / w * -std::expm1(-w * k * dt), 1e-14) << dt;
        }
    }
}

TEST(Receptor, CurrentsAreContinuousUnlessTheyDependOnTheSlopeOfForce) {
    for_each_type(Receptors{}, []<template <class> class R>(ModelTag<R>) {
        const std::string name(R<double>::name);
        const R<double> receptor(ParameterValues<R<double>>(), 1e-3, Method::exact);
        const auto f = test::force("press", {.rate = 1e3});
        auto s = receptor.start(f[0]);
        Current<double> i[R<double>::outputs], before[R<double>::outputs] = {};
        for (std::size_t k = 1; k < f.size(); ++k) {
            receptor.step(s, f[k], i);
            for (int o = 0; o < R<double>::outputs; ++o) {
                ASSERT_TRUE(std::isfinite(i[o].from) && std::isfinite(i[o].to)) << name;
                ASSERT_GE(i[o].to, 0) << name << " never inhibits";
                if (k > 1 && name != "sa1a" && name != "fa1a") {  // the currents of these two depend on the slope of the force
                    ASSERT_EQ(i[o].from, before[o].to) << name;
                }
                before[o] = i[o];
            }
        }
    });
}

TEST(Receptor, SlopesByDualsMatchFiniteDifferencesForEveryParameter) {
    for_each_type(Receptors{}, []<template <class> class R>(ModelTag<R>) {
        const auto f = test::force("press", {.rate = 1e3});
        for (const auto method : {Method::exact, Method::backward_euler})
            for (std::size_t k = 0; k < std::size(R<double>::parameters); ++k) {
                const auto current = [&](auto receptor, auto number) {  // A; at 330 ms, during protraction
                    using T = decltype(number);
                    auto s = receptor.start(T(f[0]));
                    Current<T> i[R<double>::outputs];
                    for (std::size_t t = 1; t <= 330; ++t) receptor.step(s, T(f[t]), i);
                    return i[0].to;
                };
                ParameterValues<R<double>> p;
                for (std::size_t j = 0; j < std::size(R<double>::parameters); ++j)
                    if (R<double>::parameters[j].name == "k_B" && p[j] == 0) p[j] = 0.3;  // at 0 the derivative is one-sided
                const double scale = p[k] != 0 ? p[k] : 1e-6, h = 1e-5 * scale;
                const auto moved = [&](double by) {
                    auto q = p;
                    q[k] += by;
                    return current(R<double>(q, 1e-3, method), 0.0);
                };
                const double slope = (moved(h) - moved(-h)) / (2 * h) * scale,
                             dual_slope = current(R<num::Dual>(DualValues<R<double>>{p, k}, 1e-3, method), num::Dual{}).d * scale;
                const double rounding = 5e-11 * std::abs(current(R<double>(p, 1e-3, method), 0.0));  // of the difference over 2e-5
                EXPECT_NEAR(dual_slope, slope, 1e-7 * std::abs(slope) + 1e-17 + rounding) << R<double>::name << '.' << R<double>::parameters[k].name;
            }
    });
}

TEST(Receptor, StaticCurrentsAreProportionalToForce) {
    for (const auto& [name, gain] : {std::pair{"sa1b+lif-b", 1e-6}, {"sa1a+lif-b", 1e-6}}) {
        const auto a = test::afferent(name);
        const std::vector<double> f(1000, 3.0);
        std::vector<std::vector<double>> probes(a->probes().size(), std::vector<double>(f.size()));
        std::vector<double*> probe_pointers;
        for (auto& p : probes) probe_pointers.push_back(p.data());
        std::vector<Spike> out;
        ResponseBlock response{out, 0, probe_pointers};
        auto state = a->start();
        ASSERT_TRUE(a->respond(f, state, response));
        for (std::size_t p = 0; p < probes.size(); ++p)
            if (a->probes()[p].name == "I") {
                EXPECT_NEAR(probes[p].back(), 3 * gain, 1e-18) << name;
            }
    }
}

TEST(Afferent, Sa2FiresRegularlyInAHold) {
    const auto t = test::train("sa2", "ramp-hold", {.settings = {"ramp-hold.t_hold=2s"}});
    std::vector<double> hold;
    for (const double x : t)
        if (x > 0.8 && x < 2.3) hold.push_back(x);
    ASSERT_GT(hold.size(), 10U);
    for (std::size_t k = 2; k < hold.size(); ++k)
        EXPECT_NEAR(hold[k] - hold[k - 1], hold[k - 1] - hold[k - 2], 0.2 * (hold[1] - hold[0])) << "no more than the small jitter";
}

TEST(Afferent, Fa2IsMostSensitiveAt200To300Hz) {
    const auto rate = [](double f, double amplitude) {
        return test::train("fa2", "sine",
                           {.settings = {fmt::format("sine.f={}Hz", f), fmt::format("sine.F_amp={}N", amplitude), "sine.duration=2s"},
                            .rate = 20e3})
            .size();
    };
    const auto threshold = [&](double f) {  // the smallest amplitude (N) at which it fires within two seconds
        double low = 1e-4, high = 10;
        for (int k = 0; k < 20; ++k) (rate(f, std::sqrt(low * high)) > 0 ? high : low) = std::sqrt(low * high);
        return high;
    };
    double best = 0, lowest_threshold = INFINITY;
    for (const double f : {20.0, 40.0, 80.0, 120.0, 160.0, 200.0, 250.0, 300.0, 350.0, 400.0, 500.0, 800.0})
        if (const double at = threshold(f); at < lowest_threshold) lowest_threshold = at, best = f;
    EXPECT_GE(best, 200);
    EXPECT_LE(best, 300);
    EXPECT_GT(threshold(20), 10 * lowest_threshold);
    EXPECT_GT(threshold(800), 1.5 * lowest_threshold);
}

TEST(Afferent, TouchSimsNamesAndOtherSpellingsAreAccepted) {
    for (const auto& [alias, name] : {std::pair{"SA1", "sa1"}, {"PC", "fa2"}, {"SA-I", "sa1"}, {"FA-II", "fa2"}})
        EXPECT_EQ(test::value_or_throw(plan_afferent(alias)).name, name);
    const auto overrides = test::parse_settings({"RA.f_hp=30Hz"});
    EXPECT_EQ(test::applied_or_throw(plan_afferent("RA", overrides)).value("f_hp"), 30);
}

TEST(Afferent, WrongNamesAreRefusedWithASuggestion) {
    EXPECT_EQ(plan_afferent("sa").error().message,
              "unknown afferent 'sa'; did you mean 'sa1'? ('corpuscle list' shows them all; a receptor and a neuron are combined as "
              "'sa1b+lif-b')");
    EXPECT_EQ(plan_afferent("sa1b+lifb").error().message,
              "sa1b+lifb: unknown neuron 'lifb'; did you mean 'lif-b'? (there are lif-a, lif-b, adaptive, izhikevich, adex, alif)");
    EXPECT_EQ(plan_afferent("sa1", test::parse_settings({"sa1.V_reset=600mV"})).error().message,
              "sa1: V_reset = 0.6 must be below V_th = 0.5");
    EXPECT_EQ(plan_afferent("sa1", test::parse_settings({"sa1.f_B=25ms"})).error().message,
              "sa1.f_B: '25ms' is a time; expected a value in Hz, such as '2 Hz'");
}

}  // namespace
}  // namespace corpuscle
