// The neuron alif: closed forms of its intervals, its refractory time, its random thresholds.

#include <cmath>

#include "model/models.hpp"
#include "model/parameter_values.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using Params = ParameterValues<Alif<double>>;

/// The spike times (s) under a constant current (A) for `seconds`, in steps of dt (s).
std::vector<double> fire(const Params& p, double current, double seconds, double dt, double stream = 0) {
    const Alif<double> neuron(p, dt, Method::exact);
    auto state = neuron.start(stream);
    std::vector<double> times;
    for (int k = 0; k < std::lround(seconds / dt); ++k)
        (void)neuron.step(state, Current<double>{current, current}, [&](bool, double x) { times.push_back((k + x) * dt); });
    return times;
}

TEST(Alif, FirstSpikeAndNextIntervalsSolveTheEquations) {
    const Params p{{"V_th", 0.5}, {"E_L", 0.05}, {"V_reset", -0.1}, {"dV_th", 0.3}, {"tau_th", 20e-3}, {"t_ref", 1.5e-3}, {"R_m", 5e5}, {"C_m", 8e-9}};
    const double tau = 4e-3, end = 0.05 + 5e5 * 3e-6;
    for (const double dt : {1e-5, 1e-4, 0.7e-3, 5e-3}) {
        const auto t = fire(p, 3e-6, 0.1, dt);
        ASSERT_GT(t.size(), 5U);
        EXPECT_NEAR(t[0], tau * std::log((end - 0.05) / (end - 0.5)), 1e-10) << dt;
        double a = 0;  // rise of the threshold just after a spike, V
        for (std::size_t k = 1; k < t.size(); ++k) {
            a = a * (k == 1 ? 0 : std::exp(-(t[k - 1] - t[k - 2]) / 20e-3)) + 0.3;
            const double interval = t[k] - t[k - 1], u = end + (-0.1 - end) * std::exp(-(interval - 1.5e-3) / tau),
                         theta = 0.5 + a * std::exp(-interval / 20e-3);
            EXPECT_NEAR(u, theta, 1e-8) << dt << ", interval " << k;
        }
    }
}

TEST(Alif, NoIntervalIsShorterThanTheRefractoryTime) {
    for (const double current : {1e-5, 1e-3, 1.0}) {
        const auto t = fire({{"t_ref", 1e-3}, {"dV_th", 0}, {"jitter", 0.3}}, current, 0.2, 0.37e-3);
        ASSERT_GT(t.size(), 100U);
        for (std::size_t k = 1; k < t.size(); ++k) ASSERT_GE(t[k] - t[k - 1], 1e-3 - 1e-12) << current;
    }
}

TEST(Alif, RandomThresholdsHaveTheirMeanAndDeviationAndDifferBetweenAfferents) {
    auto random = IrregularThreshold<double>::start(0.25), other = IrregularThreshold<double>::start(0.25 + 0x1p-24);
    constexpr int draws = 200'000;
    double sum = 0, squares = 0, products = 0, product_of_two = 0;
    for (int k = 0; k < draws; ++k) {
        const double before = random.factor - 1;
        random = random.next(0.2), other = other.next(0.2);
        const double x = random.factor - 1, y = other.factor - 1;
        ASSERT_LE(std::abs(x), 0.6);
        sum += x, squares += x * x, products += x * before, product_of_two += x * y;
    }
    const double error = 4 / std::sqrt(draws);  // four standard errors of a mean of variables with deviation 1
    EXPECT_NEAR(sum / draws / 0.2, 0, error);
    EXPECT_NEAR(std::sqrt(squares / draws) / 0.2, 1, error);
    EXPECT_NEAR(products / squares, 0, error) << "successive draws are independent";
    EXPECT_NEAR(product_of_two / squares, 0, error) << "afferents with neighbouring sequences are independent";
}

TEST(Alif, JitterMakesIntervalsIrregularAndEveryAfferentItsOwn) {
    const auto variation = [](const std::vector<double>& t) {
        double sum = 0, squares = 0;
        for (std::size_t k = 1; k < t.size(); ++k) sum += t[k] - t[k - 1], squares += (t[k] - t[k - 1]) * (t[k] - t[k - 1]);
        const double n = static_cast<double>(t.size() - 1), mean = sum / n;
        return std::sqrt(squares / n - mean * mean) / mean;
    };
    const Params regular{{"dV_th", 0}}, irregular{{"dV_th", 0}, {"jitter", 0.3}};
    EXPECT_LT(variation(fire(regular, 2e-6, 5, 1e-3)), 1e-6);
    EXPECT_GT(variation(fire(irregular, 2e-6, 5, 1e-3)), 0.15);
    EXPECT_EQ(fire(irregular, 2e-6, 1, 1e-3, 0.5), fire(irregular, 2e-6, 1, 1e-3, 0.5));
    EXPECT_NE(fire(irregular, 2e-6, 1, 1e-3, 0.5), fire(irregular, 2e-6, 1, 1e-3, 0.25));
}

}  // namespace
}  // namespace corpuscle
