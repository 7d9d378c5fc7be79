// Fig. 12: a transconductor with a low transconductance, by current splitting (M_M) and by cancellation (M_N). The thesis describes it in
// words only; the sizes are our choice (circuits/ota_cancelling.cir), for the transconductance of INVC.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/transconductor.hpp"

namespace corpuscle::studies::fig12 {

constexpr double S_1 = 2.0 / 8, S_N = 2.0 / 9, S_M = 16;  // aspect ratios of the netlist's arrays: columns over unit transistors in series

/// Simulates the netlist without the devices on these lines.
Result<TransconductorCurve> simulate_without(const std::vector<std::string>& lines) {
    std::vector<std::pair<std::string, std::string>> changes;
    for (const auto& line : lines) changes.emplace_back("\n" + line, "\n* " + line);
    const auto text = substitute_in_embedded_text("circuits/ota_cancelling.cir", changes);
    if (!text) return text.error();
    return simulate_transconductor({*text});
}

/// The current of M_M over that of M_1, at rest.
Result<double> simulate_split() {
    const auto found = run_study_netlist({"ota_cancelling", {}, ".save i(mma) i(m1a)\n.op"});
    if (!found) return found.error();
    return found->operating_point("i(mma)") / found->operating_point("i(m1a)");
}

/// The thesis's statements on any differential pair: its transconductance is low for small currents and small aspect ratios, and it is more
/// linear in stronger inversion.
Result<void> add_pair_claims(StudyResult& out, const StudyOptions& options) {
    const std::string source = "thesis 2.3, text";
    StudyPlot& plot = out.plot("Linear range of a pair without load (slope within 5 %)", "transconductance over tail current (1/V)", "V");
    plot.describe_published("\"the transconductance linearity is also proportional to the transistor inversion\"");
    StudyCurve linear_ranges, g_m;  // V over g_m / i_b, which falls as i_b rises; S over i_b
    for (const double i_b : {1e-9, 3e-9, 10e-9, 30e-9, 100e-9, 300e-9, 1e-6, 3e-6, 10e-6, 30e-6}) {
        const auto pair = simulate_isolated_pair(i_b, 2, 8);
        if (!pair) return pair.error();
        linear_ranges.x.insert(linear_ranges.x.begin(), pair->g_m / i_b);
        linear_ranges.y.insert(linear_ranges.y.begin(), pair->linear_range);
        g_m.x.push_back(i_b), g_m.y.push_back(pair->g_m);
    }
    const auto wide = simulate_isolated_pair(10e-6, 16, 1);
    if (!wide) return wide.error();
    out.claim("pair 2x8: transconductance at 10 nA of tail current over that at 1 nA", g_m.at(10e-9) / g_m.at(1e-9), "times")
        .allow_range(9, 11, source + ": proportional to the current while inversion is weak");
    out.claim("at 10 uA: transconductance of 2x8 over that of 16x1", g_m.at(10e-6) / wide->g_m)
        .allow_max(0.9, source + ": falls with the aspect ratio, in stronger inversion");
    out.claim("pair 2x8: linear range at 30 uA over that at 1 nA", linear_ranges.y.front() / linear_ranges.y.back(), "times")
        .allow_min(1, source + ": more linear in stronger inversion");
    plot.add("P pair of 2x8, 1 nA to 30 uA", linear_ranges);
    return options.report_progress(0.5);
}

/// The bulk and the drain transconductance of a transistor, compared with its gate transconductance.
Result<void> add_terminal_claims(StudyResult& out) {
    const auto found = run_study_netlist({R"(One transistor three times, driven at its gate, bulk and drain
.lib '../process/tsmc180.lib' tt
vs s 0 0
vg g1 s 0.35
v1 d1 0 0.35
m1 d1 g1 0 0 nch w=1.5u l=0.5u m=2 stack=8
vg2 g2 0 0.35
v2 d2 0 0.35
m2 d2 g2 0 s nch w=1.5u l=0.5u m=2 stack=8
v3 d3 s 0.35
m3 d3 g2 0 0 nch w=1.5u l=0.5u m=2 stack=8
)",
                                          {},
                                          ".dc vs -2m 2m 1m"});
    if (!found) return found.error();
    const auto slope = [&](const char* current) { return -found->curve("dc", current).slope_at(0); };
    const std::string source = "thesis 2.3: bulk and drain transconductances \"are a fraction of the gate transconductance\"";
    out.claim("N 2x8 at 0.35 V: bulk transconductance over gate transconductance", slope("i(v2)") / slope("i(v1)"))
        .allow_range(0, 1, source);
    out.claim("N 2x8 at 0.35 V: drain transconductance over gate transconductance", slope("i(v3)") / slope("i(v1)"))
        .allow_range(0, 1, source);
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto all = simulate_without({}), without_N = simulate_without({"mna ", "mnb "}),
               pair_only = simulate_without({"mna ", "mnb ", "mma ", "mmb "});
    const auto without_M = simulate_without({"mma ", "mmb "});
    const auto split = simulate_split();
    for (const auto* r : {&all, &without_N, &without_M, &pair_only})
        if (!*r) return r->error();
    if (!split) return split.error();
    const std::string source = "thesis 2.3, fig. 12";
    out.claim("G_m of the complete circuit (chosen equal to INVC's of circuits/invc.cir)", all->g_m, "S");
    out.claim("current of M_M over that of M_1", *split, "times")
        .derived_as(S_M / S_1, source + ": \"proportionally to their dimensions\"")
        .explain_if_needed("M_M's drain is at vss, M_1's at the load: the single transistors of M_M have the lower Early voltage");
    out.claim("splitting only: G_m with M_M over G_m without M_M", without_N->g_m / pair_only->g_m)
        .derived_as(S_1 / (S_1 + S_M), source + ": lower by the split of the current, in weak inversion")
        .explain_if_needed("the error of the current of M_M over that of M_1");
    out.claim("cancellation only: G_m with M_N over G_m without M_N", without_M->g_m / pair_only->g_m)
        .derived_as((S_1 - S_N) / (S_1 + S_N), source + ": the difference of two transconductances, in weak inversion")
        .explain_if_needed("a difference of nearly equal numbers amplifies the error of each");
    out.claim("both techniques: G_m over that of the pair alone", all->g_m / pair_only->g_m)
        .derived_as((S_1 - S_N) / (S_1 + S_N + S_M), source + ", in weak inversion")
        .explain_if_needed("the errors of splitting and of cancellation multiply");
    out.claim("linear range (slope within 5 %) up to plus and minus", all->linear_range, "V");
    out.claim("linear range of the pair alone up to plus and minus", pair_only->linear_range, "V");
    out.claim_true("with both techniques the linear range stays within a tenth of the pair's",
                   std::abs(all->linear_range / pair_only->linear_range - 1) < 0.1,
                   "thesis 2.3: they balance linearity and transconductance; the bound is our choice");
    out.claim("power of the complete circuit", all->power, "W");
    StudyPlot& plot = out.plot("Output current relative to the largest current that both signs reach", "V_+ - V_- (V)", "I / largest");
    for (const auto& [name, t] : {std::pair{"complete", &*all}, {"without M_N", &*without_N}, {"pair only", &*pair_only}})
        plot.add(name, t->current.between(-0.15, 0.15).scaled(1, t->sign() / t->max_current));
    out.note(
        "Beyond 0.2 V the tail node falls below the output, which is held at 0.35 V here, and M_N conducts in the other direction; the "
        "curve ends before that.");
    out.note(
        "The sizes are our choice: M_1 2x8, M_N 2x9, M_M 16x1. \"Pair only\" is the same netlist without M_M and M_N. The published value "
        "of a claim is the ratio of aspect ratios that the text names.");
    if (auto ok = add_terminal_claims(out); !ok) return ok.error();
    if (auto ok = add_pair_claims(out, options); !ok) return ok.error();
    return out;
}

const Study study{"fig12", "A low transconductance by current splitting and cancellation",
                  "The current is split in proportion to the sizes, which lowers G_m; slightly smaller cross-coupled devices cancel most "
                  "of the rest. Thesis 2.3, fig. 12",
                  compute};

}  // namespace corpuscle::studies::fig12
