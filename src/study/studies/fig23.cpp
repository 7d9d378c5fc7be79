// Fig. 23 and table 2: the transducer's amplifier, alone and in its loop; and each technique that 4.2 names, with and without it.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "study/force_sensor.hpp"
#include "study/studies.hpp"

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
    out.claim("supply current", I, "A").printed_as(500e-9, "five trapezoids of I_BIASA, fig. 23 and table 2");
    out.claim("power at 0.7 V", 0.7 * I, "W");
    const auto g_m = found->line("dc", "par('(i(v1)-i(v2))/0.2m')");
    Line gain = found->line("dc", "i(v3)").slope().absolute();
    for (double& g : gain.y) g = g_m.at(0.1) / g;
    const double half = gain.most() / 2;
    out.claim("common mode up to (half of the transconductance)", up_to(g_m), "V").at_least(0.1, "V_Y, which it must take (errata F12)");
    out.claim("output from (half of the gain)", gain.where(half), "V");
    out.claim("output to", gain.where(half, gain.peak()), "V")
        .at_least(525e-3, "thesis 4.2, fig. 24c: the largest V_Z")
        .if_off("half of the gain is a bound stated here; beyond it gain is left, and the loop needs little of it (below)");
    out.claim("gain that is left at 525 mV", 20 * std::log10(gain.at(525e-3)), "dB");
    out.plot("Gain along the output", "V_Z (V)", "gain").add("by g_m over the output's conductance", gain).shape("no figure");
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
        .add("bulks at the supply", at_supply->times(1, 1e6))
        .shape("no figure");
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

/// Mirrors of 100 nA, their inputs fed alike: from where on the output's resistance is at least half of that at 0.5 V.
Result<void> tell_mirrors(Outcome& out) {
    const auto found = found_in({R"(Mirrors of fig. 23 beside others
.lib '../process/tsmc180.lib' tt
vdd vdd 0 0.7
vout out 0 0.35
* self-cascode, bulks lifted as in fig. 23
i1 vdd a 100n
mn5a a a f b6 nch w=1.5u l=0.5u m=16
mn4a f a 0 b5 nch w=1.5u l=0.5u m=4 stack=4
mn4c a vdd b5 b5 nch w=1.5u l=0.5u m=8
mn5c a vdd b6 b6 nch w=1.5u l=0.5u m=8
va out oa 0
mn5b oa a g b6 nch w=1.5u l=0.5u m=16
mn4b g a 0 b5 nch w=1.5u l=0.5u m=4 stack=4
* the same, bulks at vss
i2 vdd c 100n
mc5a c c h 0 nch w=1.5u l=0.5u m=16
mc4a h c 0 0 nch w=1.5u l=0.5u m=4 stack=4
vc out oc 0
mc5b oc c k 0 nch w=1.5u l=0.5u m=16
mc4b k c 0 0 nch w=1.5u l=0.5u m=4 stack=4
* the conventional cascode, a diode on a diode, from a supply that it needs
i3 0 d 100n
md5a d d e 0 nch w=1.5u l=0.5u m=16
md4a e e 0 0 nch w=1.5u l=0.5u m=4 stack=4
vd out od 0
md5b od d l 0 nch w=1.5u l=0.5u m=16
md4b l e 0 0 nch w=1.5u l=0.5u m=4 stack=4
* the lower array alone
i4 vdd p 100n
me4a p p 0 0 nch w=1.5u l=0.5u m=4 stack=4
ve out oe 0
me4b oe p 0 0 nch w=1.5u l=0.5u m=4 stack=4
* P: trapezoid as table 2, and its upper array alone
i5 q 0 100n
mp1a r q vdd vdd pch w=6u l=0.5u m=4 stack=4
mp2a q q r vdd pch w=6u l=0.5u m=16
mp1b s q vdd vdd pch w=6u l=0.5u m=4 stack=4
mp2b op q s vdd pch w=6u l=0.5u m=16
vp op out 0
i6 t 0 100n
mp3a t t vdd vdd pch w=6u l=0.5u m=4 stack=4
mp3b oq t vdd vdd pch w=6u l=0.5u m=4 stack=4
vq oq out 0
)",
                                 {},
                                 ".dc vout 0 0.7 1m"});
    if (!found) return found.error();
    const auto low = [&](const char* current) {
        const auto G = found->line("dc", current).slope().absolute();
        return G.where(2 * G.at(0.5));
    };
    const auto resistance = [&](const char* current) { return 1 / std::abs(found->line("dc", current).slope_at(0.35)); };
    out.claim("self-cascode mirror of 100 nA: output from (half of its resistance at 0.5 V)", low("i(va)"), "V");
    out.claim("conventional cascode, a diode on a diode: output from", low("i(vd)"), "V")
        .at_least(low("i(va)"), text + ": the self-cascode \"allows a larger output voltage excursion\"");
    out.claim("what the diodes of the conventional one need", found->line("dc", "v(d)").at(0.35), "V")
        .at_least(0.7, text + ": the self-cascode's advantage at \"similar ... power supplies\"; 0.7 V leave it nothing");
    out.claim("self-cascode: its input, bulks at vss", found->line("dc", "v(c)").at(0.35), "V");
    out.claim("self-cascode: its input, bulks lifted", found->line("dc", "v(a)").at(0.35), "V")
        .at_most(found->line("dc", "v(c)").at(0.35), text + ": \"to decrease the minimum voltage supply requirement\"");
    out.claim("P trapezoid: output resistance at 0.35 V", resistance("i(vp)"), "ohm")
        .at_least(resistance("i(vq)"), text + ": trapezoidal arrays \"to increase the output impedance\", beside the array of 4x4 alone");
    out.claim("the array of 4x4 alone", resistance("i(vq)"), "ohm");
    out.plot("Mirrors of 100 nA", "V_OUT (V)", "I (nA)")
        .add("self-cascode, bulks lifted (fig. 23)", found->line("dc", "i(va)").times(1, 1e9))
        .add("self-cascode, bulks at vss", found->line("dc", "i(vc)").times(1, 1e9))
        .add("conventional cascode", found->line("dc", "i(vd)").times(1, 1e9))
        .add("4x4 alone", found->line("dc", "i(ve)").times(1, 1e9))
        .shape("no figure");
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

/// The loop's gain at 10 Hz and phase margin over the force, with what capacitance the sensor and its wire may have (the netlist has none).
struct Loops {
    static constexpr const char* capacitances[] = {"1f", "10p", "100p"};
    Line gain, margins[3];

    static std::string words(std::size_t k) {
        return k == 0 ? "without capacitance" : fmt::format("with {}F at the sensor", capacitances[k]);
    }
    Result<void> add(double newtons) {
        std::string orders;
        for (std::size_t k = 0; k < 3; ++k)
            orders += fmt::format("xf{0} f{0} vdd vy opened force={1}\nc{0} f{0} 0 {2}\n", k, newtons, capacitances[k]);
        const auto found = found_in({"transducer_loop", {}, orders + ".ac dec 20 10 10meg"});
        if (!found) return found.error();
        gain.x.push_back(newtons), gain.y.push_back(20 * std::log10(found->line("ac", "vm(f0)").at(10)));
        for (std::size_t k = 0; k < 3; ++k) {
            const double f = found->line("ac", fmt::format("vm(f{})", k)).where(1);
            const auto angle = found->line("ac", fmt::format("vp(f{})", k));
            if (f == f) margins[k].x.push_back(newtons), margins[k].y.push_back(angle.at(f) * 180 / std::numbers::pi);
        }
        return {};
    }
};

Result<void> tell_loop(Outcome& out) {
    Loops loops;
    for (const double newtons : {0.02, 0.05, 0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 10.0, 20.0, 40.0})
        if (auto ok = loops.add(newtons); !ok) return ok;
    Plot& margins = out.plot("Phase margin of the transducer's loop", "force (N)", "degrees");
    margins.log_x = true;
    margins.shape("no figure");
    for (std::size_t k = 0; k < 3; ++k) {
        margins.add(Loops::words(k), loops.margins[k]);
        out.claim(fmt::format("least phase margin from 0.02 to 40 N, {}", Loops::words(k)), loops.margins[k].least(), "degrees")
            .at_least(45, "thesis 4.2: a \"negative feedback loop\"; 45 degrees are stated here")
            .if_off(
                "stable, but it rings: the sensor's node is a second pole, as nothing printed compensates it. Nothing is printed of the "
                "sensor's and "
                "its wire's capacitance, and the netlists have none");
    }
    const double within = 20 * std::log10(20);
    out.claim("gain of the loop at 0.2 N", loops.gain.at(0.2), "dB").at_least(within, "V_X within 5 % of V_Y, as in fig22");
    out.claim("gain of the loop at 4 N", loops.gain.at(4), "dB").at_least(within, "V_X within 5 % of V_Y, as in fig22");
    out.claim("gain of the loop at 40 N", loops.gain.at(40), "dB");
    Plot& gain = out.plot("Gain of the loop at 10 Hz", "force (N)", "dB");
    gain.log_x = true;
    gain.add("loop", loops.gain).shape("no figure");
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    double done = 0;
    for (const auto tell : {tell_alone, tell_input_pair, tell_mirrors, tell_supply, tell_loop}) {
        if (auto ok = tell(out); !ok) return ok.error();
        if (auto ok = options.at(done += 0.19); !ok) return ok.error();
    }
    out.note(
        "Nothing of the amplifier but sizes, I_BIASA and words is printed. That its pair is of P is a reading (errata F10a); how it folds "
        "into the N mirror, "
        "too (circuits/parts/transducer.inc).");
    return out;
}

const Study study{"fig23", "The transducer's amplifier, and its loop",
                  "A folded cascode with self-cascode mirrors and lifted bulks: larger ranges of input and output, a lower supply. Thesis "
                  "4.2, fig. 23, table 2",
                  work};

}  // namespace corpuscle::studies::fig23
