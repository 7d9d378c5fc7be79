// Algorithms 3 and 4 of the thesis run as printed, beside ours, and where equations 5 to 7 need a word more.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/algorithms.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::errata_neurons {

constexpr double R = 1e6, C = 1e-6, T = 1e-3, leak = 500e-9;  // ohm, F, s, A: fig. 16 and 3.3

Line steady(double current, double seconds) {
    Line out;
    for (int n = 0; n < std::lround(seconds / T); ++n) out.x.push_back(n * T), out.y.push_back(current);
    return out;
}

/// Algorithm 3 without its spikes: where u is after so many samples of 2 uA (B4, B5).
double membrane_a(double k_a, double k_b, double k_c, double current, int samples) {
    double u = 0;
    for (int n = 0; n < samples; ++n) u = k_a * current + k_b * u + k_c;
    return u;
}

void algorithm_3(Outcome& out) {
    const double r = R * C / T, k_a = R / (1 + r), right_b = r / (1 + r), u_rest = 0.1;
    out.claim("Alg. 3: k_b as printed", r * (1 + r))
        .between(-1, 1, "u must come to rest")
        .because("RC/T (1 + RC/T) is printed for (RC/T) / (1 + RC/T) (B4)");
    out.claim("Alg. 3: k_b as mended", right_b).between(-1, 1, "u must come to rest");
    out.claim("Alg. 3: u after two samples of 2 uA, as printed", membrane_a(k_a, r * (1 + r), 0, 2e-6, 2), "V")
        .at_most(2, "eq. 5: never above R I")
        .because("it grows by k_b each sample (B4)");
    out.claim("Alg. 3: u after ten thousand, as mended", membrane_a(k_a, right_b, 0, 2e-6, 10000), "V").held_to(2, "eq. 5: R I");
    out.claim("Alg. 3: u at rest for u_rest = 0.1 V, with k_c = u_rest as printed", membrane_a(k_a, right_b, u_rest, 0, 20000), "V")
        .held_to(u_rest, "eq. 5")
        .because("k_c is u_rest / (1 + RC/T); the printed one is right for RC far below T, and cannot be seen at u_rest = 0 (B5)");
    out.claim("Alg. 3: the same, k_c as mended", membrane_a(k_a, right_b, u_rest / (1 + r), 0, 20000), "V").held_to(u_rest, "eq. 5");
}

/// Algorithm 4 as printed: u_rest, not u[n-1], is what the current is added to (B6).
Result<void> algorithm_4(Outcome& out) {
    const auto told = told_of({.afferent = "sa1", .rate = 1 / T, .traces = {"I"}, .method = Method::backward_euler, .sampled = true});
    if (!told) return told.error();
    const auto& I = told->traces.at("I");
    const double theta = 0.5, C_m = 500e-9;
    Line u = I;
    for (double& y : u.y) y = T / C_m * (y - leak);
    out.claim("Alg. 4: largest u under the press, as printed", u.most(), "V")
        .at_least(theta, "thesis 3.3, fig. 17b: it fires; theta as chosen")
        .because("nothing of u[n-1] is in u[n]: a step's charge is all there is (B6)");
    const auto mended = algorithms::lif_b(I, {});
    out.claim("Alg. 4: spikes, as mended", static_cast<double>(mended.spikes.size()), "spikes")
        .between(static_cast<double>(told->spikes.size()), static_cast<double>(told->spikes.size()), "sa1 of the catalogue");
    out.plot("Membrane of SA-I under the press", "time (s)", "u (V)")
        .add("Alg. 4 as printed", u)
        .add("as mended", mended.u)
        .add("theta", {{0, 1}, {theta, theta}});
    return {};
}

/// Equations 6 and 7 by themselves, without the algorithm's lower bound, under a current (B6a).
double by_the_equations(double current, double seconds, double u = 0) {
    for (int n = 0; n < std::lround(seconds / T); ++n) u += T / C * (current - (u > 0 ? leak : 0));
    return u;
}

/// How long LIF-B of (6) and (7) takes from u_rst to theta: below u_rest nothing leaks (B6b).
double interval(double current, double u_rst, double theta) {
    const double step = 1e-6;
    double u = u_rst, t = 0;
    for (; u < theta; t += step) u += step / C * (current - (u > 0 ? leak : 0));
    return t;
}

/// More charge in a sample than from u_rst to theta (B6c).
Result<void> one_a_sample(Outcome& out) {
    const double current = 400e-6;
    const auto printed = algorithms::lif_b(steady(current, 0.1), {});
    const std::string who = "sa1a+lif-b";
    const auto ours =
        train_of({who,
                  "step",
                  {fmt::format("step.F_max={}", current / 1e-6), "step.t_rest=0", "step.t_hold=100ms", "step.t_post=0", who + ".k_d=0"}});
    if (!ours) return ours.error();
    const double right = (current - leak) / 500e-9 / 0.25;
    out.claim("Alg. 4: frequency at 400 uA, one spike a sample as printed", static_cast<double>(printed.spikes.size()) / 0.1, "Hz")
        .held_to(right, "thesis 3.2: (I - I_leak0) / [C (theta - u_rst)]")
        .because("where a sample brings more than theta - u_rst, what is left over stays above theta and grows (B6c)");
    out.claim("LIF-B at 400 uA, spikes within a sample as here", static_cast<double>(ours->size()) / 0.1, "Hz")
        .held_to(right, "thesis 3.2, the same");
    return {};
}

/// At 2 uA and 1 ms fig. 16's LIF-B meets theta exactly: one rounding decides (B7).
void tie(Outcome& out) {
    const auto shift = [](double current) {
        const auto with = [&](double theta) { return algorithms::lif_b(steady(current, 2), {C, leak, theta, 0.5}).spikes; };
        const auto lower = with(1 - 1e-9), higher = with(1 + 1e-9);
        double most = 0;
        for (std::size_t k = 0; k < std::min(lower.size(), higher.size()); ++k) most = std::max(most, std::abs(lower[k] - higher[k]));
        return most;
    };
    out.claim("fig. 16's LIF-B at 2 uA, T = 1 ms: what 2 nV of theta move a spike", shift(2e-6), "s")
        .at_least(T / 2, "B7: u meets theta exactly, so one rounding moves it by a sample");
    out.claim("the same at 2.03 uA", shift(2.03e-6), "s").between(0, 0, "B7: no tie there");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    algorithm_3(out);
    if (auto ok = algorithm_4(out); !ok) return ok.error();
    out.claim("(6) and (7) alone: u after a second of -0.5 uA", by_the_equations(-0.5e-6, 1), "V")
        .between(0, 0, "Alg. 4: not below u_rest")
        .because("the equations have no lower bound; the algorithm's is meant (B6a)");
    if (auto ok = options.at(0.5); !ok) return ok.error();
    const double current = 2e-6, below = -0.25;
    out.claim("(6) and (7): frequency with u_rst 0.25 V below u_rest", 1 / interval(current, below, 1), "Hz")
        .held_to((current - leak) / C / (1 - below), "thesis 3.2: \"equal\" to [I - I_leak0] / [C (theta - u_rst)]");
    out.claim("(6) and (7): the same with u_rst 0.25 V above it", 1 / interval(current, -below, 1), "Hz")
        .held_to((current - leak) / C / (1 + below), "thesis 3.2, the same");
    if (auto& c = out.claims[out.claims.size() - 2]; true)
        c.because("below u_rest nothing leaks, so the interval has two parts; the formula is exact for u_rst at or above u_rest (B6b)");
    if (auto ok = one_a_sample(out); !ok) return ok.error();
    tie(out);
    out.note("B5a and B5b (rheobase and frequency of LIF-A) are shown in fig16. The catalogue's LIF-B refuses u_rst below u_rest.");
    return out;
}

const Study study{"errata-neurons", "Algorithms 3 and 4 as printed",
                  "What do the thesis's two neurons do if one runs what is printed, and where do (5) to (7) need a word more? Thesis 3.2",
                  work};

}  // namespace corpuscle::studies::errata_neurons
