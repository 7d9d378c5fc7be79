// The transconductor of the current-controlled voltage source, INVB tied to itself: its curve and its resistance, fig. 28.

#include <fmt/format.h>

#include "study/deck.hpp"
#include "study/studies.hpp"
#include "study/thesis/load.hpp"

namespace corpuscle::studies::fig28 {

constexpr auto source = "thesis 4.3.1, fig. 28";

/// Where nothing flows into it, in a corner.
Result<double> rest_in(const char* corner) {
    const auto found = found_in({"invb", {fmt::format("corner={}", corner)}, ".dc vin 0.3 0.4 2m"});
    if (!found) return found.error();
    return found->line("dc", "i(vin)").where(0);
}

void tell(const Load& load, Outcome& out) {
    out.claim("nothing flows in at", load.rest, "V").printed_as(350e-3, source);
    out.claim("largest resistance", load.most, "ohm").printed_as(413e3, source);
    out.claim("it is largest at", load.at, "V").printed_as(350e-3, source);
    out.claim("straight from", load.from, "V").printed_as(300e-3, source);
    auto& end = out.claim("straight to", load.to, "V").printed_as(500e-3, source);
    for (auto* c = &end - 1; c <= &end; ++c)
        if (c->needs_reason())
            c->because(
                fmt::format("straight is here: at most a tenth below the largest resistance, a share that is not printed; ours is all "
                            "but symmetric about {:.3g} mV, and so is no range that ends at 300 and 500 mV",
                            1e3 * load.at));
    const auto share = [&](double v) { return 100 * (load.resistance.at(v) / load.most - 1); };
    out.claim("resistance at 300 mV, beside its largest", share(300e-3), "%");
    out.claim("... at 500 mV", share(500e-3), "%");
    out.claim("... at 200 mV", share(200e-3), "%");
    out.finds("outside 300 to 500 mV it is significantly non-linear: a fifth of the resistance is lost at 150 and at 550 mV",
              share(150e-3) < -20 && share(550e-3) < -20, source);
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto found = found_in({"invb", {}, ".dc vin 0 0.7 0.5m"});
    if (!found) return found.error();
    const auto load = load_of(found->line("dc", "i(vin)").times(1, -1));
    tell(load, out);
    for (const char* corner : {"ss", "ff", "sf", "fs"}) {
        const auto rest = rest_in(corner);
        if (!rest) return rest.error();
        out.claim(fmt::format("{}: nothing flows in at", corner), *rest, "V")
            .printed_as(350e-3, "thesis 4.3.1: even with process variability");
        if (auto ok = options.at(0.5); !ok) return ok.error();
    }
    out.plot("28a, input current over input voltage", "V_IN (mV)", "current (nA)")
        .shape("zero at 350 mV, straight from 300 to 500 mV, significantly non-linear outside")
        .add("into INVB as a load", load.current.times(1e3, 1e9));
    const auto inside = load.resistance.between(0.1, 0.6);
    out.plot("28b, resistance over input voltage", "V_IN (mV)", "resistance (kohm)")
        .shape("about 413 kohm at its maximum, at 350 mV")
        .add("INVB as a load", inside.times(1e3, 1e-3))
        .points("printed", {{350}, {413}});
    return out;
}

const Study study{"fig28", "The transconductor of the current-controlled voltage source",
                  "No current at half the supply, 413 kohm at 350 mV, linear from 300 to 500 mV. Thesis 4.3.1, fig. 28", work};

}  // namespace corpuscle::studies::fig28
