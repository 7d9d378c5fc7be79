// Algorithms 3 and 4 of the thesis as printed, compared with the corrected ones, and the limits of equations 5 to 7. Numbers such as B4 are
// those of the errata.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/algorithms.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::errata_neurons {

constexpr double R = 1e6, C = 1e-6, T = 1e-3, leak = 500e-9;  // ohm, F, s, A: fig. 16 and 3.3

/// A constant current (A) sampled every T.
StudyCurve constant_current(double current, double seconds) {
    StudyCurve out;
    for (int n = 0; n < std::lround(seconds / T); ++n) out.x.push_back(n * T), out.y.push_back(current);
    return out;
}

/// Algorithm 3 without spikes: u (V) after this number of samples of a constant current (A), from u = 0 on (B4, B5).
double membrane_a(double k_a, double k_b, double k_c, double current, int samples) {
    double u = 0;
    for (int n = 0; n < samples; ++n) u = k_a * current + k_b * u + k_c;
    return u;
}

void algorithm_3(StudyResult& out) {
    // r is RC / T; k_a and k_b are the corrected factors
    const double r = R * C / T, k_a = R / (1 + r), k_b = r / (1 + r), u_rest = 0.1;
    out.claim("Alg. 3: k_b as printed", r * (1 + r))
        .allow_range(-1, 1, "u must settle")
        .explain("RC/T (1 + RC/T) is printed instead of (RC/T) / (1 + RC/T) (B4)");
    out.claim("Alg. 3: k_b as corrected", k_b).allow_range(-1, 1, "u must settle").of_kind(ClaimKind::identity);
    out.claim("Alg. 3: u after two samples of 2 uA, as printed", membrane_a(k_a, r * (1 + r), 0, 2e-6, 2), "V")
        .allow_max(2, "eq. 5: never above R I")
        .explain("u grows by the factor k_b in each sample (B4)");
    out.claim("Alg. 3: u after ten thousand samples, as corrected", membrane_a(k_a, k_b, 0, 2e-6, 10000), "V")
        .derived_as(2, "eq. 5: R I")
        .of_kind(ClaimKind::identity);
    out.claim("Alg. 3: u at rest for u_rest = 0.1 V, with k_c = u_rest as printed", membrane_a(k_a, k_b, u_rest, 0, 20000), "V")
        .derived_as(u_rest, "eq. 5")
        .explain("k_c is u_rest / (1 + RC/T); the printed one is correct for RC far below T, and makes no difference for u_rest = 0 (B5)");
    out.claim("Alg. 3: u at rest for u_rest = 0.1 V, with k_c = u_rest / (1 + RC/T) as corrected",
              membrane_a(k_a, k_b, u_rest / (1 + r), 0, 20000), "V")
        .derived_as(u_rest, "eq. 5")
        .of_kind(ClaimKind::identity);
}

/// Algorithm 4 as printed: the current is added to u_rest, not to u[n-1] (B6).
Result<void> algorithm_4(StudyResult& out) {
    const auto response =
        TRY(run_trial({.afferent = "sa1", .rate = 1 / T, .probes = {"I"}, .method = Method::backward_euler, .sampled = true}));
    const auto& I = response.probes.at("I");
    const double theta = 0.5, C_m = 500e-9;
    StudyCurve u = I;
    for (double& y : u.y) y = T / C_m * (y - leak);
    out.claim("Alg. 4: largest u under the press stimulus, as printed", u.max(), "V")
        .allow_min(theta, "thesis 3.3, fig. 17b: the neuron fires, so u reaches theta, which is our choice")
        .explain("as printed u[n] does not depend on u[n-1], so it contains the charge of one step only (B6)");
    const auto corrected = algorithms::lif_b(I, {});
    out.claim("Alg. 4: spikes, as corrected", static_cast<double>(corrected.spikes.size()), "spikes")
        .allow_range(static_cast<double>(response.spikes.size()), static_cast<double>(response.spikes.size()), "sa1 of the catalogue")
        .of_kind(ClaimKind::identity);
    out.plot("Membrane of SA-I under the press stimulus", "time (s)", "u (V)")
        .add("Alg. 4 as printed", u)
        .add("as corrected", corrected.u)
        .add("theta", {{0, 1}, {theta, theta}});
    return {};
}

/// u (V) by equations 6 and 7, without the algorithm's lower bound, after a time (s) of constant current (A) (B6a).
double integrate_equations(double current, double seconds, double u = 0) {
    for (int n = 0; n < std::lround(seconds / T); ++n) u += T / C * (current - (u > 0 ? leak : 0));
    return u;
}

/// Time (s) from u_rst to theta for LIF-B of (6) and (7): below u_rest there is no leak (B6b).
double interval(double current, double u_rst, double theta) {
    const double step = 1e-6;
    double u = u_rst, t = 0;
    for (; u < theta; t += step) u += step / C * (current - (u > 0 ? leak : 0));
    return t;
}

/// LIF-B under a current that within one sample raises the membrane by more than theta - u_rst (B6c).
Result<void> one_spike_per_sample(StudyResult& out) {
    const double current = 400e-6;
    const auto as_printed = algorithms::lif_b(constant_current(current, 0.1), {});
    const std::string afferent = "sa1a+lif-b";
    const auto catalogue_spikes = TRY(simulate_train(
        {afferent,
         "step",
         {fmt::format("step.F_max={}", current / 1e-6), "step.t_rest=0", "step.t_hold=100ms", "step.t_post=0", afferent + ".k_d=0"}}));
    const double expected = (current - leak) / 500e-9 / 0.25;  // C and theta - u_rst of both
    out.claim("Alg. 4: frequency at 400 uA, one spike per sample as printed", static_cast<double>(as_printed.spikes.size()) / 0.1, "Hz")
        .derived_as(expected, "thesis 3.2: (I - I_leak0) / [C (theta - u_rst)]")
        .explain("if u rises by more than theta - u_rst in a sample, the excess over theta remains and grows (B6c)");
    out.claim("LIF-B of the catalogue: frequency at 400 uA, with several spikes per sample",
              static_cast<double>(catalogue_spikes.size()) / 0.1, "Hz")
        .derived_as(expected, "thesis 3.2: (I - I_leak0) / [C (theta - u_rst)]")
        .of_kind(ClaimKind::identity);
    return {};
}

/// At 2 uA and 1 ms fig. 16's LIF-B reaches theta exactly, so rounding decides (B7).
void check_rounding(StudyResult& out) {
    // largest shift (s) of a spike between a threshold 1 nV below and 1 nV above 1 V
    const auto spike_shift = [](double current) {
        const auto with = [&](double theta) { return algorithms::lif_b(constant_current(current, 2), {C, leak, theta, 0.5}).spikes; };
        const auto lower = with(1 - 1e-9), higher = with(1 + 1e-9);
        double largest = 0;
        for (std::size_t k = 0; k < std::min(lower.size(), higher.size()); ++k) largest = std::max(largest, std::abs(lower[k] - higher[k]));
        return largest;
    };
    out.claim("fig. 16's LIF-B at 2 uA, T = 1 ms: largest shift of a spike for a 2 nV change of theta", spike_shift(2e-6), "s")
        .allow_min(T / 2, "B7: u reaches theta exactly, so rounding moves a spike by a sample")
        .of_kind(ClaimKind::ours);
    out.claim("fig. 16's LIF-B at 2.03 uA, T = 1 ms: largest shift of a spike for a 2 nV change of theta", spike_shift(2.03e-6), "s")
        .allow_range(0, 0, "B7: at this current u never equals theta exactly")
        .of_kind(ClaimKind::ours);
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    algorithm_3(out);
    TRY(algorithm_4(out));
    out.claim("(6) and (7) only: u after a second of -0.5 uA", integrate_equations(-0.5e-6, 1), "V")
        .allow_range(0, 0, "Alg. 4: not below u_rest")
        .explain("the equations have no lower bound; the algorithm's bound is meant (B6a)");
    TRY(options.report_progress(0.5));
    const double current = 2e-6, below = -0.25;  // A; V, u_rst relative to u_rest
    out.claim("(6) and (7): frequency with u_rst 0.25 V below u_rest", 1 / interval(current, below, 1), "Hz")
        .derived_as((current - leak) / C / (1 - below), "thesis 3.2: \"equal\" to [I - I_leak0] / [C (theta - u_rst)]")
        .of_kind(ClaimKind::identity);
    out.claim("(6) and (7): frequency with u_rst 0.25 V above u_rest", 1 / interval(current, -below, 1), "Hz")
        .derived_as((current - leak) / C / (1 + below), "thesis 3.2: [I - I_leak0] / [C (theta - u_rst)]")
        .of_kind(ClaimKind::identity);
    if (auto& c = out.claims[out.claims.size() - 2]; true)  // the claim with u_rst below u_rest
        c.explain("below u_rest there is no leak, so the interval has two parts; the formula is exact for u_rst at or above u_rest (B6b)");
    TRY(one_spike_per_sample(out));
    check_rounding(out);
    out.note("The study fig16 covers B5a and B5b (rheobase and frequency of LIF-A). The catalogue's LIF-B rejects u_rst below u_rest.");
    return out;
}

const Study study{"errata-neurons", "Algorithms 3 and 4 as printed",
                  "How do the thesis's two neurons behave as printed, and what do (5) to (7) leave out? Thesis 3.2", ClaimKind::misprint,
                  compute};

}  // namespace corpuscle::studies::errata_neurons
