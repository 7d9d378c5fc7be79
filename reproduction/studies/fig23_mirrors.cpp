// The mirrors of fig. 23's amplifier compared with alternatives: a conventional cascode, bulks without bias, and a 4x4
// array instead of the trapezoidal one.

#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::fig23_mirrors {

const std::string source = "thesis 4.2, fig. 23";

/// Simulates mirrors with an input current of 100 nA each. The output range of a mirror begins at the output voltage at which its output
/// resistance is half of that at 0.5 V.
Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    const auto found = run_study_netlist({R"(Mirrors of fig. 23 and alternatives
.lib '../process/tsmc180.lib' tt
vdd vdd 0 0.7
vout out 0 0.35
* self-cascode, bulks forward biased as in fig. 23
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
* the conventional cascode, two stacked diodes, with a supply high enough for them
i3 0 d 100n
md5a d d e 0 nch w=1.5u l=0.5u m=16
md4a e e 0 0 nch w=1.5u l=0.5u m=4 stack=4
vd out od 0
md5b od d l 0 nch w=1.5u l=0.5u m=16
md4b l e 0 0 nch w=1.5u l=0.5u m=4 stack=4
* the lower array only
i4 vdd p 100n
me4a p p 0 0 nch w=1.5u l=0.5u m=4 stack=4
ve out oe 0
me4b oe p 0 0 nch w=1.5u l=0.5u m=4 stack=4
* P: trapezoid as in table 2, and its upper array only
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
    const auto output_from = [&](const char* current) {
        const auto G = found->curve("dc", current).slope().absolute();
        return G.crossing(2 * G.at(0.5));
    };
    const auto resistance = [&](const char* current) { return 1 / std::abs(found->curve("dc", current).slope_at(0.35)); };
    out.claim("self-cascode mirror of 100 nA: output from (half of its resistance at 0.5 V)", output_from("i(va)"), "V");
    out.claim("conventional cascode, two stacked diodes: output from (half of its resistance at 0.5 V)", output_from("i(vd)"), "V")
        .allow_min(output_from("i(va)"), source + ": the self-cascode \"allows a larger output voltage excursion\"");
    // output conductance of the self-cascode over that of the conventional cascode
    StudyCurve ratio = found->curve("dc", "i(va)").slope().absolute();
    const auto conventional = found->curve("dc", "i(vd)").slope().absolute();
    for (std::size_t k = 0; k < ratio.x.size(); ++k) ratio.y[k] /= conventional.y[k];
    out.claim("the conventional cascode has a higher resistance than the self-cascode from", ratio.crossing(1, 0.2), "V");
    out.claim("voltage of the conventional cascode's diodes", found->curve("dc", "v(d)").at(0.35), "V")
        .allow_min(0.7, source + ": the self-cascode's advantage at \"similar ... power supplies\"; at 0.7 V no output range would remain");
    out.claim("self-cascode: input voltage, bulks at vss", found->curve("dc", "v(c)").at(0.35), "V");
    out.claim("self-cascode: input voltage, bulks forward biased", found->curve("dc", "v(a)").at(0.35), "V")
        .allow_max(found->curve("dc", "v(c)").at(0.35), source + ": \"to decrease the minimum voltage supply requirement\"");
    out.claim("P trapezoid: output resistance at 0.35 V", resistance("i(vp)"), "ohm")
        .allow_min(resistance("i(vq)"), source + ": trapezoidal arrays \"to increase the output impedance\", compared with the 4x4 array");
    out.claim("P 4x4 array without the trapezoid: output resistance at 0.35 V", resistance("i(vq)"), "ohm");
    StudyPlot& plot = out.plot("Output resistance of N mirrors of 100 nA", "V_OUT (V)", "Mohm");
    plot.log_y = true;
    for (const auto& [name, current] : {std::pair{"self-cascode, bulks forward biased (fig. 23)", "i(va)"},
                                        {"self-cascode, bulks at vss", "i(vc)"},
                                        {"conventional cascode", "i(vd)"},
                                        {"4x4 array", "i(ve)"}}) {
        auto R = found->curve("dc", current).slope().absolute().scaled(1, 1e6);
        for (double& v : R.y) v = 1 / v;
        plot.add(name, std::move(R));
    }
    return out;
}

const Study study{"fig23-mirrors", "The mirrors of the transducer's amplifier",
                  "Self-cascode mirrors allow a larger output range than conventional cascodes, trapezoidal arrays raise the output "
                  "impedance, forward-biased bulks lower the supply. Thesis 4.2, fig. 23, table 2",
                  compute};

}  // namespace corpuscle::studies::fig23_mirrors
