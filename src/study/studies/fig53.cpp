// The bias generator along its current: fig. 53.

#include <fmt/format.h>
#include <cmath>

#include "study/deck.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::fig53 {

constexpr double half_supply = 0.35, near = 0.1, apart = 5e-3;  // V; I_Q within a tenth of I_BIAS and V_Q within 5 mV: it works

/// From where to where the replica's voltage and current are as they should be.
struct Works {
    double from = Claim::none, to = Claim::none;
    Works(const Line& I_Q, const Line& V_Q) {
        for (std::size_t k = 0; k < I_Q.x.size(); ++k) {
            if (std::abs(I_Q.y[k] / I_Q.x[k] - 1) > near || std::abs(V_Q.y[k] - half_supply) > apart) continue;
            if (std::isnan(from)) from = I_Q.x[k];
            to = I_Q.x[k];
        }
    }
};

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const std::string source = "thesis E.2, fig. 53";
    Plot voltages{"V_BN and V_BP along I_BIAS, typical", "I_BIAS (nA)", "V", {}, true};
    Plot currents{"I_Q along I_BIAS", "I_BIAS (nA)", "I_Q (nA)", {}, true, true};
    double highest_low = 0, lowest_high = 1;
    for (const char* corner : {"tt", "ss", "ff"}) {
        const auto found = found_in({"bias", {fmt::format("corner={}", corner)}, ".dc ibias 10n 3u 2n"});
        if (!found) return found.error();
        const auto I_Q = found->line("dc", "i(vis)");
        const Works works(I_Q, found->line("dc", "v(q)"));
        highest_low = std::max(highest_low, works.from), lowest_high = std::min(lowest_high, works.to);
        currents.add(corner, I_Q.times(1e9, 1e9));
        if (corner == std::string_view("tt")) {
            const std::string why =
                "I_Q within a tenth of I_BIAS and V_Q within 5 mV of half the supply here; a range is read off a figure there";
            out.claim("typical: works from", works.from, "A").printed_as(100e-9, source).because(why);
            out.claim("typical: works to", works.to, "A")
                .printed_as(2e-6, source)
                .because("the junctions of the bulks, forward biased by almost 0.6 V, take the rest of the current");
            const auto V_BN = found->line("dc", "v(bn)");
            out.claim("typical: V_BN at 100 nA", V_BN.at(100e-9), "V")
                .printed_as(600e-3, source)
                .because(
                    "body bias acts on the threshold alone here; V_T0 is set so that the unbiased inverter carries 17.5 nA as printed");
            voltages.add("V_BN", V_BN.times(1e9, 1)).add("V_BP", found->line("dc", "v(bp)").times(1e9, 1));
        }
        if (auto ok = options.at(1.0 / 3); !ok) return ok.error();
    }
    out.claim("corners: works from", highest_low, "A").printed_as(100e-9, source);
    out.claim("corners: works to", lowest_high, "A")
        .printed_as(700e-9, source)
        .because("as typically, and corners of ours are three deviations");
    currents.add("I_Q = I_BIAS", {{10, 3000}, {10, 3000}});
    out.plots = {voltages.shape("V_BN from 100 to 600 mV over 100 nA to 2 uA"), currents.shape("three corners, each with its own range")};
    return out;
}

const Study study{"fig53", "The bias generator along its current",
                  "It works from 100 nA to 2 uA typically, from 100 to 700 nA in corners. Thesis E.2, fig. 53", work};

}  // namespace corpuscle::studies::fig53
