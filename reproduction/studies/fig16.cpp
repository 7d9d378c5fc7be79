// Thesis fig. 16: LIF-A beside LIF-B under a step of current.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig16 {

constexpr double C = 1e-6, R = 1e6, leak = 500e-9, theta = 1,
                 reset = 0.5;          // F, ohm, A, V, V: thesis 3.2; `reset` is u_rst, u_rest is 0 by default
constexpr double on = 0.5, off = 4;    // s: start and end of the step; these times and the 2.03 uA below are not published (errata B7)
constexpr double amplitude = 2.03e-6;  // A

/// The response to a step of current (A) of duration `hold` (s). The receptor SA-IA without its dynamic component turns a step of force
/// into a step of current, 1 uA/N.
Result<TrialResult> simulate_step(const std::string& neuron, double current, double hold = off - on, double rate = 2e3, double u_rest = 0) {
    const std::string afferent = "sa1a+" + neuron;
    return run_trial({.afferent = afferent,
                      .stimulus = "step",
                      .settings = {afferent + ".k_d=0", fmt::format("{}.C_m={}", afferent, C), fmt::format("{}.V_th={}", afferent, theta),
                                   fmt::format("{}.V_reset={}", afferent, reset), fmt::format("{}.E_L={}", afferent, u_rest),
                                   neuron == "lif-a" ? fmt::format("{}.R_m={}", afferent, R) : fmt::format("{}.I_leak0={}", afferent, leak),
                                   fmt::format("step.F_max={}", current / 1e-6), fmt::format("step.t_rest={}", on),
                                   fmt::format("step.t_hold={}", hold), "step.t_post=2"},
                      .rate = rate,
                      .probes = {"u"}});
}

/// The smallest current (A) that makes the neuron fire within 100 s, by bisection.
Result<double> rheobase(const std::string& neuron, double u_rest = 0) {
    double low = 0, high = amplitude;
    for (int k = 0; k < 14; ++k) {
        const double middle = (low + high) / 2;
        const auto response = simulate_step(neuron, middle, 100, 100, u_rest);
        if (!response) return response.error();
        (response->spikes.empty() ? low : high) = middle;
    }
    return high;
}

/// The membrane voltage after the step, to the end of the simulation. It begins 1 ms after the step, when no more spikes occur.
StudyCurve after_step(const StudyCurve& u) { return u.between(off + 1e-3, 6); }

/// The first time (s) at which the membrane voltage is 0, u_rest.
double time_of_rest(const StudyCurve& u) {
    for (std::size_t k = 0; k < u.x.size(); ++k)
        if (u.y[k] <= 0) return u.x[k];
    return Claim::none;
}

Result<void> report_rheobases(StudyResult& out, const StudyOptions& options) {
    const double u_rest = 0.2;
    const auto A = rheobase("lif-a"), B = rheobase("lif-b"), raised_rest = rheobase("lif-a", u_rest);
    if (!A) return A.error();
    if (!B) return B.error();
    if (!raised_rest) return raised_rest.error();
    out.claim("LIF-A: smallest current that makes it fire", *A, "A").derived_as(theta / R, "thesis 3.2: theta / R");
    out.claim("LIF-B: smallest current that makes it fire", *B, "A").derived_as(leak, "thesis 3.2: I_leak0");
    out.claim(fmt::format("LIF-A with u_rest = {} V: smallest current that makes it fire", u_rest), *raised_rest, "A")
        .derived_as(theta / R, "thesis 3.2: theta / R")
        .explain("it is (theta - u_rest) / R (errata B5a), which equals theta / R only for u_rest = 0");
    out.claim(fmt::format("LIF-A with u_rest = {} V: smallest current that makes it fire, against the corrected formula", u_rest),
              *raised_rest, "A")
        .derived_as((theta - u_rest) / R, "errata B5a: (theta - u_rest) / R");
    return options.report_progress(0.8);
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto A = simulate_step("lif-a", amplitude), B = simulate_step("lif-b", amplitude);
    if (!A) return A.error();
    if (!B) return B.error();
    if (auto ok = options.report_progress(0.3); !ok) return ok.error();
    const double f_A = measure<LastRate>(A->spikes, {on, off}), f_B = measure<LastRate>(B->spikes, {on, off});
    const double approximate_rate = amplitude / C / (theta - reset);
    out.claim("LIF-A: frequency", f_A, "Hz")
        .derived_as(approximate_rate, "thesis 3.2: I / [C (theta - u_rst)] for I much above I_R")
        .explain("the approximation holds for currents far above the leak; this current is about twice the leak (errata B5b)");
    out.claim("LIF-A: frequency, against the solution of (5)", f_A, "Hz")
        .derived_as(1 / (R * C * std::log((R * amplitude - reset) / (R * amplitude - theta))),
                    "errata B5b: 1 / {RC ln[(R I - u_rst) / (R I - theta)]}");
    out.claim("LIF-B: frequency", f_B, "Hz")
        .derived_as((amplitude - leak) / C / (theta - reset), "thesis 3.2: (I - I_leak0) / [C (theta - u_rst)]");
    const auto strong_response = simulate_step("lif-a", 100 * amplitude);
    if (!strong_response) return strong_response.error();
    out.claim("LIF-A: frequency at a hundred times the current", measure<LastRate>(strong_response->spikes, {on, off}), "Hz")
        .derived_as(100 * approximate_rate, "thesis 3.2: I / [C (theta - u_rst)] for I much above I_R");
    if (auto ok = report_rheobases(out, options); !ok) return ok.error();

    const auto &u_A = A->probes.at("u"), &u_B = B->probes.at("u");
    const auto fall_A = after_step(u_A), fall_B = after_step(u_B);
    const double from = fall_A.x.front();
    out.claim("u_A: fraction that remains after RC", fall_A.at(from + R * C) / fall_A.at(from))
        .derived_as(std::exp(-1), "thesis 3.2: exponentially");
    out.claim("u_A: value at 6 s as a fraction of its value RC earlier", fall_A.at(6 - 1e-3) / fall_A.at(6 - 1e-3 - R * C))
        .derived_as(std::exp(-1), "thesis 3.2: exponentially");
    const double rest_from = time_of_rest(fall_B);
    const auto line = fall_B.between(from, rest_from - 1e-3).fit_line();
    out.claim("u_B: slope of its fall", line.slope, "V/s").derived_as(-leak / C, "thesis 3.2: linearly, by (6) and (7)");
    out.claim("u_B: largest difference from a straight line while it falls", line.max_deviation, "V")
        .allow_max(1e-3, "thesis 3.2: linearly; within 1 mV here");
    out.claim_true("u_B: stays at u_rest after its fall", fall_B.between(rest_from, 6).max() == 0, "thesis 3.2: until it reaches u_rest");
    out.claim("spikes of LIF-A over those of LIF-B", static_cast<double>(A->spikes.size()) / static_cast<double>(B->spikes.size()))
        .allow_range(0.8, 1.25, "thesis 3.2: similar pulse patterns; the range is our choice");
    out.plot("Membrane", "time (s)", "u (V)")
        .add("u_A", u_A)
        .add("u_B", u_B)
        .describe_published("u_A falls exponentially once the input is zero, u_B linearly until it reaches u_rest");
    out.plot("Spikes", "time (s)", "").raster_row("LIF-A", A->spikes).raster_row("LIF-B", B->spikes).describe_published("similar patterns");
    out.note(
        "The amplitude and times of the step are not published. 2.03 uA from 0.5 to 4 s are our choice: no sampled membrane then meets its "
        "threshold exactly (errata B7). Traces are sampled every 0.5 ms.");
    return out;
}

const Study study{"fig16", "The two leaky integrate-and-fire models",
                  "Under the same step of current LIF-A and LIF-B fire in the same way; afterwards u_A falls exponentially, u_B linearly. "
                  "The thesis gives formulas for rates and rheobases. Thesis 3.2, fig. 16",
                  compute};

}  // namespace corpuscle::studies::fig16
