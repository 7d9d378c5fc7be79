// Fig. 13: a pair whose mirrors are N transistors in parallel to N in series, so that current and transconductance are divided by N^2.
// Words are printed; N = 8 and the other sizes are a choice (circuits/ota_series_parallel.cir).

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/transconductor.hpp"

namespace corpuscle::studies::fig13 {

Result<Transconductor> with_mirrors_of(int N, double i_b) {
    const auto text =
        changed_text("circuits/ota_series_parallel.cir", {{"nch_hv w=1.5u l=0.5u m=8\n", fmt::format("nch_hv w=1.5u l=0.5u m={}\n", N)},
                                                          {"l=0.5u stack=8\n", fmt::format("l=0.5u stack={}\n", N)}});
    if (!text) return text.error();
    return transconductor_of({*text, {fmt::format("i_b={}", i_b)}});
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const std::string source = "thesis 2.3, fig. 13";
    constexpr double i_b = 502e-12, strong = 100e-9;  // A: the netlist's own, and one in whose mirrors voltages count for more
    Line weak_by, strong_by;
    Transconductor eight;
    double plain = 0, plain_strong = 0;
    for (const int N : {1, 2, 3, 4, 6, 8}) {
        const auto t = with_mirrors_of(N, i_b), s = with_mirrors_of(N, strong);
        if (!t) return t.error();
        if (!s) return s.error();
        if (N == 1) plain = t->g_m, plain_strong = s->g_m;
        weak_by.x.push_back(N), weak_by.y.push_back(plain / t->g_m);
        strong_by.x.push_back(N), strong_by.y.push_back(plain_strong / s->g_m);
        if (N == 8) eight = *t;
    }
    if (auto ok = options.at(0.5); !ok) return ok.error();
    const std::string why =
        "length modulation: the parallel diode bears all of the voltage on one unit's length, the series array on N of them, so that the "
        "diode "
        "carries more than its share";
    for (const double N : {2.0, 4.0, 8.0})
        out.claim(fmt::format("N = {}: G_m is divided by", N), weak_by.at(N), "times")
            .held_to(N * N, source + ": N^2, current and transconductance alike")
            .if_off(why);
    const auto bare = pair_alone(i_b, 2, 8);
    if (!bare) return bare.error();
    out.claim("N = 8: largest current, of the tail's", i_b / eight.most, "times").held_to(64, source + ": N^2").if_off(why);
    out.claim("N = 8: G_m (chosen as INVC's of circuits/invc.cir)", eight.g_m, "S");
    out.claim("straight (slope within 5 %) to", eight.straight, "V");
    out.claim("the same of the pair alone", bare->straight, "V");
    out.finds("the mirrors leave the pair as straight as it is, to a tenth", std::abs(eight.straight / bare->straight - 1) < 0.1,
              "thesis 2.3: the mirrors attenuate the output alone");
    out.claim("power", eight.power, "W");

    const auto cancelling = transconductor_of({"ota_cancelling"}), invc = transconductor_of({R"(INVC as fig. 13 is held
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
    out.claim("INVC, the thesis's own: straight to", invc->straight, "V");
    out.claim("INVC: power", invc->power, "W");
    out.finds("INVC is straighter than either", invc->straight > eight.straight && invc->straight > cancelling->straight,
              "thesis 2.3: it \"combines the two techniques\"; app. E: linearised");
    out.finds("INVC takes less power than either", invc->power < eight.power && invc->power < cancelling->power,
              "thesis 2.3: \"to decrease the ... total power consumption\"")
        .if_off(
            "at the same transconductance the pairs take less: their tails carry nanoamperes, INVC's linear stage the bias of 200 nA. It "
            "pays "
            "for a range many times as wide; a pair degenerated to that range would be the fair one beside it");
    for (auto* line : {&weak_by, &strong_by})
        for (std::size_t k = 0; k < line->x.size(); ++k) line->y[k] /= line->x[k] * line->x[k];
    out.plot("What N parallel to N in series divide G_m by, over N^2", "N", "times")
        .add(fmt::format("tail {:g} pA", i_b * 1e12), weak_by)
        .add(fmt::format("tail {:g} nA", strong * 1e9), strong_by)
        .shape("by the words N^2");
    out.plot("Three of one transconductance", "V_+ - V_- (V)", "I (pA)")
        .add("fig. 12", cancelling->current.between(-0.15, 0.15).times(1, 1e12 * cancelling->sense()))
        .add("fig. 13", eight.current.between(-0.15, 0.15).times(1, 1e12 * eight.sense()))
        .add("INVC", invc->current.between(-0.15, 0.15).times(1, 1e12 * invc->sense()))
        .shape("the thesis names the balance of linearity and small transconductance");
    return out;
}

const Study study{
    "fig13", "A small transconductance by mirrors from parallel to series",
    "N in parallel to N in series divide the pair's current and transconductance by N^2. Thesis 2.3, fig. 13; and beside fig. 12's and the "
    "thesis's own of the same transconductance",
    work};

}  // namespace corpuscle::studies::fig13
