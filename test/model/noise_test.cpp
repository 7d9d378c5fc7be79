// Membrane noise: its amplitude at any sampling rate, and that it depends only on seed, afferent index, neuron and step.

#include <cmath>

#include "support/support.hpp"

namespace corpuscle {
namespace {

struct NoisyRun {
    std::vector<std::vector<double>> probes;
    std::vector<Spike> spikes;
};

/// Runs an afferent under the force f (N) at `rate` (Hz) in blocks. `noise`: standard deviation of the noise current
/// between 0 and 1 kHz, A.
NoisyRun run(const std::string& name, const std::vector<std::string>& settings, const std::vector<double>& f, double rate, double noise,
             std::uint32_t afferent_index = 0, std::uint64_t seed = 7, std::size_t block = 1 << 20) {
    const auto a = make_afferent(test::applied_or_throw(plan_afferent(name, test::parse_settings(settings))),
                                 {1 / rate, Method::exact, false, noise, seed});
    NoisyRun out{std::vector(a->probes().size(), std::vector<double>(f.size())), {}};
    auto state = a->start();
    for (std::size_t k = 0; k < f.size(); k += block) {
        std::vector<double*> here;
        for (auto& p : out.probes) here.push_back(p.data() + k);
        ResponseBlock response{out.spikes, afferent_index, here};
        EXPECT_TRUE(a->respond(std::span(f).subspan(k, std::min(block, f.size() - k)), state, response));
    }
    return out;
}

double mean(const std::vector<double>& x) {
    double sum = 0;
    for (const double v : x) sum += v;
    return sum / static_cast<double>(x.size());
}
/// The covariance of x and of y delayed by `lag` samples.
double covariance(const std::vector<double>& x, const std::vector<double>& y, std::size_t lag = 0) {
    double sum = 0;
    for (std::size_t k = lag; k < x.size(); ++k) sum += (x[k] - mean(x)) * (y[k - lag] - mean(y));
    return sum / static_cast<double>(x.size());
}

TEST(Noise, IsWhiteWithAVarianceProportionalToTheSamplingRate) {
    for (const double rate : {500.0, 2e3, 50e3}) {
        std::vector<double> f(4000, 0.0);
        const auto i = run("sa1a+lif-b", {}, f, rate, 100e-9).probes[2];
        const std::vector<double> x(i.begin() + 1, i.end());
        const double variance = 1e-14 * rate / 2e3;
        EXPECT_NEAR(mean(x), 0, 4 * std::sqrt(variance / 4000)) << rate;
        EXPECT_NEAR(covariance(x, x) / variance, 1, 0.1) << rate;
        EXPECT_NEAR(covariance(x, x, 1) / variance, 0, 0.07) << rate;
    }
}

TEST(Noise, GivesTheSameMembraneDeviationAtEverySamplingRate) {
    // R C u' = -u + R n, where the noise current n is white with the one-sided spectral density S = SD^2 / 1 kHz, SD = 100 nA. The variance
    // of u is then R^2 S / (4 R C).
    const double expected = std::sqrt(1e12 * 1e-14 / 1e3 / (4 * 10e-3));
    for (const double rate : {1e3, 4e3, 16e3}) {
        const std::vector<double> f(static_cast<std::size_t>(100 * rate), 0.0);
        const auto u = run("sa1a+lif-a", {"sa1a+lif-a.C_m=10nF"}, f, rate, 100e-9).probes[3];
        double squares = 0;
        for (const double x : u) squares += x * x;
        EXPECT_NEAR(std::sqrt(squares / static_cast<double>(u.size())) / expected, 1, 0.03) << rate;
    }
}

TEST(Noise, DependsOnlyOnSeedAfferentNeuronAndStep) {
    const auto f = test::force("press", {.rate = 2e3});
    const auto undivided = run("fa1a+lif-b", {}, f, 2e3, 1e-6);
    for (const std::size_t block : {1U, 7U, 333U}) {
        const auto in_blocks = run("fa1a+lif-b", {}, f, 2e3, 1e-6, 0, 7, block);
        EXPECT_EQ(in_blocks.spikes, undivided.spikes) << block;
        EXPECT_EQ(in_blocks.probes, undivided.probes) << block;
    }
    const auto other_afferent = run("fa1a+lif-b", {}, f, 2e3, 1e-6, 1), other_seed = run("fa1a+lif-b", {}, f, 2e3, 1e-6, 0, 8);
    const auto &up = undivided.probes[0], &down = undivided.probes[1];
    const double variance = covariance(std::vector(up.begin() + 1, up.begin() + 400), std::vector(up.begin() + 1, up.begin() + 400));
    EXPECT_NEAR(covariance(std::vector(up.begin() + 1, up.begin() + 400), std::vector(down.begin() + 1, down.begin() + 400)) / variance, 0,
                0.2)
        << "the noise of the two neurons is independent";
    EXPECT_NE(other_afferent.probes[0], up);
    EXPECT_NE(other_seed.probes[0], up);
}

TEST(Noise, ActsBehindASensorButNotInFixedPoint) {
    const auto f = test::force("press", {.rate = 2e3});
    const auto noiseless = run("fsr+f2v+sa1", {}, f, 2e3, 0), noisy = run("fsr+f2v+sa1", {}, f, 2e3, 1e-6);
    EXPECT_EQ(noiseless.probes[0], noisy.probes[0]);
    EXPECT_NE(noiseless.probes.back(), noisy.probes.back());
    EXPECT_EQ(run("sa1-kim", {}, f, 2e3, 0).probes, run("sa1-kim", {}, f, 2e3, 1e-6).probes);
}

}  // namespace
}  // namespace corpuscle
