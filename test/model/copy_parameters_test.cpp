// Copies of an afferent: which of their parameters are sampled, from which distribution, and on what the samples depend.

#include "model/components.hpp"
#include "model/copies.hpp"

#include <fmt/format.h>
#include <cmath>
#include <numeric>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

struct SampleOptions {
    std::vector<std::string> settings, spreads;  // as for --set and --spread
    std::uint32_t copies = 100'000;
    std::uint64_t seed = 1;
};

std::vector<AfferentPlan> sample_copies(const std::string& name, const SampleOptions& d) {
    const auto plan = test::applied_or_throw(plan_afferent(name, test::parse_settings(d.settings)));
    return value_or_throw(
        make_copies(plan, d.copies, test::applied_or_throw(distributions_for(plan, test::parse_settings(d.spreads))), d.seed));
}

/// The value of a parameter in each copy.
std::vector<double> values(const std::vector<AfferentPlan>& copies, std::string_view parameter) {
    std::vector<double> all;
    for (const auto& c : copies) all.push_back(*c.value(parameter));
    return all;
}

double mean_of(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size()); }

double covariance_of(const std::vector<double>& x, const std::vector<double>& y) {
    const double a = mean_of(x), b = mean_of(y);
    double sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - a) * (y[k] - b);
    return sum / static_cast<double>(x.size());
}

double deviation(const std::vector<double>& x) { return std::sqrt(covariance_of(x, x)); }

// Density of the standard normal distribution, and its probability of values above z.
double density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * M_PI); }
double above(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

// Mean and standard deviation of the standard normal distribution truncated to values above z.
double mean_above(double z) { return density(z) / above(z); }
double deviation_above(double z) { return std::sqrt(1 + z * mean_above(z) - mean_above(z) * mean_above(z)); }

TEST(ParameterDistribution, IsNormalAroundTheValueWithADeviationInPercentOrInItsUnit) {
    for (const auto* setting : {"sa1.f_B=10%", "sa1.f_B=2.5Hz"}) {
        const auto x = values(sample_copies("sa1", {{"sa1.f_B=25Hz"}, {setting}}), "f_B");
        const double n = static_cast<double>(x.size());
        EXPECT_NEAR(mean_of(x), 25, 4 * 2.5 / std::sqrt(n)) << setting;
        EXPECT_NEAR(deviation(x), 2.5, 4 * 2.5 / std::sqrt(2 * n)) << setting;
        for (const double z : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
            const auto more = static_cast<double>(std::count_if(x.begin(), x.end(), [&](double v) { return v > 25 + 2.5 * z; }));
            EXPECT_NEAR(more / n, above(z), 4 * std::sqrt(above(z) * (1 - above(z)) / n)) << setting << " beyond " << z;
        }
    }
}

TEST(ParameterDistribution, IsANormalTruncatedAtTheRangeOrByAnOrderConstraint) {
    // V_th (0.5 V, deviation 0.1 V) must be above V_reset = 0.45 V; I_leak0 (0.5 uA, deviation 1 uA) must not be negative. Both limits are
    // half a deviation below the mean.
    const auto V_th = values(sample_copies("sa1", {{"sa1.V_reset=0.45V"}, {"sa1.V_th=100mV"}}), "V_th");
    EXPECT_NEAR(mean_of(V_th), 0.5 + 0.1 * mean_above(-0.5), 4 * 0.1 * deviation_above(-0.5) / std::sqrt(1e5));
    EXPECT_GT(*std::min_element(V_th.begin(), V_th.end()), 0.45);
    const auto leak = values(sample_copies("sa1", {{}, {"sa1.I_leak0=1uA"}}), "I_leak0");
    EXPECT_NEAR(mean_of(leak), 0.5e-6 + 1e-6 * mean_above(-0.5), 4e-6 * deviation_above(-0.5) / std::sqrt(1e5));
    EXPECT_GE(*std::min_element(leak.begin(), leak.end()), 0);
}

TEST(ParameterDistribution, OfAFactorIsLognormalWithTheValueAsItsMedian) {
    const auto x = values(sample_copies("sa1", {{"sa1.f_B=25Hz"}, {"sa1.f_B=x3"}}), "f_B");
    const double n = static_cast<double>(x.size());
    for (const double z : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
        const auto more = static_cast<double>(std::count_if(x.begin(), x.end(), [&](double v) { return v > 25 * std::pow(3.0, z); }));
        EXPECT_NEAR(more / n, above(z), 4 * std::sqrt(above(z) * (1 - above(z)) / n)) << "beyond 3^" << z;
    }
    std::vector<double> logarithms;
    for (const double v : x) logarithms.push_back(std::log(v / 25) / std::log(3.0));
    EXPECT_NEAR(mean_of(logarithms), 0, 5 / std::sqrt(n));
    EXPECT_NEAR(deviation(logarithms), 1, 5 / std::sqrt(2 * n));
}

TEST(ParameterDistribution, OfAFactorIsTruncatedAtTheRangeAndDoesNotPileUpThere) {
    // The end of the range of f_B is close above the median, so nearly half of the samples are drawn again.
    const auto infos = parameter_infos(value_or_throw(plan_afferent("sa1")));
    const double high = (*find_parameter({"sa1", "f_B", ""}, infos))->high, median = 0.9 * high, end = std::log(high / median) / std::log(2.0);
    const auto x = values(sample_copies("sa1", {{fmt::format("sa1.f_B={}Hz", median)}, {"sa1.f_B=x2"}}), "f_B");
    EXPECT_LE(*std::max_element(x.begin(), x.end()), high);
    EXPECT_EQ(std::count(x.begin(), x.end(), high), 0);
    std::vector<double> logarithms;
    for (const double v : x) logarithms.push_back(std::log(v / median) / std::log(2.0));
    EXPECT_NEAR(mean_of(logarithms), -mean_above(-end), 4 * deviation_above(-end) / std::sqrt(1e5));
}

TEST(ParameterDistribution, IsWrittenAsTheUserTypesIt) {
    const auto plan = value_or_throw(plan_afferent("sa1"));
    const auto all = test::applied_or_throw(distributions_for(plan, test::parse_settings({"sa1.f_B=10%", "sa1.f_C=2.5Hz", "sa1.V_th=x3"})));
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].text(), "10%");
    EXPECT_EQ(all[1].text(), "2.5 Hz");
    EXPECT_EQ(all[2].text(), "x3");
}

TEST(ParameterDistribution, OfTwoOrderedParametersIsSampledJointly) {
    // The difference V_th - V_reset is normal, truncated at 0. The sum is independent of it, so it is normal without truncation.
    const auto copies = sample_copies("sa1", {{"sa1.E_L=-9V", "sa1.V_reset=0.25V"}, {"sa1.V_th=250mV", "sa1.V_reset=250mV"}});
    const auto V_th = values(copies, "V_th"), V_reset = values(copies, "V_reset");
    std::vector<double> difference, sum;
    for (std::size_t k = 0; k < V_th.size(); ++k) difference.push_back(V_th[k] - V_reset[k]), sum.push_back(V_th[k] + V_reset[k]);
    const double sd = 0.25 * std::sqrt(2.0), z = -0.25 / sd, root = std::sqrt(1e5);
    EXPECT_GT(*std::min_element(difference.begin(), difference.end()), 0);
    EXPECT_NEAR(mean_of(difference), 0.25 + sd * mean_above(z), 4 * sd * deviation_above(z) / root);
    EXPECT_NEAR(mean_of(sum), 0.75, 4 * sd / root);
    EXPECT_NEAR(deviation(sum), sd, 4 * sd / root / std::sqrt(2.0));
}

TEST(ParameterDistribution, DependsOnlyOnSeedNamesAndCopyNumber) {
    EXPECT_TRUE(rc::check("more copies, other settings in other orders, an alias of the name", [] {
        const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000);
        const auto few = *rc::gen::inRange<std::uint32_t>(1, 20), many = few + *rc::gen::inRange<std::uint32_t>(0, 100);
        std::vector<std::string> others = {"sa1.k_A=10%", "sa1.V_th=40%", "sa1.V_reset=60%", "sa1.t_ref=1ms", "sa1.K_B=300%"};
        for (std::size_t k = others.size(); k > 1; --k) std::swap(others[k - 1], others[*rc::gen::inRange<std::size_t>(0, k)]);
        others.resize(*rc::gen::inRange<std::size_t>(0, others.size() + 1));
        others.insert(others.begin() + *rc::gen::inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(others.size()) + 1),
                      "SA-I.f_B=2Hz");
        const auto alone = values(sample_copies("sa1", {{}, {"sa1.f_B=10%"}, few, seed}), "f_B");
        auto among = values(sample_copies("SA1", {{}, others, many, seed}), "f_B");
        among.resize(few);
        RC_ASSERT(alone == among);
    }));
}

TEST(ParameterDistribution, IsUncorrelatedBetweenSeedsCopiesAndNames) {
    const auto copies = sample_copies("sa1", {{}, {"sa1.f_B=10%", "sa1.f_C=10%"}});
    const auto f_B = values(copies, "f_B"), f_C = values(copies, "f_C");
    const auto other_seed = values(sample_copies("sa1", {{}, {"sa1.f_B=10%"}, 100'000, 2}), "f_B");
    const auto other_name = values(sample_copies("sa1b+lif-b", {{}, {"sa1b+lif-b.f_B=10%"}}), "f_B");
    const auto next = [&] {
        auto x = f_B;
        std::rotate(x.begin(), x.begin() + 1, x.end());
        return x;
    }();
    for (const auto* other : {&f_C, &other_seed, &other_name, &next})
        EXPECT_NEAR(covariance_of(f_B, *other) / deviation(f_B) / deviation(*other), 0, 4 / std::sqrt(1e5));
}

TEST(ParameterDistribution, GivesCopiesWithNamesAndNumbersThatShareTheirParameterInfo) {
    const auto copies = sample_copies("SA1", {{}, {"SA1.f_B=10%"}, 3});
    ASSERT_EQ(copies.size(), 3U);
    for (std::uint32_t k = 0; k < 3; ++k) {
        EXPECT_EQ(copies[k].name, "sa1#" + std::to_string(k + 1));
        EXPECT_EQ(copies[k].original_name, "sa1");
        EXPECT_EQ(copies[k].copy_number, k + 1);
        EXPECT_EQ(copies[k].parameters, copies[0].parameters) << "all copies share one list of parameters";
        EXPECT_EQ(*copies[k].value("V_th"), 0.5);
    }
    auto all = copies;
    const auto other = sample_copies("fa1", {{}, {}, 2});
    all.insert(all.end(), other.begin(), other.end());
    EXPECT_EQ(copy_group_starts(all), (std::vector<std::size_t>{0, 3, 5}));
    const std::vector originals = {value_or_throw(plan_afferent("sa1")), value_or_throw(plan_afferent("fa1"))};
    EXPECT_EQ(copy_group_starts(originals), (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(base_name(all[4]), "fa1");
    EXPECT_EQ(base_name(originals[1]), "fa1");
}

TEST(Contract, EveryParameterThatCopiesDoNotShareCanDifferInEveryAfferent) {
    for (const auto& name : test::all_afferent_names()) {
        const auto plan = value_or_throw(plan_afferent(name));
        std::vector<ParameterOverride> overrides;
        for (std::size_t k = 0; k < plan.values.size(); ++k) {
            const auto& row = (*plan.parameters)[k].info;
            if (!row.is_shared_by_copies && plan.values[k] != 0) overrides.push_back({name, std::string(row.name), "2%"});
        }
        const auto spreads = test::applied_or_throw(distributions_for(plan, overrides));
        const auto copies = value_or_throw(make_copies(plan, 4, spreads, 3));
        for (const auto& copy : copies) {
            EXPECT_TRUE(check_plan(copy)) << copy.name;
            for (const auto& s : spreads) EXPECT_NE(copy.value(s.parameter), plan.value(s.parameter)) << copy.name << '.' << s.parameter;
            for (std::size_t k = 0; k < copy.values.size(); ++k)
                EXPECT_TRUE(check_range(copy.name, (*copy.parameters)[k].info, copy.values[k])) << copy.name;
            EXPECT_TRUE(make_afferent(copy, {1e-3})) << copy.name;
        }
    }
}

TEST(Contract, CopiesShareIntegerParametersAndEverySubstep) {
    for (const auto name : Adc::integers)
        for (const auto& p : Adc::parameters) EXPECT_TRUE(p.name != name || p.is_shared_by_copies) << name;
    int substeps = 0;
    for (const auto& entry : neuron_entries())
        for (const auto& row : entry.parameters) {
            if (row.name != "substep") continue;
            EXPECT_TRUE(row.is_shared_by_copies) << entry.name;
            ++substeps;
        }
    EXPECT_GE(substeps, 2);
}

TEST(ParameterDistribution, OfASharedParameterIsRefusedByName) {
    const struct {
        std::string name;
        std::vector<std::string> spreads;
        std::string message;
    } cases[] = {
        {"sa1b+adex",
         {"sa1b+adex.substep=10%"},
         "--spread sa1b+adex.substep=10%: substep has one value for all copies; --set sa1b+adex.substep changes it"},
        {"sa1-kim", {"sa1-kim.word=1"}, "--spread sa1-kim.word=1: word has one value for all copies; --set sa1-kim.word changes it"},
        {"sa1",
         {"sa1.f_b=10%"},
         "sa1: unknown parameter 'f_b'; did you mean 'f_B'? (it has k_A, K_B, f_B, K_C, f_C, C_m, I_leak0, E_L, V_th, V_reset, t_ref)"},
        {"sa1", {"sa1.E_L=10%"}, "--spread sa1.E_L=10%: a percentage of 0 V is 0; write the deviation itself, in V"},
        {"fsr+sa1",
         {"fsr+sa1.hysteresis=10%"},
         "--spread fsr+sa1.hysteresis=10%: a percentage of 0 is 0; write the deviation itself, a plain number"},
        {"sa1", {"sa1.f_B=-1Hz"}, "--spread sa1.f_B=-1Hz: a standard deviation must not be negative"},
        {"sa1", {"sa1.f_B=1ms"}, "--spread sa1.f_B=1ms: '1ms' is a time; expected a value in Hz, such as '2 Hz'"},
        {"sa1", {"sa1.f_B=some%"}, "--spread sa1.f_B=some%: 'some%' is not a percentage; write a number and %, such as '10%'"},
        {"sa1", {"sa1.f_B=xHz"}, "--spread sa1.f_B=xHz: 'xHz' is not a factor; write x and a number, such as 'x3'"},
        {"sa1", {"sa1.f_B=x"}, "--spread sa1.f_B=x: 'x' is not a factor; write x and a number, such as 'x3'"},
        {"sa1", {"sa1.f_B=xinf"}, "--spread sa1.f_B=xinf: 'xinf' is not a factor; write x and a number, such as 'x3'"},
        {"sa1", {"sa1.f_B=x0.5"}, "--spread sa1.f_B=x0.5: a factor must be at least 1; x3 means divided by 3 or multiplied by 3"},
        {"sa1", {"sa1.E_L=x2"}, "--spread sa1.E_L=x2: 0 V times a factor is 0; write the deviation itself, in V"},
        {"sa1", {"sa1.f_B=1Hz", "SA-I.f_B=10%"}, "--spread SA-I.f_B=10%: sa1.f_B is given twice"},
    };
    for (const auto& c : cases) {
        const auto spreads = distributions_for(value_or_throw(plan_afferent(c.name)), test::parse_settings(c.spreads, "--spread"));
        ASSERT_FALSE(spreads) << c.message;
        EXPECT_EQ(spreads.error().text(), c.message);
    }
}

TEST(ParameterDistribution, WithoutAcceptableSamplesIsAnErrorAfterAThousandTries) {
    const auto plan = value_or_throw(plan_afferent("sa1"));
    const auto wide = make_copies(plan, 2, test::applied_or_throw(distributions_for(plan, test::parse_settings({"sa1.V_th=1GV"}))), 1);
    ASSERT_FALSE(wide);
    EXPECT_EQ(wide.error().text(),
              "sa1#1: none of 1000 samples of V_th about 500 mV with a standard deviation of 1 GV is valid; lower its --spread");
    const auto narrow =
        test::applied_or_throw(plan_afferent("sa1", test::parse_settings({"sa1.E_L=499.9mV", "sa1.V_reset=500mV", "sa1.V_th=500.1mV"})));
    const auto factor =
        make_copies(narrow, 2, test::applied_or_throw(distributions_for(narrow, test::parse_settings({"sa1.V_reset=x1e300"}))), 1);
    ASSERT_FALSE(factor);
    EXPECT_TRUE(factor.error().text().starts_with(
        "sa1#1: none of 1000 samples of V_reset about 500 mV with a spread of x1e+300 is valid (the last: "))
        << factor.error().text();
    // For half of the samples of the feedback resistance R_fb, the transducer's output V_Z at the calibration force F_cal would be above
    // the supply, so that the sensor could not be calibrated. These are sampled again.
    const auto edge = sample_copies("fsr+f2v+sa1", {{"fsr+f2v+sa1.R_fb=13.3kohm"}, {"fsr+f2v+sa1.R_fb=10%"}, 1000});
    for (const auto& copy : edge) EXPECT_TRUE(check_plan(copy));
}

TEST(ParameterDistribution, OfZeroWidthLeavesEveryCopyUnchanged) {
    const auto plan = value_or_throw(plan_afferent("sa1"));
    for (const auto& copy : sample_copies("sa1", {{}, {"sa1.E_L=0%", "sa1.f_B=0Hz", "sa1.f_C=x1"}, 5})) EXPECT_EQ(copy.values, plan.values);
}

}  // namespace
}  // namespace corpuscle
