// Fig. 12: a transconductor made small by throwing current away (M_M) and by taking transconductance off (M_N). What is printed is words;
// sizes are a choice (circuits/ota_cancelling.cir), so that it has INVC's transconductance.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/transconductor.hpp"

namespace corpuscle::studies::fig12 {

constexpr double S_1 = 2.0 / 8, S_N = 2.0 / 9, S_M = 16;  // of the netlist's arrays, columns over units in series

/// The netlist without the devices whose lines are these.
Result<Transconductor> without(const std::vector<std::string>& lines) {
    std::vector<std::pair<std::string, std::string>> changes;
    for (const auto& line : lines) changes.emplace_back("\n" + line, "\n* " + line);
    const auto text = changed_text("circuits/ota_cancelling.cir", changes);
    if (!text) return text.error();
    return transconductor_of({*text});
}

/// How M_1's current stands to M_M's.
Result<double> split() {
    const auto found = found_in({"ota_cancelling", {}, ".save i(mma) i(m1a)\n.op"});
    if (!found) return found.error();
    return found->at_rest("i(mma)") / found->at_rest("i(m1a)");
}

/// What words say of any pair: small by small currents and by small aspect ratios, straighter in stronger inversion.
Result<void> tell_pairs(Outcome& out, const StudyOptions& options) {
    const std::string source = "thesis 2.3, words";
    Plot& plot = out.plot("How far a pair alone is straight (slope within 5 %)", "transconductance over tail current (1/V)", "V");
    plot.shape("\"the transconductance linearity is also proportional to the transistor inversion\"");
    Line straight, g_m;
    for (const double i_b : {1e-9, 3e-9, 10e-9, 30e-9, 100e-9, 300e-9, 1e-6, 3e-6, 10e-6, 30e-6}) {
        const auto pair = pair_alone(i_b, 2, 8);
        if (!pair) return pair.error();
        straight.x.insert(straight.x.begin(), pair->g_m / i_b), straight.y.insert(straight.y.begin(), pair->straight);
        g_m.x.push_back(i_b), g_m.y.push_back(pair->g_m);
    }
    const auto wide = pair_alone(10e-6, 16, 1);
    if (!wide) return wide.error();
    out.claim("pair 2x8: transconductance from 1 to 10 nA of tail", g_m.at(10e-9) / g_m.at(1e-9), "times")
        .between(9, 11, source + ": proportional to the current while inversion is weak");
    out.claim("at 10 uA: transconductance of 2x8 over that of 16x1", g_m.at(10e-6) / wide->g_m)
        .at_most(0.9, source + ": falls with the aspect ratio, in stronger inversion");
    out.claim("pair 2x8: straight at 30 uA over straight at 1 nA", straight.y.front() / straight.y.back(), "times")
        .at_least(1, source + ": straighter in stronger inversion");
    plot.add("P pair of 2x8, 1 nA to 30 uA", straight);
    return options.at(0.5);
}

/// What a transistor's bulk and drain make of a voltage beside what its gate makes.
Result<void> tell_terminals(Outcome& out) {
    const auto found = found_in({R"(One transistor three times, driven at its gate, bulk and drain
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
    const auto slope = [&](const char* current) { return -found->line("dc", current).slope_at(0); };
    const std::string source = "thesis 2.3: bulk and drain transconductances \"are a fraction of the gate transconductance\"";
    out.claim("N 2x8 at 0.35 V: bulk's transconductance over the gate's", slope("i(v2)") / slope("i(v1)")).between(0, 1, source);
    out.claim("N 2x8 at 0.35 V: drain's over the gate's", slope("i(v3)") / slope("i(v1)")).between(0, 1, source);
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto all = without({}), no_n = without({"mna ", "mnb "}), bare = without({"mna ", "mnb ", "mma ", "mmb "});
    const auto no_m = without({"mma ", "mmb "});
    const auto i_m = split();
    for (const auto* r : {&all, &no_n, &no_m, &bare})
        if (!*r) return r->error();
    if (!i_m) return i_m.error();
    const std::string source = "thesis 2.3, fig. 12";
    out.claim("G_m, of all three (chosen as INVC's of circuits/invc.cir)", all->g_m, "S");
    out.claim("current of M_M over that of M_1", *i_m, "times")
        .held_to(S_M / S_1, source + ": \"proportionally to their dimensions\"")
        .if_off("M_M's drain is at vss, M_1's at the load: the single transistors of M_M have the lower Early voltage");
    out.claim("splitting alone: G_m with M_M over that without", no_n->g_m / bare->g_m)
        .held_to(S_1 / (S_1 + S_M), source + ": lower by the share of the current, in weak inversion")
        .if_off("the split is off by as much");
    out.claim("cancelling alone: G_m with M_N over that without", no_m->g_m / bare->g_m)
        .held_to((S_1 - S_N) / (S_1 + S_N), source + ": the difference of two transconductances, in weak inversion")
        .if_off("a difference of nearly equal numbers shows each one's error many times over");
    out.claim("both: G_m over that of the pair alone", all->g_m / bare->g_m)
        .held_to((S_1 - S_N) / (S_1 + S_N + S_M), source + ", in weak inversion")
        .if_off("the two above, multiplied");
    out.claim("straight (slope within 5 %) to", all->straight, "V");
    out.claim("the same of the pair alone", bare->straight, "V");
    out.finds("together they leave the pair as straight as it is, to a tenth", std::abs(all->straight / bare->straight - 1) < 0.1,
              "thesis 2.3: they balance linearity and transconductance; stated here");
    out.claim("power", all->power, "W");
    Plot& plot = out.plot("Output current, of the largest positive one, over the input", "V_+ - V_- (V)", "I / largest");
    for (const auto& [name, t] : {std::pair{"all of it", &*all}, {"without M_N", &*no_n}, {"the pair alone", &*bare}})
        plot.add(name, t->current.between(-0.15, 0.15).times(1, t->sense() / t->most));
    out.note("Beyond 0.2 V the tail falls below the output, held at 0.35 V here, and M_N conducts the other way; the curve ends before.");
    out.note(
        "Sizes are ours: M_1 2x8, M_N 2x9, M_M 16x1. The pair alone is the same netlist without M_M and M_N. What a printed number stands "
        "for "
        "here is the ratio of aspect ratios that the words name.");
    if (auto ok = tell_terminals(out); !ok) return ok.error();
    if (auto ok = tell_pairs(out, options); !ok) return ok.error();
    return out;
}

const Study study{
    "fig12", "A small transconductance by splitting and by cancelling",
    "Current is split in proportion to sizes and so lowers G_m; cross-coupled devices, slightly smaller, take off most of what is left. "
    "Thesis 2.3, fig. 12",
    work};

}  // namespace corpuscle::studies::fig12
