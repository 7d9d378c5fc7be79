// Fig. 13: a pair whose mirrors have N transistors in parallel at the input and N in series at the output, which divides current and
// transconductance by N^2. The thesis describes it in words only; N = 8 and the other sizes are our choice
// (circuits/ota_series_parallel.cir).

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/transconductor.hpp"

namespace corpuscle::studies::fig13 {

/// The netlist with mirrors of N transistors and a tail current of i_b (A).
Result<TransconductorCurve> simulate_mirrors(int N, double i_b) {
    const auto text = substitute_in_embedded_text("circuits/ota_series_parallel.cir",
                                                  {{"nch_hv w=1.5u l=0.5u m=8\n", fmt::format("nch_hv w=1.5u l=0.5u m={}\n", N)},
                                                   {"l=0.5u stack=8\n", fmt::format("l=0.5u stack={}\n", N)}});
    if (!text) return text.error();
    return simulate_transconductor({*text, {fmt::format("i_b={}", i_b)}});
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const std::string source = "thesis 2.3, fig. 13";
    constexpr double i_b = 502e-12,
                     strong = 100e-9;         // A: the netlist's tail current; a larger one, for which the mirrors' voltages matter more
    StudyCurve weak_divisor, strong_divisor;  // G_m at N = 1 over G_m, over N, for the two tail currents
    TransconductorCurve with_8;
    double plain = 0, plain_strong = 0;
    for (const int N : {1, 2, 3, 4, 6, 8}) {
        const auto t = simulate_mirrors(N, i_b), s = simulate_mirrors(N, strong);
        if (!t) return t.error();
        if (!s) return s.error();
        if (N == 1) plain = t->g_m, plain_strong = s->g_m;
        weak_divisor.x.push_back(N), weak_divisor.y.push_back(plain / t->g_m);
        strong_divisor.x.push_back(N), strong_divisor.y.push_back(plain_strong / s->g_m);
        if (N == 8) with_8 = *t;
    }
    if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    const std::string why =
        "length modulation: the parallel diode has all of its voltage across one unit transistor, the series array across N of them, so "
        "the diode carries more current than its ratio gives";
    for (const double N : {2.0, 4.0, 8.0})
        out.claim(fmt::format("N = {}: G_m is divided by (relative to N = 1)", N), weak_divisor.at(N), "times")
            .derived_as(N * N, source + ": N^2, for both current and transconductance")
            .explain_if_needed(why);
    const auto pair_only = simulate_isolated_pair(i_b, 2, 8);
    if (!pair_only) return pair_only.error();
    out.claim("N = 8: tail current over the largest output current", i_b / with_8.max_current, "times")
        .derived_as(64, source + ": N^2")
        .explain_if_needed(why);
    out.claim("N = 8: G_m (chosen equal to INVC's of circuits/invc.cir)", with_8.g_m, "S");
    out.claim("N = 8: linear range (slope within 5 %) up to plus and minus", with_8.linear_range, "V");
    out.claim("linear range of the pair without load up to plus and minus", pair_only->linear_range, "V");
    out.claim_true("with the mirrors the linear range stays within a tenth of the pair's",
                   std::abs(with_8.linear_range / pair_only->linear_range - 1) < 0.1, "thesis 2.3: the mirrors attenuate only the output");
    out.claim("N = 8: power", with_8.power, "W");

    const auto cancelling = simulate_transconductor({"ota_cancelling"}),
               invc = simulate_transconductor({R"(INVC under the conditions of fig. 13
.lib '../process/tsmc180.lib' tt
.include 'parts/transconductor.inc'
vdd vdd 0 0.7
vi vdd supply 0
ibias gp 0 200n
xbias vdd gp bp bn bias
vplus plus 0 0.35
x1 plus out gp1 gn1 supply bp bn invc
vout out 0 0.35
)"});
    if (!cancelling) return cancelling.error();
    if (!invc) return invc.error();
    out.claim("INVC, the thesis's own: linear range up to plus and minus", invc->linear_range, "V");
    out.claim("INVC: power", invc->power, "W");
    out.claim_true("INVC has a larger linear range than the circuits of figs. 12 and 13",
                   invc->linear_range > with_8.linear_range && invc->linear_range > cancelling->linear_range,
                   "thesis 2.3: it \"combines the two techniques\"; app. E: linearised");
    out.claim_true("INVC takes less power than the circuits of figs. 12 and 13",
                   invc->power < with_8.power && invc->power < cancelling->power,
                   "thesis 2.3: \"to decrease the ... total power consumption\"")
        .explain_if_needed(
            "at the same transconductance the pairs take less: their tails carry nanoamperes, INVC's linear stage the bias of 200 nA. In "
            "return INVC's linear range is many times as wide; a fair comparison needs a pair with source degeneration and the same range");
    for (auto* line : {&weak_divisor, &strong_divisor})
        for (std::size_t k = 0; k < line->x.size(); ++k) line->y[k] /= line->x[k] * line->x[k];
    out.plot("Divisor of G_m by mirrors of N in parallel and N in series, over N^2", "N", "times")
        .add(fmt::format("tail {:g} pA", i_b * 1e12), weak_divisor)
        .add(fmt::format("tail {:g} nA", strong * 1e9), strong_divisor)
        .describe_published("N^2 by the text");
    out.plot("Three transconductors of equal transconductance", "V_+ - V_- (V)", "I (pA)")
        .add("fig. 12", cancelling->current.between(-0.15, 0.15).scaled(1, 1e12 * cancelling->sign()))
        .add("fig. 13", with_8.current.between(-0.15, 0.15).scaled(1, 1e12 * with_8.sign()))
        .add("INVC", invc->current.between(-0.15, 0.15).scaled(1, 1e12 * invc->sign()))
        .describe_published("the thesis names the balance of linearity and low transconductance");
    return out;
}

const Study study{
    "fig13", "A low transconductance by parallel-to-series mirrors",
    "Mirrors of N transistors in parallel and N in series divide the pair's current and transconductance by N^2. Compared with "
    "fig. 12 and with the thesis's own circuit of the same transconductance. Thesis 2.3, fig. 13",
    compute};

}  // namespace corpuscle::studies::fig13
