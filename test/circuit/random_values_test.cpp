// Random functions and tolerances of netlists: what the chips of .mc draw.

#include <gtest/gtest.h>

#include "circuit/netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

/// The value of v(out) of each chip of a netlist in which 1 A flows through r1, so that v(out) is its resistance.
std::vector<double> resistances(const std::string& body, int chips = 2000) {
    std::vector<double> out;
    for (const auto& run : run_variants("spread\ni1 0 out 1\n" + body + "\n.op\n.mc " + std::to_string(chips) + " seed=7\n"))
        out.push_back(run.number("v(out)"));
    return out;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}
double deviation(const std::vector<double>& values) {
    const double m = mean(values);
    double sum = 0;
    for (const double v : values) sum += (v - m) * (v - m);
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

struct Distribution {
    std::string body;
    double mean, deviation, low, high;
};

class RandomFunctions : public testing::TestWithParam<Distribution> {};

TEST_P(RandomFunctions, HaveTheirMeanDeviationAndRange) {
    const auto& d = GetParam();
    const auto values = resistances(d.body);
    ASSERT_EQ(values.size(), 2000U);
    EXPECT_NEAR(mean(values), d.mean, 4 * d.deviation / std::sqrt(2000.0) + 1e-9) << d.body;
    EXPECT_NEAR(deviation(values) / d.deviation, 1, 0.07) << d.body;
    const auto [low, high] = std::ranges::minmax(values);
    EXPECT_GE(low, d.low - 1e-9) << d.body;
    EXPECT_LE(high, d.high + 1e-9) << d.body;
}

const double uniform = 1 / std::sqrt(3.0);  // deviation of a uniform distribution from -1 to 1
INSTANTIATE_TEST_SUITE_P(Each, RandomFunctions,
                         testing::Values(Distribution{"r1 out 0 {agauss(100,9,3)}", 100, 3, 80, 120},
                                         Distribution{".param r=gauss(100,0.06,3)\nr1 out 0 {r}", 100, 2, 85, 115},
                                         Distribution{"r1 out 0 {aunif(100,5)}", 100, 5 * uniform, 95, 105},
                                         Distribution{"r1 out 0 {unif(100,0.1)}", 100, 10 * uniform, 90, 110},
                                         Distribution{"r1 out 0 {limit(100,5)}", 100, 5, 95, 105},
                                         Distribution{"r1 out 0 100 dev=10%", 100, 10 * uniform, 90, 110},
                                         Distribution{"r1 out 0 100 dev/gauss=0.05", 100, 5, 70, 130},
                                         Distribution{"r1 out 0 rm 100\n.model rm r(r=1 dev/gauss=5%)", 100, 5, 70, 130},
                                         Distribution{"r1 out 0 rm 100\n.model rm r(r=1 lot 10%)", 100, 10 * uniform, 90, 110}));

TEST(RandomValues, OfALotAreEqualAndDeviationsOfElementsAreIndependent) {
    const std::string pair = "pair\nv1 a 0 1\nr1 a out rm 1k\nr2 out 0 rm 1k\n.op\n.mc 200 seed=1\n.model rm r(r=1 ";
    std::vector<double> lot, dev;
    for (const auto& run : run_variants(pair + "lot=10%)\n")) lot.push_back(run.number("v(out)"));
    for (const auto& run : run_variants(pair + "dev=10%)\n")) dev.push_back(run.number("v(out)"));
    EXPECT_LT(deviation(lot), 1e-9);
    EXPECT_NEAR(deviation(dev), 0.1 * uniform / std::sqrt(8.0), 0.002);
    // process=0 leaves the lot at its mean, mismatch=0 the elements
    for (const auto& run : run_variants("one\ni1 0 out 1\nr1 out 0 100 lot=10%\n.op\n.mc 5 process=0\n"))
        EXPECT_EQ(run.number("v(out)"), 100);
    for (const auto& run : run_variants("one\ni1 0 out 1\nr1 out 0 100 dev=10%\n.op\n.mc 5 mismatch=0\n"))
        EXPECT_EQ(run.number("v(out)"), 100);
}

TEST(RandomValues, AreTheSameForTheSameSeedAndDifferBetweenInstances) {
    const std::string body = ".subckt s a\n.param r={agauss(100,3,1)}\nr1 a 0 {r}\n.ends\ni2 0 b 1\nx1 out s\nx2 b s\n.op\n";
    const auto first = run_variants("same\ni1 0 out 1\n" + body + ".mc 3 seed=5\n");
    const auto again = run_variants("same\ni1 0 out 1\n" + body + ".mc 3 seed=5\n");
    const auto other = run_variants("same\ni1 0 out 1\n" + body + ".mc 3 seed=6\n");
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(first[k].number("v(out)"), again[k].number("v(out)"));
        EXPECT_NE(first[k].number("v(out)"), other[k].number("v(out)"));
        EXPECT_NE(first[k].number("v(out)"), first[k].number("v(b)"));
    }
}

TEST(RandomValues, OfSourcesAndCapacitorsVary) {
    std::vector<double> voltage, tau;
    for (const auto& run : run_variants("rc\nv1 a 0 2 dev/gauss=1%\nr1 a b 1k\nc1 b 0 1n lot/gauss=10%\n.ic v(b)=0\n.tran 10n 10u uic\n"
                                        ".meas tran end find v(b) at=10u\n.meas tran tau when v(b)=1 rise=1\n.mc 300 seed=2\n")) {
        voltage.push_back(run.number("end"));
        tau.push_back(run.number("tau"));
    }
    EXPECT_NEAR(deviation(voltage), 0.02, 0.003);
    EXPECT_GT(deviation(tau) / mean(tau), 0.08);
}

TEST(RandomValues, AreAtTheirMeansWithAWarningIfNothingDrawsThem) {
    const auto run = run_netlist("mean\ni1 0 out 1\nr1 out 0 {agauss(100,9,3)}\n.op\n");
    EXPECT_EQ(run.number("v(out)"), 100);
    ASSERT_EQ(run.warnings().size(), 1U);
    EXPECT_NE(run.warnings()[0].message.find("at their means"), std::string::npos);
}

TEST(RandomValues, NeedAnElementWithAConstantValue) {
    const auto error_of = [](const std::string& line) {
        const auto circuit = parse_netlist_text("bad\n" + line + "\nr9 a 0 1\n")->elaborate();
        return circuit ? "" : circuit.error().message;
    };
    EXPECT_EQ(error_of("v1 a 0 sin(0 1 1k) dev=1%"), "v1: dev= needs a constant value");
    EXPECT_EQ(error_of("d1 a 0 dm dev=1%\n.model dm d"), "d1: dev is not supported for a junction diode, only for an element with a value");
    EXPECT_EQ(error_of("r1 a 0 1k dev=-1%"), "a tolerance of -0.01 must not be negative");
    EXPECT_EQ(error_of("r1 a 0 rm 1k\n.model rm r(r=1 dev)"), "expected name=value, not 'dev'");
}

}  // namespace
}  // namespace corpuscle::circuit
