// Algorithms 1, 2, 5 and 6 of the thesis as printed, compared with the corrected ones: the effect of each misprint on current and spikes.
// Numbers such as B2 are those of the errata. Errata of the neurons (Algorithms 3 and 4) are in errata_neurons.cpp.
// Symbols. F[n] is the force at sample n, F' its derivative. I' is a term of Algorithm 5 whose definition is misprinted.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/algorithms.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::errata_models {

using algorithms::k2, algorithms::lif_b, algorithms::MembraneParams;

constexpr double T = 1e-3;                                        // s: thesis 3.3
constexpr MembraneParams fig16_membrane{500e-9, 500e-9, 1, 0.5};  // SA-I with fig. 16's theta and u_rst
constexpr MembraneParams fa1_membrane{500e-9, 1e-6, 0.5, 0.25};   // FA-I of the catalogue

/// The curve of next(F[n], F[n-1]) for each sample of the force; F[-1] is F[0].
template <class Next>
StudyCurve apply(const StudyCurve& force, Next&& next) {
    StudyCurve out = force;
    double before = force.y[0];
    for (std::size_t n = 0; n < force.y.size(); ++n) out.y[n] = next(force.y[n], std::exchange(before, force.y[n]));
    return out;
}

double sum(const StudyCurve& line) {
    double out = 0;
    for (const double y : line.y) out += y;
    return out;
}

/// Algorithm 1: k_d multiplies a difference, so the dynamic component depends on the time step (B2).
Result<void> algorithm_1(StudyResult& out) {
    const double k_d = 100e-9;
    double as_printed[2], corrected[2];
    for (int k = 0; k < 2; ++k) {
        const double step = k == 0 ? 1e-3 : 1e-4;
        const auto force = TRY(press::force_curve(step));
        as_printed[k] = apply(force, [&](double F, double before) { return k_d / 1e-3 * std::abs(F - before); }).max();
        corrected[k] = apply(force, [&](double F, double before) { return k_d / step * std::abs(F - before); }).max();
    }
    out.claim("Alg. 1: dynamic component at T = 1 ms over that at 0.1 ms, as printed", as_printed[0] / as_printed[1])
        .derived_as(1, "thesis 3.1: eq. 1 does not depend on T")
        .explain("the algorithm uses F[n] - F[n-1] for F'; it must be divided by the step, which the text calls h and eq. 1 lacks (B2)");
    out.claim("Alg. 1: dynamic component at T = 1 ms over that at 0.1 ms, with k_d / T", corrected[0] / corrected[1])
        .derived_as(1, "thesis 3.1: eq. 1 does not depend on T")
        .of_kind(ClaimKind::identity);
    return {};
}

/// Algorithm 2: it tests F[n] + F[n-1], which is never negative (B3).
Result<void> algorithm_2(StudyResult& out, const StudyCurve& force) {
    const auto minus = apply(force, [](double F, double before) { return F + before > 0 ? 0 : before - F; });
    const auto plus = apply(force, [](double F, double before) { return F + before > 0 ? F - before : 0; });
    const auto corrected = apply(force, [](double F, double before) { return F - before > 0 ? 0 : before - F; });
    out.claim("Alg. 2: sum of I- under the press stimulus, as printed", sum(minus), "N")
        .derived_as(press::max_force - press::min_force, "thesis 3.1, eq. 3: max(-F', 0); the total fall of the force")
        .explain("the test is on F[n] + F[n-1], which is never negative for a force; F[n] - F[n-1] is meant (B3)");
    out.claim("Alg. 2: smallest I+, as printed", plus.min(), "N")
        .allow_min(0, "thesis 3.1, eq. 2: max(F', 0)")
        .explain("the test on F[n] + F[n-1] lets a falling force enter I+ with its negative sign (B3)");
    out.claim("Alg. 2: sum of I-, as corrected", sum(corrected), "N")
        .derived_as(press::max_force - press::min_force, "thesis 3.1, eq. 3: the total fall of the force")
        .of_kind(ClaimKind::identity);
    return {};
}

/// Algorithm 5's filter, I[n] = K k_2 (F[n] - F[n-1]) plus a last term in I'. As printed the last term is subtracted, and has two
/// interpretations: k_2 (I[n-1] - I[n-2]) or k_2 I[n-1]. As corrected k_2 I[n-1] is added (B8). f is the corner frequency (Hz).
enum class FilterForm { difference, value, corrected };
StudyCurve apply_filter(const StudyCurve& force, double K, double f, FilterForm form) {
    double last = 0, last_but_one = 0;
    return apply(force, [&](double F, double before) {
        const double k = k2(f, T), drive = K * k * (F - before);
        const double I = form == FilterForm::difference ? drive - k * (last - last_but_one)
                         : form == FilterForm::value    ? drive - k * last
                                                        : drive + k * last;
        last_but_one = std::exchange(last, I);
        return I;
    });
}
/// SA-I's current I_A + max(I_B, 0) + max(I_C, 0), with k_A of 1 uA/N, and corner frequencies of 20 and 2 Hz.
StudyCurve sa1_current(const StudyCurve& force, FilterForm form, double K_B = 8e-6, double K_C = 2e-6) {
    StudyCurve out = force;
    const auto B = apply_filter(force, K_B, 20, form), C = apply_filter(force, K_C, 2, form);
    for (std::size_t n = 0; n < force.y.size(); ++n) out.y[n] = 1e-6 * force.y[n] + std::max(B.y[n], 0.0) + std::max(C.y[n], 0.0);
    return out;
}

Result<void> algorithm_5(StudyResult& out, const StudyCurve& force, StudyPlot& raster) {
    for (const auto& [f, filter_name] : {std::pair{20.0, "filter B"}, {2.0, "filter C"}}) {
        const double k = k2(f, T), root = std::sqrt(k * k + 4 * k);
        out.claim(fmt::format("Alg. 5, {}: pole of larger magnitude if I' is a difference, as printed", filter_name), -(k + root) / 2)
            .allow_range(-1, 1, "a filter must be stable")
            .explain("z^2 + k z - k = 0 (B8); the sign of the last term and its factor are misprinted");
    }
    const auto corrected = lif_b(sa1_current(force, FilterForm::corrected), fig16_membrane).spikes,
               value = lif_b(sa1_current(force, FilterForm::value), fig16_membrane).spikes;
    StudyCurve static_part = force;
    for (double& y : static_part.y) y *= 1e-6;
    const auto static_spikes = lif_b(static_part, fig16_membrane).spikes;
    const auto catalogue_spikes = TRY(simulate_train(press::thesis_algorithm("sa1", {"sa1.V_th=1", "sa1.V_reset=0.5"})));
    const auto largest_I_B =
        apply_filter(force, 8e-6, 20, FilterForm::difference).between(0, press::protraction.from + 50e-3).absolute().max();
    out.claim("Alg. 5: largest I_B in the first 50 ms of the ramp if I' is a difference, as printed", largest_I_B, "A")
        .allow_max(8e-6 * (press::max_force - press::min_force), "eq. 12: a high-pass of gain K_B cannot give more than K_B times the step")
        .explain("the filter is unstable (B8)");
    out.claim("Alg. 5: spikes if I' is I[n-1], as printed", static_cast<double>(value.size()), "spikes")
        .allow_range(static_cast<double>(catalogue_spikes.size()), static_cast<double>(catalogue_spikes.size()),
                     "sa1 of the catalogue with fig. 16's theta")
        .explain("with its pole at -k_2 the filter passes only frequencies near half the sample rate, so almost no current remains (B8)");
    out.claim("Alg. 5: spikes with I_A only", static_cast<double>(static_spikes.size()), "spikes");
    out.claim("Alg. 5: spikes, as corrected", static_cast<double>(corrected.size()), "spikes")
        .allow_range(static_cast<double>(catalogue_spikes.size()), static_cast<double>(catalogue_spikes.size()),
                     "sa1 of the catalogue with fig. 16's theta")
        .of_kind(ClaimKind::identity);
    raster.raster_row("Alg. 5 as printed, I' = I[n-1]", value)
        .raster_row("Alg. 5 as corrected", corrected)
        .raster_row("sa1", catalogue_spikes);
    return {};
}

/// With K_B and K_C in A/A, as printed, I_B and I_C are proportional to k_A. For another k_A that is wrong (B10).
void check_gain_units(StudyResult& out, const StudyCurve& force) {
    const auto B = [&](double K) { return apply_filter(force, K, 20, FilterForm::corrected).max(); };
    const double k_A = 2;
    out.claim("I_B with k_A doubled, K_B in A/A as printed, over that with k_A = 1 uA/N", B(8e-6 * k_A) / B(8e-6))
        .derived_as(1, "eq. 10 and 12: I_B depends on the force, not on I_A")
        .explain("K_B and K_C are in A/N: 8 and 2 uA/N, which is the same only for k_A = 1 uA/N (B10)");
}

/// Algorithm 6: where I_0 is negative it uses k_B I_0, which is negative too (B12).
Result<void> algorithm_6(StudyResult& out, const StudyCurve& force, StudyPlot& raster) {
    // sign: 1 as printed, -1 as corrected
    const auto current = [&](double sign) {
        double I_0 = 0;
        return apply(force, [&](double F, double before) {
            I_0 = k2(2, T) * (F - before + I_0);
            return I_0 > 0 ? 3.5e-6 * I_0 : sign * 2.75e-6 * I_0;
        });
    };
    const auto as_printed = lif_b(current(1), fa1_membrane).spikes, corrected = lif_b(current(-1), fa1_membrane).spikes;
    const auto catalogue_spikes = TRY(simulate_train(press::thesis_algorithm("fa1")));
    const TimeWindow later{press::retraction.from, 2};
    out.claim("Alg. 6: spikes from the start of retraction, as printed", press::spike_count(as_printed, later), "spikes")
        .allow_min(1, "thesis 1.2 and 3.4: discharges in retraction")
        .explain(
            "k_B I_0 is negative while the force falls; -k_B I_0 is meant, which makes a full-wave rectifier with two gains, as in 4.3.2 "
            "(B12)");
    out.claim("Alg. 6: spikes from the start of retraction, as corrected", press::spike_count(corrected, later), "spikes")
        .allow_range(press::spike_count(catalogue_spikes, later), press::spike_count(catalogue_spikes, later), "fa1 of the catalogue")
        .of_kind(ClaimKind::identity);
    raster.raster_row("Alg. 6 as printed", as_printed).raster_row("Alg. 6 as corrected", corrected).raster_row("fa1", catalogue_spikes);
    return {};
}

/// If the force before the first sample is 0, the resting force acts as a step (B16).
void check_first_sample(StudyResult& out, const StudyCurve& force) {
    out.claim("I_B at the first sample if F[-1] is 0", 8e-6 * k2(20, T) * force.y[0], "A");
    out.claim("I_B at the first sample if F[-1] is F[0], as in our models", apply_filter(force, 8e-6, 20, FilterForm::corrected).y[0], "A")
        .allow_range(0, 0, "B16 leaves this open; a start at rest is our choice")
        .of_kind(ClaimKind::ours);
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto force = TRY(press::force_curve(T));
    StudyPlot raster{"Spikes under the press stimulus, T = 1 ms", "time (s)", "", {}};
    TRY(algorithm_1(out));
    TRY(algorithm_2(out, force));
    TRY(options.report_progress(0.4));
    TRY(algorithm_5(out, force, raster));
    check_gain_units(out, force);
    TRY(algorithm_6(out, force, raster));
    check_first_sample(out, force);
    out.plots.push_back(std::move(raster));
    out.plot("I_B by Alg. 5, T = 1 ms", "time (s)", "current (uA)")
        .add("as corrected", apply_filter(force, 8e-6, 20, FilterForm::corrected).scaled(1, 1e6))
        .add("as printed, I' = I[n-1]", apply_filter(force, 8e-6, 20, FilterForm::value).scaled(1, 1e6))
        .add("as printed, I' a difference, up to 20 ms after the start of the ramp",
             apply_filter(force, 8e-6, 20, FilterForm::difference).between(0, press::protraction.from + 20e-3).scaled(1, 1e6));
    out.note(
        "The other errata are in these studies. B1: fig4. B11a: fig8. B10a, B13, B13a: fig18. B14: fig5. B15: fig17. B9a: eq1-12. The "
        "neurons' errata: errata-neurons. B2a, B8a, B9, B11, B12a to B12c and B17 to B19 concern names, units and wording.");
    return out;
}

const Study study{"errata-models", "Algorithms 1, 2, 5 and 6 as printed",
                  "How do the thesis's algorithms respond as printed, and as corrected by the errata? Thesis 3.1, 3.3, 3.4",
                  ClaimKind::misprint, compute};

}  // namespace corpuscle::studies::errata_models
