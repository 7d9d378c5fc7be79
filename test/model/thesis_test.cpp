// Compares the thesis's afferents with closed forms, with stored reference values ("golden") and with the firing pattern that the thesis
// describes.

#include <cmath>
#include <nlohmann/json.hpp>

#include "measure/measures.hpp"
#include "support/closed_form_press.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::RunSettings, test::train;

struct ThesisCase {
    std::string afferent;  // "sa1" or "fa1"
    double V_th, V_reset;  // V
    std::vector<std::string> settings() const {
        return {afferent + ".V_th=" + std::to_string(V_th), afferent + ".V_reset=" + std::to_string(V_reset)};
    }
    /// The spike times (s) under the press by the closed form.
    std::vector<double> exact() const {
        return test::lif_b_train(afferent == "sa1" ? test::sa1_current : test::fa1_current, afferent == "sa1" ? 5e-7 : 1e-6, V_th, V_reset);
    }
};

const ThesisCase cases[] = {{"sa1", 0.5, 0.25}, {"fa1", 0.5, 0.25}, {"sa1", 1, 0.5}, {"fa1", 1, 0.5}, {"sa1", 0.2, 0}, {"fa1", 0.2, 0}};

/// The largest difference (s) between the times of spikes with the same index; infinite if the trains have different numbers of spikes.
double max_difference(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return INFINITY;
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
}

TEST(Thesis, ExactIsWithinAMicrosecondOfTheClosedFormAt10kHz) {
    for (const auto& c : cases)
        EXPECT_LT(max_difference(train(c.afferent, "press", {.settings = c.settings(), .rate = 10e3}), c.exact()), 1e-6)
            << c.afferent << ' ' << c.V_th;
}

TEST(Thesis, ExactIsWithinATenthOfAMillisecondAt1kHz) {
    for (const auto& c : cases)
        EXPECT_LT(max_difference(train(c.afferent, "press", {.settings = c.settings(), .rate = 1e3}), c.exact()), 1e-4)
            << c.afferent << ' ' << c.V_th;
}

TEST(Thesis, ExactMatchesThePublishedClosedFormTimes) {
    const auto near = [](const std::vector<double>& seconds, const std::vector<double>& ms) {
        ASSERT_EQ(seconds.size(), ms.size());
        for (std::size_t k = 0; k < ms.size(); ++k) EXPECT_NEAR(seconds[k] * 1e3, ms[k], 1e-3);
    };
    near(train("sa1", "press", {.settings = cases[2].settings()}), {346.8884, 374.8316, 413.0233, 460.9993, 517.9470, 581.7380, 651.2533});
    near(train("fa1", "press", {.settings = cases[3].settings()}), {387.7107, 700.5009, 757.6866});
}

/// The order of convergence: the slope of log(error) over log(T), where T is the sampling period.
double slope(const ThesisCase& c, Method method) {
    const auto expected = c.exact();
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    int n = 0;
    for (double rate = 1e3; rate <= 32e3; rate *= 2, ++n) {  // five halvings of T
        const double x = std::log(1 / rate),
                     y = std::log(
                         max_difference(train(c.afferent, "press", {.settings = c.settings(), .rate = rate, .method = method}), expected));
        sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
    }
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

TEST(Thesis, ExactConvergesWithTheSquareOfTheStep) {
    for (const auto& c : cases) EXPECT_GT(slope(c, Method::exact), 1.8) << c.afferent << ' ' << c.V_th;
}

TEST(Thesis, BackwardEulerConvergesWithTheStep) {
    for (const auto& c : cases) EXPECT_NEAR(slope(c, Method::backward_euler), 1.0, 0.2) << c.afferent << ' ' << c.V_th;
}

/// Algorithms 4 to 6 as printed in the thesis, with the corrections of the errata. T: sampling period, s. Returns the spike times, s.
std::vector<double> algorithm(const ThesisCase& c, double T) {
    const auto F = test::force("press", {.rate = 1 / T});
    const bool sa1 = c.afferent == "sa1";
    const auto k2 = [T](double f) { return 1 / (1 + 2 * M_PI * f * T); };
    const double k = T / 500e-9, leak = sa1 ? 5e-7 : 1e-6;
    double before = F[0], I_B = 0, I_C = 0, I_0 = 0, u = 0;
    std::vector<double> out;
    for (std::size_t n = 0; n < F.size(); ++n) {
        const double dF = F[n] - before;
        before = F[n];
        I_B = 8e-6 * k2(20) * dF + k2(20) * I_B, I_C = 2e-6 * k2(2) * dF + k2(2) * I_C, I_0 = k2(2) * (dF + I_0);
        const double I = sa1 ? 1e-6 * F[n] + std::max(I_B, 0.0) + std::max(I_C, 0.0) : I_0 > 0 ? 3.5e-6 * I_0 : -2.75e-6 * I_0;
        u += k * (I - leak);
        if (u > c.V_th) {
            u = u - c.V_th + c.V_reset;
            out.push_back(static_cast<double>(n) * T);
        } else {
            u = std::max(u, 0.0);
        }
    }
    return out;
}

TEST(Thesis, SampledBackwardEulerFiresOnTheSamplesOfThePrintedAlgorithm) {
    for (const auto& c : cases)
        for (const double T : {1e-3, 5e-4, 1e-4})
            EXPECT_LT(max_difference(train(c.afferent, "press",
                                           {.settings = c.settings(), .rate = 1 / T, .method = Method::backward_euler, .sampled = true}),
                                     algorithm(c, T)),
                      1e-12)
                << c.afferent << ' ' << c.V_th << ' ' << T;
}

TEST(Thesis, SpikesAndMeasuresMatchTheGoldenCases) {
    const auto path = test::shared_file_path("../golden/behaviour.json");
    CORPUSCLE_NEEDS(path);
    const auto golden = nlohmann::json::parse(test::read_file(path));
    for (const auto& g : golden["cases"]) {
        const ThesisCase c{g["model"] == "SA-I" ? "sa1" : "fa1", g["lif"]["theta"], g["lif"]["u_rst"]};
        const auto expected = g["spike_times"].get<std::vector<double>>();
        if (g["variant"] == "exact") {
            EXPECT_LT(max_difference(train(c.afferent, "press", {.settings = c.settings(), .rate = 10e3}), expected), 1e-6)
                << g["model"] << g["neuron_set"];
            EXPECT_LT(max_difference(train(c.afferent, "press", {.settings = c.settings(), .rate = 1e3}), expected), 1e-4)
                << g["model"] << g["neuron_set"];
        } else {
            EXPECT_LT(
                max_difference(
                    train(c.afferent, "press",
                          {.settings = c.settings(), .rate = 1 / g["T"].get<double>(), .method = Method::backward_euler, .sampled = true}),
                    expected),
                1e-12)
                << g["model"] << g["neuron_set"];
        }
        for (const auto& [name, statistics] : g["stats"]["phases"].items()) {
            const auto& ends = golden["conventions"]["phases_s"][name];
            const TimeWindow s{ends[0], ends[1]};
            EXPECT_EQ(measure<SpikeCount>(expected, s), statistics["count"].get<double>());
            const auto same = [](double computed, const nlohmann::json& value) {
                if (value.is_null()) {
                    EXPECT_TRUE(std::isnan(computed));
                } else {
                    EXPECT_NEAR(computed, value.get<double>(), 1e-9);
                }
            };
            same(measure<MeanRate>(expected, s), statistics["mean_rate_Hz"]),
                same(measure<PeakRate>(expected, s), statistics["peak_inst_Hz"]);
            same(measure<FirstRate>(expected, s), statistics["first_inst_Hz"]),
                same(measure<LastRate>(expected, s), statistics["last_inst_inside_Hz"]);
        }
    }
}

TEST(Thesis, Figure16sNeuronsMeetTheGoldenValues) {
    const auto path = test::shared_file_path("../golden/behaviour.json");
    CORPUSCLE_NEEDS(path);
    const auto golden = nlohmann::json::parse(test::read_file(path))["fig16"];
    const auto run = [](const std::string& neuron, double amplitude, Method method, bool sampled, double T) {
        // The receptor sa1a (SA-IA in the thesis) converts a step of force to a step of current: k_s = 1 uA/N, and k_d = 0 removes its
        // dynamic part.
        const std::string name = "sa1a+" + neuron;
        const auto a = test::afferent(name, {.settings = {name + ".k_d=0", name + ".C_m=1uF", name + ".V_th=1V", name + ".V_reset=0.5V"},
                                             .rate = 1 / T,
                                             .method = method,
                                             .sampled = sampled});
        return spike_times(test::spikes(*a, test::force("step", {.settings = {"step.F_max=" + std::to_string(amplitude) + "N",
                                                                              "step.t_rest=0.5s", "step.t_hold=3.5s", "step.t_post=2s"},
                                                                 .rate = 1 / T})),
                           test::value_or_throw(make_clock(1 / T)));
    };
    for (const auto& g : golden["cases"]) {
        const double amplitude = g["I_amp"].get<double>() * 1e6;
        for (const auto& [neuron, key] : {std::pair{"lif-a", "spike_times_A"}, {"lif-b", "spike_times_B"}}) {
            // The edge of the step lies between two samples. First-order hold makes it a ramp over this interval, whose middle is at most
            // half a sampling period before the edge.
            EXPECT_LT(max_difference(run(neuron, amplitude, Method::exact, false, 1e-4), g["exact"][key].get<std::vector<double>>()), 6e-5)
                << neuron;
            // In these cases a rounding error decides whether a spike is fired.
            if (g["rounding_ties_in_sampled_LIF_B"].get<bool>() && std::string(neuron) == "lif-b") continue;
            for (const auto& s : g["sampled"])
                EXPECT_LT(max_difference(run(neuron, amplitude, Method::backward_euler, true, s["T"]), s[key].get<std::vector<double>>()),
                          1e-9)
                    << neuron << ' ' << s["T"];
        }
    }
}

TEST(Thesis, ThePressGivesTheFiringPatternThatTheThesisDescribes) {
    const auto sa1 = train("sa1"), fa1 = train("fa1");
    const TimeWindow plateau{0.375, 0.625};
    EXPECT_NEAR(measure<PeakRate>(sa1, {0, 1}), 76.0, 0.5);
    EXPECT_NEAR(measure<FirstRate>(sa1, plateau), 49, 0.5);
    EXPECT_NEAR(measure<LastRate>(sa1, plateau), 30, 0.5);
    EXPECT_EQ(measure<SpikeCount>(sa1, {0.625, 0.75}), 1);
    EXPECT_EQ(measure<SpikeCount>(sa1, {0.75, 1}), 0);
    for (std::size_t k = 1; k + 1 < sa1.size(); ++k)
        if (sa1[k - 1] >= plateau.from && sa1[k + 1] < plateau.to) {
            EXPECT_LT(sa1[k] - sa1[k - 1], sa1[k + 1] - sa1[k]) << "the plateau slows down steadily";
        }
    EXPECT_NEAR(measure<PeakRate>(fa1, {0.25, 0.5}), 50.5, 0.05);
    EXPECT_NEAR(measure<PeakRate>(fa1, {0.625, 1}), 35.7, 0.05);
    EXPECT_EQ(measure<SpikeCount>(fa1, {0.43, 0.69}), 0);
}

}  // namespace
}  // namespace corpuscle
