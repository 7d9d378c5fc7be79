// Fig. 23 and table 2: the transducer's amplifier by itself, and the bulks that 4.2 lifts, lifted and not. Its mirrors stand in
// fig23_mirrors.cpp, its loop in transducer_loop.cpp.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig23 {

using Changes = std::vector<std::pair<std::string, std::string>>;
const std::string text = "thesis 4.2, fig. 23";

const Changes pair_at_supply = {{" t b3 pch", " t vdd pch"}, {" t b4 pch", " t vdd pch"}};
const Changes pair_at_source = {{" t b3 pch", " t t pch"}, {" t b4 pch", " t t pch"}};
const Changes n_unlifted = {{" 0 b5 nch", " 0 0 nch"}, {" f1 b6 nch", " f1 0 nch"}, {" f2 b6 nch", " f2 0 nch"}};
const Changes p_unlifted = {{" vdd b1 pch", " vdd vdd pch"}, {" b2 pch w=6u l=0.5u m=16", " vdd pch w=6u l=0.5u m=16"}};
/// The input pair's bulks straight at vss, each through a source that shows what they take.
const Changes unlimited = {{"mp3c plus  0 b3 b3 pch w=6u l=0.5u m=16", "vb3 b3 0 0"},
                           {"mp3d minus 0 b4 b4 pch w=6u l=0.5u m=16", "vb4 b4 0 0"}};

/// circuits/amplifier.cir with these changes in its parts.
Result<Found> amplifier(const Changes& changes, const std::string& orders = "") {
    const auto parts = changed_text("circuits/parts/transducer.inc", changes);
    if (!parts) return parts.error();
    auto netlist = changed_text("circuits/amplifier.cir", {{".include 'parts/transducer.inc'", *parts}});
    if (!netlist) return netlist.error();
    return found_in({std::move(*netlist), {}, orders});
}

/// Transconductance over the common mode: of circuits/amplifier.cir's pair of cells, 0.1 mV apart either way.
Result<Line> transconductance(const Changes& changes) {
    const auto found = amplifier(changes, ".dc vs 0 0.7 2m");
    if (!found) return found.error();
    return found->line("dc", "par('(i(v1)-i(v2))/0.2m')");
}
double up_to(const Line& g_m) { return g_m.where(g_m.at(0.1) / 2, 0.1); }

/// Gain, band and ranges of the amplifier by itself.
Result<void> tell_alone(Outcome& out) {
    const auto found = amplifier({});
    if (!found) return found.error();
    const auto supply =
        found_in({"One amplifier\n.lib '../process/tsmc180.lib' tt\n.include 'parts/transducer.inc'\nvdd vdd 0 0.7\nvi vdd top 0\n"
                  "vp plus 0 0.1\niba pg 0 100n\nxamp plus plus out pg top amplifier\nvo out 0 0.35\n",
                  {},
                  ".op"});
    if (!supply) return supply.error();
    const double I = supply->at_rest("i(vi)");
    out.claim("gain into the transducer's M_1 to M_3", 20 * std::log10(found->number("gain")), "dB");
    out.claim("gain-bandwidth there", found->number("f_unity"), "Hz");
    out.claim("phase margin there, with feedback of one", found->number("margin"), "degrees")
        .at_least(45, "not printed; the bound is stated here");
    out.claim("input transconductance at V_Y", found->number("g_m"), "S");
    out.claim("offset", found->number("offset"), "V");
    out.claim("supply current", I, "A").held_to(500e-9, "five trapezoids of I_BIASA, fig. 23 and table 2");
    out.claim("power at 0.7 V", 0.7 * I, "W");
    const auto g_m = found->line("dc", "par('(i(v1)-i(v2))/0.2m')");
    Line gain = found->line("dc", "i(v3)").slope().absolute();
    for (double& g : gain.y) g = g_m.at(0.1) / g;
    const double half = gain.most() / 2;
    out.claim("common mode up to (half of the transconductance)", up_to(g_m), "V").at_least(0.1, "V_Y, which it must take (errata F12)");
    out.claim("output from (half of the gain)", gain.where(half), "V");
    out.claim("output to", gain.where(half, gain.peak()), "V")
        .at_least(525e-3, "thesis 4.2, fig. 24c: the largest V_Z")
        .if_off("half of the gain is a bound stated here; beyond it gain is left, and the loop needs little of it (transducer-loop)");
    out.claim("gain that is left at 525 mV", 20 * std::log10(gain.at(525e-3)), "dB");
    out.plot("Gain along the output", "V_Z (V)", "gain").add("by g_m over the output's conductance", gain);
    return {};
}

Result<void> tell_input_pair(Outcome& out) {
    const auto lifted = transconductance({}), at_supply = transconductance(pair_at_supply), at_source = transconductance(pair_at_source);
    for (const auto* r : {&lifted, &at_supply, &at_source})
        if (!*r) return r->error();
    out.claim("common mode up to, bulks of the pair at the supply", up_to(*at_supply), "V");
    out.claim("common mode up to, bulks at the source", up_to(*at_source), "V");
    out.claim("what the bias of the bulks gains beside bulks at the supply", up_to(*lifted) - up_to(*at_supply), "V")
        .at_least(0, text + ": \"to increase the OTA common-mode input voltage excursion\"");
    out.plot("Transconductance along the common mode", "V (both inputs)", "g_m (uS)")
        .add("fig. 23: bulks by M_3C, D", lifted->times(1, 1e6))
        .add("bulks at the source", at_source->times(1, 1e6))
        .add("bulks at the supply", at_supply->times(1, 1e6));
    const auto bulks = amplifier(unlimited, ".dc vs 0 0.7 2m"),
               held = amplifier({}, ".save v(x3.b3) v(x3.t) i(vplus) i(vs)\n.dc vs 0 0.7 2m");
    if (!bulks) return bulks.error();
    if (!held) return held.error();
    const auto free_current = bulks->line("dc", "i(x1.vb3)").absolute();
    const auto limited =
        found_in({"One amplifier\n.lib '../process/tsmc180.lib' tt\n.include 'parts/transducer.inc'\nvdd vdd 0 0.7\nvp plus 0 0.1\n"
                  "vm minus plus 0\niba pg 0 100n\nxamp plus minus out pg vdd amplifier\nvo out 0 0.35\n",
                  {},
                  ".dc vp 0 0.7 2m"});
    if (!limited) return limited.error();
    const auto kept = limited->line("dc", "i(vm)").absolute();
    out.claim("a bulk's current with both inputs at 0.4 V, straight at vss", free_current.at(0.4), "A");
    out.claim("the same limited by M_3C, D, which it leaves through the input", kept.at(0.4), "A")
        .at_most(free_current.at(0.4), text + ": M_3C, D limit the parasitic substrate current");
    out.claim("current out of an input at V_Y", kept.at(0.1), "A");
    return {};
}

/// What lifted bulks in the mirrors do for the supply: of the amplifier (from where on it has half of the transconductance that it has at
/// 0.7 V, inputs at V_Y, output at half the supply), of I_BIASA's diode, and of the transducer at 0.2 N.
struct Supplies {
    double amplifier, diode, transducer;
};
Result<Supplies> supplies(const Changes& changes) {
    const TransducerCell cell{"t", improved_cell()};
    const auto parts = changed_text("circuits/parts/transducer.inc", changes);
    if (!parts) return parts.error();
    const auto found =
        found_in({fmt::format("Two amplifiers, 0.1 mV apart either way\n.lib '../process/tsmc180.lib' tt\n{}\nvdd vdd 0 0.7\n"
                              "vs s 0 0.1\nvup up s 50u\nvdown s down 50u\nib1 pg1 0 100n\nx1 up down o1 pg1 vdd amplifier\n"
                              "v1 o1 half 0\nib2 pg2 0 100n\nx2 down up o2 pg2 vdd amplifier\nv2 o2 half 0\n"
                              "ehalf half 0 vdd 0 0.5\n",
                              *parts),
                  {},
                  ".dc vdd 0.25 0.7 5m"});
    const auto whole = lowest_supplies({&cell, 1}, 0.2, {}, *parts);
    if (!found) return found.error();
    if (!whole) return whole.error();
    const auto g_m = found->line("dc", "par('(i(v1)-i(v2))/0.2m')"), diode = found->line("dc", "v(vdd,pg1)");
    return Supplies{g_m.where(g_m.at(0.7) / 2), diode.at(0.7), whole->front()};
}

Result<void> tell_supply(Outcome& out) {
    const auto lifted = supplies({}), no_n = supplies(n_unlifted), no_p = supplies(p_unlifted);
    for (const auto* r : {&lifted, &no_n, &no_p})
        if (!*r) return r->error();
    const std::string lower = text + ": forward body bias in the mirrors \"to decrease the minimum voltage supply requirement\"";
    out.claim("lowest supply of the amplifier", lifted->amplifier, "V");
    out.claim("lowest supply of the amplifier, N mirrors' bulks at vss", no_n->amplifier, "V").at_least(lifted->amplifier, lower);
    out.claim("what I_BIASA's diode needs", lifted->diode, "V");
    out.claim("what I_BIASA's diode needs, P mirrors' bulks at the supply", no_p->diode, "V").at_least(lifted->diode, lower);
    out.claim("lowest supply of the transducer at 0.2 N", lifted->transducer, "V");
    out.claim("lowest supply of the transducer at 0.2 N, N mirrors' bulks at vss", no_n->transducer, "V")
        .at_least(lifted->transducer, lower)
        .if_off(
            "V_Z, not the mirrors, sets it: there both legs are short of supply, and with the bulks at vss the left one, whose end then "
            "stands about as high "
            "as V_Z, is as short as the right one, so that they stay alike");
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    double done = 0;
    for (const auto tell : {tell_alone, tell_input_pair, tell_supply}) {
        if (auto ok = tell(out); !ok) return ok.error();
        if (auto ok = options.at(done += 0.3); !ok) return ok.error();
    }
    out.note(
        "Nothing of the amplifier but sizes, I_BIASA and words is printed. That its pair is of P is a reading (errata F10a); how it folds "
        "into the N mirror, "
        "too (circuits/parts/transducer.inc).");
    return out;
}

const Study study{"fig23", "The transducer's amplifier",
                  "A folded cascode with self-cascode mirrors and lifted bulks: larger ranges of input and output, a lower supply. Thesis "
                  "4.2, fig. 23, table 2",
                  work};

}  // namespace corpuscle::studies::fig23
