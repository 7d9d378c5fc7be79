// Noise in transients: its densities, and what it does in circuits with a closed form.

#include <fmt/format.h>
#include <numbers>

#include "circuit/solve/transient_noise.hpp"
#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double kT = 1.380649e-23 * 300.15;  // J, at 27 C

double mean_of(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size()); }

double variance_of(const std::vector<double>& x) {
    double sum = 0;
    const double mean = mean_of(x);
    for (const double value : x) sum += (value - mean) * (value - mean);
    return sum / static_cast<double>(x.size() - 1);
}

/// Four standard deviations of the variance of n normal deviates, relative to it.
double interval(std::size_t n) { return 4 * std::sqrt(2 / static_cast<double>(n)); }

/// The noise currents (A) out of a node in successive intervals of the noise, at the unknowns x.
std::vector<double> noise_currents(const AnalysisContext& context, const NoisePlan& plan, std::span<const double> x, std::size_t count) {
    TransientNoise noise(context.system, plan);
    noise.begin(x, plan.stream);
    std::vector<double> charge(x.size()), out;
    for (double t = 0; out.size() < count;) {
        const double end = noise.next_sample(t);
        noise.charges(t, end, charge);
        out.push_back(charge[0] / (end - t));
        t = end;
    }
    return out;
}

/// The mean over some bins of the density of x, sampled at `rate` (Hz), in segments of this length with a Hann window, times f^power.
double mean_density(const std::vector<double>& x, double rate, std::size_t segment, std::size_t first_bin, std::size_t last_bin,
                    double power) {
    double sum = 0;
    const double samples = static_cast<double>(segment);
    for (std::size_t begin = 0; begin + segment <= x.size(); begin += segment)
        for (std::size_t bin = first_bin; bin <= last_bin; ++bin) {
            std::complex<double> amplitude = 0;
            for (std::size_t k = 0; k < segment; ++k) {
                const double turns = static_cast<double>(k) / samples;
                const double window = 1 - std::cos(2 * std::numbers::pi * turns);
                amplitude += window * x[begin + k] * std::polar(1.0, -2 * std::numbers::pi * turns * static_cast<double>(bin));
            }
            const double f = rate * static_cast<double>(bin) / samples;
            sum += 2 * std::norm(amplitude) / (rate * samples * 1.5) * std::pow(f, power);  // 1.5: mean square of the window
        }
    return sum / static_cast<double>(x.size() / segment * (last_bin - first_bin + 1));
}

std::unique_ptr<AnalysisContext> context_of(const std::string& text) {
    auto context = AnalysisContext::make(make_circuit(text));
    if (!context) throw std::runtime_error(context.error().text());
    return std::move(*context);
}

TEST(TransientNoise, OfAResistorIsWhite) {
    const auto context = context_of("white\nr1 a 0 1k\n.op\n");
    const auto i = noise_currents(*context, {.fmax = 1e4, .seed = 5}, std::vector{0.0}, 1 << 15);
    const double S = 4 * kT / 1e3;
    EXPECT_NEAR(variance_of(i) / (S * 1e4), 1, interval(i.size()));
    EXPECT_NEAR(mean_density(i, 2e4, 256, 2, 10, 0) / S, 1, 4 / std::sqrt(128.0 * 9));
    double product = 0;
    for (std::size_t k = 1; k < i.size(); ++k) product += i[k] * i[k - 1];
    EXPECT_NEAR(product / static_cast<double>(i.size()) / variance_of(i), 0, 4 / std::sqrt(static_cast<double>(i.size())));
}

TEST(TransientNoise, OfADiodeWithFlickerFallsWithTheFrequency) {
    const auto context = context_of("flicker\nd1 a 0 d\n.model d d(is=1f kf=1p)\n.op\n");
    const std::vector<double> x = {0.6};
    const auto& diode = *context->system.device("d1");
    const auto sources = diode.noise(context->system.terminal_values(diode, x));
    ASSERT_EQ(sources.size(), 2u);
    const double shot = sources[0].white, K = sources[1].flicker;
    ASSERT_GT(K, 1e6 * shot);
    const auto i = noise_currents(*context, {.fmax = 1e4, .fmin = 1, .seed = 6}, x, 1 << 17);
    // Bands of a thirtieth to a sixth of fmax, and 200 times below.
    EXPECT_NEAR(mean_density(i, 2e4, 256, 4, 20, 1) / K, 1, 4 / std::sqrt(512.0 * 17));
    EXPECT_NEAR(mean_density(i, 2e4, 16384, 4, 20, 1) / K, 1, 4 / std::sqrt(8.0 * 17));
}

TEST(TransientNoise, IsAFunctionOfSeedAndStream) {
    const auto context = context_of("white\nr1 a 0 1k\n.op\n");
    const std::vector<double> x = {0.0};
    const auto first = noise_currents(*context, {.fmax = 1e4, .seed = 5}, x, 100);
    EXPECT_EQ(first, noise_currents(*context, {.fmax = 1e4, .seed = 5}, x, 100));
    EXPECT_NE(first, noise_currents(*context, {.fmax = 1e4, .seed = 6}, x, 100));
    EXPECT_NE(first, noise_currents(*context, {.fmax = 1e4, .seed = 5, .stream = 1}, x, 100));
}

TEST(TransientNoise, ContinuesWhenTheOriginOfTimeMoves) {
    const auto context = context_of("white\nr1 a 0 1k\nd1 a 0 d\n.model d d(is=1f kf=1p)\n.op\n");
    const std::vector<double> x = {0.6};
    const NoisePlan plan{.fmax = 1e4};
    TransientNoise noise(context->system, plan), moved(context->system, plan);
    noise.begin(x, 0), moved.begin(x, 0);
    moved.shift_origin(1000 * plan.interval());
    std::vector<double> charge(1), moved_charge(1);
    for (int cell = 1000; cell < 1010; ++cell) {
        const double t = cell * plan.interval(), h = 0.5 * plan.interval();
        noise.charges(t, t + h, charge), moved.charges(t - 1000 * plan.interval(), t - 1000 * plan.interval() + h, moved_charge);
        EXPECT_NEAR(charge[0] / moved_charge[0], 1, 1e-9);
    }
}

// A formula of order 2 extrapolates the current: from two intervals, the variance would be 2.5 times as large.
TEST(TransientNoise, OfANodeFasterThanTheBandIsTheCurrentOfEachInterval) {
    for (const char* load : {"", "c1 a 0 1p\n", "c1 a 0 30p\n"}) {
        const auto run =
            run_netlist(std::string("fast\nr1 a 0 1k\ni1 0 a 1u\n") + load + ".options noisefmax=1meg noiseseed=3\n.tran 1u 4m\n");
        const auto t = run.curve("time"), v = run.curve("v(a)");
        std::vector<double> at_ends;
        for (std::size_t k = 1; k < t.size(); ++k)
            if (std::abs(t[k] * 2e6 - std::round(t[k] * 2e6)) < 1e-6) at_ends.push_back(v[k]);
        ASSERT_GE(at_ends.size(), 8000u);
        EXPECT_NEAR(variance_of(at_ends) / (4 * kT * 1e3 * 1e6), 1, interval(at_ends.size())) << load;
    }
}

// A sample is taken 20 time constants after the switch has closed. The noise of each capacitor is independent. A time constant of 20
// intervals loses up to 2 % of the variance: between two samples of the noise, a current that is constant has not yet diffused.
TEST(TransientNoise, OfASampledCapacitorIsKTByC) {
    constexpr int capacitors = 12;
    std::string text = "sampled\nv1 in 0 1\nvclk clk 0 pulse(0 1 0 10n 10n 40u 80u)\n.model sw sw(vt=0.5 ron=1meg roff=1e15)\n";
    for (int k = 0; k < capacitors; ++k) text += fmt::format("s{0} in c{0} clk 0 sw\nc{0} c{0} 0 2p\n", k);
    const auto run = run_netlist(text + ".options noisefmax=5meg noiseseed=2\n.tran 1u 10m\n.end\n");
    const auto t = run.curve("time");
    std::vector<double> held;
    for (int k = 0; k < capacitors; ++k) {
        const auto v = run.curve(fmt::format("v(c{})", k));
        for (double at = 60e-6; at < 10e-3; at += 80e-6) {
            const auto after = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), at) - t.begin());
            held.push_back(v[after] - 1);
        }
    }
    ASSERT_EQ(held.size(), 125u * capacitors);
    EXPECT_NEAR(variance_of(held) / (kT / 2e-12), 1, interval(held.size()) + 0.02);
    EXPECT_NEAR(mean_of(held), 0, 4 * std::sqrt(kT / 2e-12 / static_cast<double>(held.size())));
}

// A current I charges C from V_L to V_H, where a switch discharges it. R draws current and adds its noise: at V_H the variance of the
// voltage is kT/C (1 - exp(-2 T / RC)), and its slope (I - V_H / R) / C.
TEST(TransientNoise, MakesTheIntervalsOfAnOscillatorVary) {
    constexpr double I = 10e-9, R = 1e9, C = 10e-12, low = 0.1, high = 0.5;
    const std::string text =
        "oscillator\ni1 0 out 10n\nr1 out 0 1g\nc1 out 0 10p ic=0.1\ns1 out 0 out 0 sw\n.model sw sw(vt=0.3 vh=0.2 ron=10k roff=1e15)\n"
        ".options noisefmax=100k noisescale=10 noiseseed=3\n.spike v(out) 0.4\n.tran 1u 0.2 uic\n";
    const auto run = run_netlist(text);
    const auto& spikes = *run.analyses()[0].result.spikes;
    std::vector<double> intervals;
    for (std::size_t k = 1; k < spikes.size(); ++k) intervals.push_back(spikes[k] - spikes[k - 1]);
    ASSERT_GT(intervals.size(), 450u);
    const double T = -R * C * std::log((I - high / R) / (I - low / R));
    EXPECT_NEAR(mean_of(intervals) / T, 1, 1e-3);  // the discharge takes a little
    const double sigma = 10 * std::sqrt(kT / C * (1 - std::exp(-2 * T / (R * C)))) * C / (I - high / R);
    EXPECT_NEAR(variance_of(intervals) / (sigma * sigma), 1, interval(intervals.size()));
    // The noise does not depend on the steps, so a tenth of the tolerances moves no spike by more than a small part of the jitter.
    EXPECT_LT(run.number("spike_error"), 0.05 * sigma * std::sqrt(static_cast<double>(spikes.size())));
}

TEST(TransientNoise, OfATrnoiseSourceHasItsDeviationAndInterval) {
    const auto run = run_netlist("source\nv1 a 0 0.5 trnoise(1m 1u 0 0)\ni1 0 b trnoise(2m 1u 0 0)\nr1 b 0 1\n.tran 1u 3m\n");
    const auto t = run.curve("time"), a = run.curve("v(a)"), b = run.curve("v(b)");
    std::vector<double> voltage, current;
    for (std::size_t k = 0; k < t.size(); ++k)
        if (std::abs(t[k] * 1e6 - std::round(t[k] * 1e6)) < 1e-6) voltage.push_back(a[k] - 0.5), current.push_back(b[k]);
    ASSERT_GE(voltage.size(), 3000u);
    EXPECT_NEAR(variance_of(voltage) / 1e-6, 1, interval(voltage.size()));
    EXPECT_NEAR(variance_of(current) / 4e-6, 1, interval(current.size()));
    double product = 0;  // of sources with different names
    for (std::size_t k = 0; k < voltage.size(); ++k) product += voltage[k] * current[k];
    EXPECT_NEAR(product / 2e-6 / static_cast<double>(voltage.size()), 0, 4 / std::sqrt(static_cast<double>(voltage.size())));
}

TEST(TransientNoise, CostsOneStepForEachIntervalInACircuitSlowerThanIt) {
    const auto run = run_netlist("rc\nv1 in 0 1\nr1 in out 1meg\nc1 out 0 1p\n.options noisefmax=5meg\n.tran 1u 200u\n");
    double steps = 0;
    for (const auto& [name, value] : run.analyses()[0].result.stats)
        if (name == "steps") steps = value;
    EXPECT_GE(steps, 2000);
    EXPECT_LT(steps, 2100);
}

TEST(TransientNoise, OptionsThatCannotHoldAreErrors) {
    const auto error = [](const std::string& options) {
        auto netlist = parse_netlist_text("rc\nv1 in 0 1\nr1 in out 1meg\nc1 out 0 1p\n.options " + options + "\n.tran 1u 2u\n");
        const auto run = run_directives(std::make_shared<const Circuit>(*netlist->elaborate()));
        return run ? "" : run.error().text();
    };
    EXPECT_EQ(error("noisefmax=1meg"), "");
    EXPECT_NE(error("noisefmax=10 noisefmin=20").find("noisefmin=20: must be below noisefmax, 10 Hz"), std::string::npos);
    EXPECT_NE(error("noiseseed=2").find("no effect without noisefmax"), std::string::npos);
    EXPECT_NE(error("noisefmax=1meg noiseseed=2.5").find("expected an integer"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle::circuit
