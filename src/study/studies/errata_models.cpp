// Algorithms 1, 2, 5 and 6 of the thesis run as printed, beside ours: what each misprint does to the current and the spikes. Numbers B..
// are those of the errata. The neurons' are in errata_neurons.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/algorithms.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::errata_models {

using algorithms::k2, algorithms::lif_b, algorithms::Membrane;

constexpr double T = 1e-3;                            // s: thesis 3.3
constexpr Membrane of_fig16{500e-9, 500e-9, 1, 0.5};  // SA-I with fig. 16's theta
constexpr Membrane fa1_membrane{500e-9, 1e-6, 0.5, 0.25};

template <class Next>  // of F[n], F[n-1]
Line over(const Line& force, Next&& next) {
    Line out = force;
    double before = force.y[0];
    for (std::size_t n = 0; n < force.y.size(); ++n) out.y[n] = next(force.y[n], std::exchange(before, force.y[n]));
    return out;
}

double sum(const Line& line) {
    double out = 0;
    for (const double y : line.y) out += y;
    return out;
}

/// Algorithm 1: k_d multiplies a difference, so its part goes with the sample's length (B2).
Result<void> algorithm_1(Outcome& out) {
    const double k_d = 100e-9;
    double printed[2], mended[2];
    for (int k = 0; k < 2; ++k) {
        const double step = k == 0 ? 1e-3 : 1e-4;
        const auto force = press::samples(step);
        if (!force) return force.error();
        printed[k] = over(*force, [&](double F, double before) { return k_d / 1e-3 * std::abs(F - before); }).most();
        mended[k] = over(*force, [&](double F, double before) { return k_d / step * std::abs(F - before); }).most();
    }
    out.claim("Alg. 1: dynamic part at T = 1 ms over that at 0.1 ms, as printed", printed[0] / printed[1])
        .held_to(1, "thesis 3.1: eq. 1 knows no T")
        .because("F' is F[n] - F[n-1] there; it must be divided by the step, which the text names h and eq. 1 lacks (B2)");
    out.claim("Alg. 1: the same with k_d / T", mended[0] / mended[1]).held_to(1, "thesis 3.1: eq. 1 knows no T");
    return {};
}

/// Algorithm 2: tests F[n] + F[n-1], which is never negative (B3).
Result<void> algorithm_2(Outcome& out, const Line& force) {
    const auto minus = over(force, [](double F, double before) { return F + before > 0 ? 0 : before - F; });
    const auto plus = over(force, [](double F, double before) { return F + before > 0 ? F - before : 0; });
    const auto mended = over(force, [](double F, double before) { return F - before > 0 ? 0 : before - F; });
    out.claim("Alg. 2: sum of I- under the press, as printed", sum(minus), "N")
        .held_to(press::most - press::least, "thesis 3.1, eq. 3: max(-F', 0); what the press falls by")
        .because("the test is on F[n] + F[n-1], which forces never make negative; F[n] - F[n-1] is meant (B3)");
    out.claim("Alg. 2: least I+, as printed", plus.least(), "N")
        .at_least(0, "thesis 3.1, eq. 2: max(F', 0)")
        .because("as before: falling force goes into I+ with its sign (B3)");
    out.claim("Alg. 2: sum of I-, as mended", sum(mended), "N")
        .held_to(press::most - press::least, "thesis 3.1, eq. 3: what the press falls by");
    return {};
}

/// Algorithm 5's filter with what it may mean by its last term: k_2 (I[n-1] - I[n-2]) or k_2 I[n-1], subtracted (B8).
enum class Reading { difference, value, mended };
Line filtered(const Line& force, double K, double f, Reading reading) {
    double last = 0, last_but_one = 0;
    return over(force, [&](double F, double before) {
        const double k = k2(f, T), drive = K * k * (F - before);
        const double I = reading == Reading::difference ? drive - k * (last - last_but_one)
                         : reading == Reading::value    ? drive - k * last
                                                        : drive + k * last;
        last_but_one = std::exchange(last, I);
        return I;
    });
}
Line sa1_current(const Line& force, Reading reading, double K_B = 8e-6, double K_C = 2e-6) {
    Line out = force;
    const auto B = filtered(force, K_B, 20, reading), C = filtered(force, K_C, 2, reading);
    for (std::size_t n = 0; n < force.y.size(); ++n) out.y[n] = 1e-6 * force.y[n] + std::max(B.y[n], 0.0) + std::max(C.y[n], 0.0);
    return out;
}

Result<void> algorithm_5(Outcome& out, const Line& force, Plot& rows) {
    for (const auto& [f, printed_large] : {std::pair{20.0, "filter B"}, {2.0, "filter C"}}) {
        const double k = k2(f, T), root = std::sqrt(k * k + 4 * k);
        out.claim(fmt::format("Alg. 5, {}: larger pole if I' is a difference, as printed", printed_large), -(k + root) / 2)
            .between(-1, 1, "a filter must be stable")
            .because("z^2 + k z - k = 0 (B8); the sign of the last term and what it multiplies are misprinted");
    }
    const auto mended = lif_b(sa1_current(force, Reading::mended), of_fig16).spikes,
               value = lif_b(sa1_current(force, Reading::value), of_fig16).spikes;
    Line static_part = force;
    for (double& y : static_part.y) y *= 1e-6;
    const auto alone = lif_b(static_part, of_fig16).spikes;
    const auto ours = train_of(press::as_algorithm("sa1", {"sa1.V_th=1", "sa1.V_reset=0.5"}));
    if (!ours) return ours.error();
    const auto grown = filtered(force, 8e-6, 20, Reading::difference).between(0, press::up.from + 50e-3).absolute().most();
    out.claim("Alg. 5: largest I_B in 50 ms of the press if I' is a difference, as printed", grown, "A")
        .at_most(8e-6 * (press::most - press::least), "eq. 12: a high-pass of gain K_B cannot give more than K_B times the step")
        .because("it is unstable (B8)");
    out.claim("Alg. 5: spikes if I' is I[n-1], as printed", static_cast<double>(value.size()), "spikes")
        .between(static_cast<double>(ours->size()), static_cast<double>(ours->size()), "sa1 of the catalogue with fig. 16's theta")
        .because("a pole at -k_2 makes it a filter of frequencies near half the sample rate; what it lets through is next to nothing (B8)");
    out.claim("spikes of I_A alone", static_cast<double>(alone.size()), "spikes");
    out.claim("Alg. 5: spikes, as mended", static_cast<double>(mended.size()), "spikes")
        .between(static_cast<double>(ours->size()), static_cast<double>(ours->size()), "sa1 of the catalogue with fig. 16's theta");
    rows.row("Alg. 5 as printed, I' = I[n-1]", value).row("Alg. 5 as mended", mended).row("sa1", *ours);
    return {};
}

/// K_B and K_C in A/A mean k_A times as much, which shows where k_A is another (B10).
void gains(Outcome& out, const Line& force) {
    const auto B = [&](double K) { return filtered(force, K, 20, Reading::mended).most(); };
    const double k_A = 2;
    out.claim("I_B with k_A doubled, K_B in A/A as printed, over that with k_A = 1 uA/N", B(8e-6 * k_A) / B(8e-6))
        .held_to(1, "eq. 10 and 12: I_B hangs on the force, not on I_A")
        .because("K_B and K_C are in A/N: 8 and 2 uA/N, the same at k_A = 1 uA/N alone (B10)");
}

/// Algorithm 6: k_B I_0 where I_0 is negative (B12).
Result<void> algorithm_6(Outcome& out, const Line& force, Plot& rows) {
    const auto current = [&](double sign) {
        double I_0 = 0;
        return over(force, [&](double F, double before) {
            I_0 = k2(2, T) * (F - before + I_0);
            return I_0 > 0 ? 3.5e-6 * I_0 : sign * 2.75e-6 * I_0;
        });
    };
    const auto printed = lif_b(current(1), fa1_membrane).spikes, mended = lif_b(current(-1), fa1_membrane).spikes;
    const auto ours = train_of(press::as_algorithm("fa1"));
    if (!ours) return ours.error();
    const Stretch later{press::down.from, 2};
    out.claim("Alg. 6: spikes from the retraction's start, as printed", press::count(printed, later), "spikes")
        .at_least(1, "thesis 1.2 and 3.4: discharges in retraction")
        .because("k_B I_0 is negative there; -k_B I_0 is meant, a full-wave rectifier with two gains, as 4.3.2 says (B12)");
    out.claim("Alg. 6: the same, as mended", press::count(mended, later), "spikes")
        .between(press::count(*ours, later), press::count(*ours, later), "fa1 of the catalogue");
    rows.row("Alg. 6 as printed", printed).row("Alg. 6 as mended", mended).row("fa1", *ours);
    return {};
}

/// A force before the first that is 0 is a step of the resting force (B16).
void start(Outcome& out, const Line& force) {
    out.claim("I_B at the first sample if F[-1] is 0", 8e-6 * k2(20, T) * force.y[0], "A");
    out.claim("I_B at the first sample if F[-1] is F[0], as here", filtered(force, 8e-6, 20, Reading::mended).y[0], "A")
        .between(0, 0, "B16, open: a choice, at rest");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto force = press::samples(T);
    if (!force) return force.error();
    Plot rows{"Spikes under the press, T = 1 ms", "time (s)", "", {}};
    if (auto ok = algorithm_1(out); !ok) return ok.error();
    if (auto ok = algorithm_2(out, *force); !ok) return ok.error();
    if (auto ok = options.at(0.4); !ok) return ok.error();
    if (auto ok = algorithm_5(out, *force, rows); !ok) return ok.error();
    gains(out, *force);
    if (auto ok = algorithm_6(out, *force, rows); !ok) return ok.error();
    start(out, *force);
    out.plots.push_back(std::move(rows));
    out.plot("I_B by Alg. 5, T = 1 ms", "time (s)", "current (uA)")
        .add("as mended", filtered(*force, 8e-6, 20, Reading::mended).times(1, 1e6))
        .add("as printed, I' = I[n-1]", filtered(*force, 8e-6, 20, Reading::value).times(1, 1e6))
        .add("as printed, I' a difference, its first 20 ms",
             filtered(*force, 8e-6, 20, Reading::difference).between(0, press::up.from + 20e-3).times(1, 1e6));
    out.note(
        "Shown elsewhere: B1 in fig4, B11a in fig8, B10a, B13 and B13a in fig18, B14 in fig5, B15 in fig17, B9a in eq1-12, the neurons' in "
        "errata-neurons. "
        "B2a, B8a, B9, B11, B12a to B12c, B17 to B19 are names, units and words.");
    return out;
}

const Study study{
    "errata-models", "Algorithms 1, 2, 5 and 6 as printed",
    "What do the thesis's algorithms answer if one runs what is printed, and what as its errata mend them? Thesis 3.1, 3.3, 3.4", work};

}  // namespace corpuscle::studies::errata_models
