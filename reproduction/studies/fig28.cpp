// Fig. 28: the transconductor of the current-controlled voltage source (INVB with its output tied to its input), its current and its
// resistance.

#include <fmt/format.h>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/active_load.hpp"

namespace corpuscle::studies::fig28 {

constexpr auto source = "thesis 4.3.1, fig. 28";

/// Input voltage (V) at which the input current is zero, in a process corner.
Result<double> zero_current_voltage_in(const char* corner) {
    const auto found = run_study_netlist({"invb", {fmt::format("corner={}", corner)}, ".dc vin 0.3 0.4 2m"});
    if (!found) return found.error();
    return found->curve("dc", "i(vin)").crossing(0);
}

void add_claims(const ActiveLoad& load, StudyResult& out) {
    out.claim("zero input current at", load.zero_current_voltage, "V").published_as(350e-3, source);
    out.claim("largest resistance", load.max_resistance, "ohm").published_as(413e3, source);
    out.claim("largest resistance at", load.max_resistance_at, "V").published_as(350e-3, source);
    out.claim("linear range from", load.linear_from, "V").published_as(300e-3, source);
    auto& end = out.claim("linear range to", load.linear_to, "V").published_as(500e-3, source);
    for (auto* c = &end - 1; c <= &end; ++c)  // the claims on both ends of the range are adjacent
        if (c->needs_explanation())
            c->explain(
                fmt::format("the thesis does not define the linear range; here it is where the resistance is at most a tenth below its "
                            "largest. The simulated curve is almost symmetric about {:.3g} mV, which a range from 300 to 500 mV is not",
                            1e3 * load.max_resistance_at));
    // of the resistance at v (V) from its largest value
    const auto deviation_percent = [&](double v) { return 100 * (load.resistance.at(v) / load.max_resistance - 1); };
    out.claim("resistance at 300 mV, relative to its largest", deviation_percent(300e-3), "%");
    out.claim("resistance at 500 mV, relative to its largest", deviation_percent(500e-3), "%");
    out.claim("resistance at 200 mV, relative to its largest", deviation_percent(200e-3), "%");
    out.claim_true("outside 300 to 500 mV it is significantly non-linear: the resistance is a fifth lower at 150 and at 550 mV",
                   deviation_percent(150e-3) < -20 && deviation_percent(550e-3) < -20, source);
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto found = run_study_netlist({"invb", {}, ".dc vin 0 0.7 0.5m"});
    if (!found) return found.error();
    const auto load = analyse_load(found->curve("dc", "i(vin)").scaled(1, -1));
    add_claims(load, out);
    for (const char* corner : {"ss", "ff", "sf", "fs"}) {
        const auto rest = zero_current_voltage_in(corner);
        if (!rest) return rest.error();
        out.claim(fmt::format("corner {}: zero input current at", corner), *rest, "V")
            .published_as(350e-3, "thesis 4.3.1: 350 mV even with process variability");
        if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    }
    out.plot("28a, input current over input voltage", "V_IN (mV)", "current (nA)")
        .describe_published("zero at 350 mV, linear from 300 to 500 mV, significantly non-linear outside")
        .add("into INVB as a load", load.current.scaled(1e3, 1e9));
    const auto inside = load.resistance.between(0.1, 0.6);
    out.plot("28b, resistance over input voltage", "V_IN (mV)", "resistance (kohm)")
        .describe_published("about 413 kohm at its maximum, at 350 mV")
        .add("INVB as a load", inside.scaled(1e3, 1e-3))
        .points("published", {{350}, {413}});
    return out;
}

const Study study{"fig28", "The transconductor of the current-controlled voltage source",
                  "No current at half the supply, 413 kohm at 350 mV, linear from 300 to 500 mV. Thesis 4.3.1, fig. 28", compute};

}  // namespace corpuscle::studies::fig28
