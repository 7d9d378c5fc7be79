// Whose mismatch and whose process it is that V_Q and I_Q of the bias generator spread by.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/bias_chips.hpp"

namespace corpuscle::studies::bias_spread {

using namespace bias_chips;

/// What of the power of V_Q and I_Q is a group's, to first order: each device's threshold and current shifted alone.
struct Shares {
    double V = 0, I = 0;
};
struct Group {
    const char* name;
    std::vector<const char*> devices;
    Shares power = {};
};

Result<void> add_power(Group& group, const circuit::Circuit& c, const Found& rest) {
    constexpr double threshold = 1e-4, current = 1e-3;  // V; of it
    for (const char* device : group.devices) {
        const auto k = static_cast<std::size_t>(c.element(device));
        const double side = std::sqrt(area(c.elements[k]));
        const double by_V = card(c, k, "avt") / side / threshold, by_I = card(c, k, "ais") / side / current;
        for (const auto& [setting, deviations] :
             {std::pair{fmt::format("{}.delvto={}", device, threshold), by_V}, {fmt::format("{}.mulu0={}", device, 1 + current), by_I}}) {
            const auto shifted = found_in({"bias", {setting}, ".op"});
            if (!shifted) return shifted.error();
            group.power.V += std::pow((shifted->at_rest("v(q)") - rest.at_rest("v(q)")) * deviations, 2);
            group.power.I += std::pow((shifted->at_rest("i(vis)") - rest.at_rest("i(vis)")) * deviations, 2);
        }
    }
    return {};
}

Result<void> claim_shares(Outcome& out, const circuit::Circuit& c) {
    const auto rest = found_in({"bias", {}, ".op"});
    if (!rest) return rest.error();
    Group groups[] = {{"divider M1A-M2B", {"m1a", "m2a", "m1b", "m2b"}},
                      {"current mirror M3A, M3B", {"m3a", "m3b"}},
                      {"M4A, which sets BN", {"m4a"}},
                      {"M4B and M5A, which set BP", {"m4b", "m5a"}},
                      {"replica M4C, M5B", {"m4c", "m5b"}}};
    Shares all;
    for (auto& group : groups) {
        if (auto ok = add_power(group, c, *rest); !ok) return ok;
        all.V += group.power.V, all.I += group.power.I;
    }
    out.claim("biasing, mismatch to first order: deviation of V_Q", 100 * std::sqrt(all.V) / rest->at_rest("v(q)"), "%");
    out.claim("biasing, mismatch to first order: deviation of I_Q", 100 * std::sqrt(all.I) / rest->at_rest("i(vis)"), "%");
    for (const auto& group : groups) {
        out.claim(fmt::format("its power in V_Q, {}", group.name), 100 * group.power.V / all.V, "%");
        out.claim(fmt::format("its power in I_Q, {}", group.name), 100 * group.power.I / all.I, "%");
    }
    return {};
}

/// The generator with the bulks of the divider elsewhere, too, which fig. 52 does not print.
Result<void> claim_readings(Outcome& out, const Chips& own) {
    const auto say = [&](const std::string& reading, const Chips& chips) {
        auto& c = out.claim(fmt::format("biasing, mismatch, {}: deviation of V_Q", reading), spread_of(chips, "v(q)").percent(), "%")
                      .printed_as(rows[1].V[1].spread, "table 17");
        if (c.needs_reason())
            c.because("nearer than as built; the divider spreads in every reading of fig. 52, which does not print its bulks");
    };
    const double mean = spread_of(own, "v(q)").mean;
    out.claim("biasing, mismatch, each bulk of the divider at its source, as built: deviation of V_Q against V_REF",
              100 * spread_of(own, "v(q,ref)").deviation / mean, "%")
        .printed_as(rows[1].V[1].spread, "table 17, if it is against V_REF");
    out.claim("and of V_REF itself", spread_of(own, "v(ref)").percent(), "%");
    const auto at_rails =
        changed_text("circuits/bias.cir", {{"m2a top top ref ref", "m2a top top ref 0"}, {"m1b low low ref ref", "m1b low low ref vdd"}});
    const auto lifted = changed_text("circuits/bias.cir", {{"m1a top top vdd vdd", "m1a top top vdd bp"},
                                                           {"m2a top top ref ref", "m2a top top ref bn"},
                                                           {"m1b low low ref ref", "m1b low low ref bp"},
                                                           {"m2b low low 0   0  ", "m2b low low 0   bn "}});
    for (const auto& [reading, text] : {std::pair{"divider's bulks at the rails", &at_rails}, {"divider's bulks at BP and BN", &lifted}}) {
        if (!*text) return text->error();
        const auto chips = chips_of(**text, ways[1]);
        if (!chips) return chips.error();
        say(reading, *chips);
    }
    return {};
}

/// How I_Q goes with V_BN from chip to chip, where the process alone differs.
void claim_early(Outcome& out, const Chips& chips) {
    Line points;
    for (const auto& chip : chips) points.x.push_back(chip.at_rest("v(bn)")), points.y.push_back(std::log(chip.at_rest("i(vis)")));
    const auto fit = points.straight();
    const auto V_BN = spread_of(points.x), I_Q = spread_of(points.y);
    out.claim("biasing, process: deviation of V_BN", V_BN.deviation, "V");
    out.claim("I_Q falls as V_BN rises, as with an Early voltage of", -1 / fit.slope, "V");
    out.claim("that makes of I_Q's power", 100 * std::pow(fit.slope * V_BN.deviation / I_Q.deviation, 2), "%");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto circuit = circuit_of({"bias"});
    if (!circuit) return circuit.error();
    const auto process = chips_of("bias", ways[0]), mismatch = chips_of("bias", ways[1]);
    if (!process) return process.error();
    if (!mismatch) return mismatch.error();
    if (auto ok = claim_readings(out, *mismatch); !ok) return ok.error();
    if (auto ok = options.at(0.5); !ok) return ok.error();
    if (auto ok = claim_shares(out, **circuit); !ok) return ok.error();
    claim_early(out, *process);
    return out;
}

const Study study{"bias-spread", "Whose spread it is that the bias generator has",
                  "Which transistors make V_Q and I_Q of tables 17 and 18 spread, and what fig. 52 leaves open? Thesis E.2", work};

}  // namespace corpuscle::studies::bias_spread
