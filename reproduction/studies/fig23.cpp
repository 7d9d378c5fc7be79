// Fig. 23 and table 2: the transducer's amplifier, with and without the forward-biased bulks of 4.2. fig23_mirrors.cpp has its mirrors,
// transducer_loop.cpp its feedback loop.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::fig23 {

using Changes = std::vector<std::pair<std::string, std::string>>;
const std::string source = "thesis 4.2, fig. 23";

// Changes of circuits/parts/transducer.inc, as pairs of an old and a new text: the bulks of some transistors are connected elsewhere.
const Changes pair_at_supply = {{" t b3 pch", " t vdd pch"}, {" t b4 pch", " t vdd pch"}};
const Changes pair_at_source = {{" t b3 pch", " t t pch"}, {" t b4 pch", " t t pch"}};
const Changes n_bulks_at_vss = {{" 0 b5 nch", " 0 0 nch"}, {" f1 b6 nch", " f1 0 nch"}, {" f2 b6 nch", " f2 0 nch"}};
const Changes p_bulks_at_supply = {{" vdd b1 pch", " vdd vdd pch"}, {" b2 pch w=6u l=0.5u m=16", " vdd pch w=6u l=0.5u m=16"}};
/// Without M_3C and M_3D: the input pair's bulks at vss, each through a source that measures the bulk current.
const Changes bulks_at_vss = {{"mp3c plus  0 b3 b3 pch w=6u l=0.5u m=16", "vb3 b3 0 0"},
                              {"mp3d minus 0 b4 b4 pch w=6u l=0.5u m=16", "vb4 b4 0 0"}};

/// circuits/amplifier.cir with these changes in its subcircuits.
Result<NetlistResult> simulate_amplifier(const Changes& changes, const std::string& directives = "") {
    const auto parts = substitute_in_embedded_text("circuits/parts/transducer.inc", changes);
    if (!parts) return parts.error();
    auto netlist = substitute_in_embedded_text("circuits/amplifier.cir", {{".include 'parts/transducer.inc'", *parts}});
    if (!netlist) return netlist.error();
    return run_study_netlist({std::move(*netlist), {}, directives});
}

/// Transconductance (S) over the common-mode input (V), from the pair of cells in circuits/amplifier.cir with inputs of +0.1 mV and -0.1
/// mV.
Result<StudyCurve> transconductance(const Changes& changes) {
    const auto found = simulate_amplifier(changes, ".dc vs 0 0.7 2m");
    if (!found) return found.error();
    return found->curve("dc", "par('(i(v1)-i(v2))/0.2m')");
}
/// Common-mode input (V) above 0.1 V at which the transconductance is half of that at 0.1 V.
double common_mode_limit(const StudyCurve& g_m) { return g_m.crossing(g_m.at(0.1) / 2, 0.1); }

/// Gain, bandwidth and ranges of the amplifier without the sensor loop.
Result<void> report_amplifier(StudyResult& out) {
    const auto found = simulate_amplifier({});
    if (!found) return found.error();
    const auto supply =
        run_study_netlist({"One amplifier\n.lib '../process/tsmc180.lib' tt\n.include 'parts/transducer.inc'\nvdd vdd 0 0.7\nvi vdd top 0\n"
                           "vp plus 0 0.1\niba pg 0 100n\nxamp plus plus out pg top amplifier\nvo out 0 0.35\n",
                           {},
                           ".op"});
    if (!supply) return supply.error();
    const double I = supply->operating_point("i(vi)");
    out.claim("gain with the transducer's M_1 to M_3 as the load", 20 * std::log10(found->number("gain")), "dB");
    out.claim("unity-gain frequency with this load", found->number("f_unity"), "Hz");
    out.claim("phase margin with this load at unity feedback", found->number("margin"), "degrees")
        .allow_min(45, "not published; the bound is our choice");
    out.claim("input transconductance at V_Y", found->number("g_m"), "S");
    out.claim("input offset", found->number("offset"), "V");
    out.claim("supply current of the amplifier", I, "A").derived_as(500e-9, "five trapezoidal arrays of I_BIASA, fig. 23 and table 2");
    out.claim("power of the amplifier at 0.7 V", 0.7 * I, "W");
    const auto g_m = found->curve("dc", "par('(i(v1)-i(v2))/0.2m')");
    StudyCurve gain = found->curve("dc", "i(v3)").slope().absolute();
    for (double& g : gain.y) g = g_m.at(0.1) / g;
    const double half = gain.max() / 2;
    out.claim("common-mode input up to (half of the transconductance)", common_mode_limit(g_m), "V")
        .allow_min(0.1, "V_Y, which must be in the amplifier's input range (errata F12)");
    out.claim("output range from (half of the largest gain)", gain.crossing(half), "V");
    out.claim("output range to (half of the largest gain)", gain.crossing(half, gain.x_of_max()), "V")
        .allow_min(525e-3, "thesis 4.2, fig. 24c: the largest V_Z")
        .explain_if_needed("half of the largest gain is our bound; less gain is enough for the loop (study transducer-loop)");
    out.claim("gain at an output voltage of 525 mV", 20 * std::log10(gain.at(525e-3)), "dB");
    out.plot("Gain over the output voltage", "V_Z (V)", "gain").add("g_m over the output conductance", gain);
    return {};
}

/// The effect of the input pair's bulk connection on the common-mode range, and the bulk current.
Result<void> report_input_pair(StudyResult& out) {
    const auto lifted = transconductance({}), at_supply = transconductance(pair_at_supply), at_source = transconductance(pair_at_source);
    for (const auto* r : {&lifted, &at_supply, &at_source})
        if (!*r) return r->error();
    out.claim("common-mode input up to, bulks of the pair at the supply", common_mode_limit(*at_supply), "V");
    out.claim("common-mode input up to, bulks of the pair at the source", common_mode_limit(*at_source), "V");
    out.claim("increase of the common-mode range by the biased bulks, compared with bulks at the supply",
              common_mode_limit(*lifted) - common_mode_limit(*at_supply), "V")
        .allow_min(0, source + ": \"to increase the OTA common-mode input voltage excursion\"");
    out.plot("Transconductance over the common mode", "V (both inputs)", "g_m (uS)")
        .add("fig. 23: bulks biased by M_3C, D", lifted->scaled(1, 1e6))
        .add("bulks at the source", at_source->scaled(1, 1e6))
        .add("bulks at the supply", at_supply->scaled(1, 1e6));
    const auto bulks = simulate_amplifier(bulks_at_vss, ".dc vs 0 0.7 2m"),
               held = simulate_amplifier({}, ".save v(x3.b3) v(x3.t) i(vplus) i(vs)\n.dc vs 0 0.7 2m");
    if (!bulks) return bulks.error();
    if (!held) return held.error();
    const auto free_current = bulks->curve("dc", "i(x1.vb3)").absolute();
    const auto limited = run_study_netlist(
        {"One amplifier\n.lib '../process/tsmc180.lib' tt\n.include 'parts/transducer.inc'\nvdd vdd 0 0.7\nvp plus 0 0.1\n"
         "vm minus plus 0\niba pg 0 100n\nxamp plus minus out pg vdd amplifier\nvo out 0 0.35\n",
         {},
         ".dc vp 0 0.7 2m"});
    if (!limited) return limited.error();
    const auto limited_current = limited->curve("dc", "i(vm)").absolute();
    out.claim("bulk current with both inputs at 0.4 V, bulk directly at vss", free_current.at(0.4), "A");
    out.claim("bulk current with both inputs at 0.4 V, limited by M_3C, D; it flows out of the input", limited_current.at(0.4), "A")
        .allow_max(free_current.at(0.4), source + ": M_3C, D limit the parasitic substrate current");
    out.claim("bulk current with both inputs at V_Y, limited by M_3C, D", limited_current.at(0.1), "A");
    return {};
}

/// Supply voltages, V.
struct Supplies {
    double amplifier;   ///< at which its transconductance is half of that at 0.7 V, with inputs at V_Y and output at half the supply
    double diode;       ///< voltage across I_BIASA's diode
    double transducer;  ///< its lowest supply at 0.2 N
};
/// With these changes in the amplifier.
Result<Supplies> find_supplies(const Changes& changes) {
    const TransducerCell cell{"t", improved_cell()};
    const auto parts = substitute_in_embedded_text("circuits/parts/transducer.inc", changes);
    if (!parts) return parts.error();
    const auto found =
        run_study_netlist({fmt::format("Two amplifiers, 0.1 mV apart either way\n.lib '../process/tsmc180.lib' tt\n{}\nvdd vdd 0 0.7\n"
                                       "vs s 0 0.1\nvup up s 50u\nvdown s down 50u\nib1 pg1 0 100n\nx1 up down o1 pg1 vdd amplifier\n"
                                       "v1 o1 half 0\nib2 pg2 0 100n\nx2 down up o2 pg2 vdd amplifier\nv2 o2 half 0\n"
                                       "ehalf half 0 vdd 0 0.5\n",
                                       *parts),
                           {},
                           ".dc vdd 0.25 0.7 5m"});
    const auto transducer = find_lowest_supplies({&cell, 1}, 0.2, {}, *parts);
    if (!found) return found.error();
    if (!transducer) return transducer.error();
    const auto g_m = found->curve("dc", "par('(i(v1)-i(v2))/0.2m')"), diode = found->curve("dc", "v(vdd,pg1)");
    return Supplies{g_m.crossing(g_m.at(0.7) / 2), diode.at(0.7), transducer->front()};
}

/// The effect of the mirrors' bulk connections on the lowest supplies.
Result<void> report_supply(StudyResult& out) {
    const auto lifted = find_supplies({}), n_at_vss = find_supplies(n_bulks_at_vss), p_at_supply = find_supplies(p_bulks_at_supply);
    for (const auto* r : {&lifted, &n_at_vss, &p_at_supply})
        if (!*r) return r->error();
    const std::string lower = source + ": forward body bias in the mirrors \"to decrease the minimum voltage supply requirement\"";
    out.claim("lowest supply of the amplifier", lifted->amplifier, "V");
    out.claim("lowest supply of the amplifier, N mirrors' bulks at vss", n_at_vss->amplifier, "V").allow_min(lifted->amplifier, lower);
    out.claim("voltage of I_BIASA's diode", lifted->diode, "V");
    out.claim("voltage of I_BIASA's diode, P mirrors' bulks at the supply", p_at_supply->diode, "V").allow_min(lifted->diode, lower);
    out.claim("lowest supply of the transducer at 0.2 N", lifted->transducer, "V");
    out.claim("lowest supply of the transducer at 0.2 N, N mirrors' bulks at vss", n_at_vss->transducer, "V")
        .allow_min(lifted->transducer, lower)
        .explain_if_needed(
            "V_Z limits the supply, not the mirrors: at this supply both branches have too little voltage. With the bulks at vss the end "
            "of the left branch is about as high as V_Z, so both branches lack the same voltage and stay matched");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    double done = 0;
    for (const auto report : {report_amplifier, report_input_pair, report_supply}) {
        if (auto ok = report(out); !ok) return ok.error();
        if (auto ok = options.report_progress(done += 0.3); !ok) return ok.error();
    }
    out.note(
        "The thesis gives only sizes, I_BIASA and text for the amplifier. That its pair is PMOS (errata F10a) and how it folds into the N "
        "mirror are our interpretation (circuits/parts/transducer.inc).");
    return out;
}

const Study study{"fig23", "The transducer's amplifier",
                  "A folded cascode with self-cascode mirrors and forward-biased bulks: larger ranges of input and output, a lower supply. "
                  "Thesis 4.2, fig. 23, table 2",
                  compute};

}  // namespace corpuscle::studies::fig23
