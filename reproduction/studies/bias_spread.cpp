// The contributions of the transistors' mismatch and of the process to the spread of V_Q and I_Q of the bias generator.
// Symbols. V_BN and V_BP are the body voltages that the generator sets, V_REF is half the supply, V_Q and I_Q are voltage and current of
// the replica, an inverter with its output tied to its input.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/bias/bias_chips.hpp"

namespace corpuscle::studies::bias_spread {

using namespace bias_chips;

constexpr double published_percent = 0.19;  // of V_Q with biasing, mismatch only: table 17

/// Variance of V_Q (V^2) and I_Q (A^2) caused by the mismatch of a group of devices, to first order: the sum over the threshold and the
/// current of each device, shifted one at a time.
struct Variance {
    double V = 0, I = 0;
};
/// Devices of the generator whose contributions are added.
struct Group {
    const char* name;
    std::vector<const char*> devices;
    Variance variance = {};
};

/// Adds the variance due to each device of the group. `nominal` is the generator without mismatch.
Result<void> add_variance(Group& group, const circuit::Circuit& c, const NetlistResult& nominal) {
    constexpr double threshold_shift = 1e-4, current_change = 1e-3;  // V; fraction: small shifts that give the sensitivities
    for (const char* device : group.devices) {
        const auto k = static_cast<std::size_t>(c.find_element(device));
        const double sqrt_area = std::sqrt(channel_area(c.elements[k]));
        // standard deviations of the mismatch, as multiples of the two shifts
        const double threshold_sigma = model_parameter(c, k, "avt") / sqrt_area / threshold_shift,
                     current_sigma = model_parameter(c, k, "ais") / sqrt_area / current_change;
        for (const auto& [setting, sigma] : {std::pair{fmt::format("{}.delvto={}", device, threshold_shift), threshold_sigma},
                                             {fmt::format("{}.mulu0={}", device, 1 + current_change), current_sigma}}) {
            const auto shifted = TRY(run_study_netlist({"bias", {setting}, ".op"}));
            group.variance.V += std::pow((shifted.operating_point("v(q)") - nominal.operating_point("v(q)")) * sigma, 2);
            group.variance.I += std::pow((shifted.operating_point("i(vis)") - nominal.operating_point("i(vis)")) * sigma, 2);
        }
    }
    return {};
}

Result<void> claim_contributions(StudyResult& out, const circuit::Circuit& c) {
    const auto nominal = TRY(run_study_netlist({"bias", {}, ".op"}));
    Group groups[] = {{"divider M1A-M2B", {"m1a", "m2a", "m1b", "m2b"}},
                      {"current mirror M3A, M3B", {"m3a", "m3b"}},
                      {"M4A, which sets BN", {"m4a"}},
                      {"M4B and M5A, which set BP", {"m4b", "m5a"}},
                      {"replica M4C, M5B", {"m4c", "m5b"}}};
    Variance total;
    for (auto& group : groups) {
        TRY(add_variance(group, c, nominal));
        total.V += group.variance.V, total.I += group.variance.I;
    }
    out.claim("biasing, mismatch to first order: standard deviation of V_Q", 100 * std::sqrt(total.V) / nominal.operating_point("v(q)"),
              "%");
    out.claim("biasing, mismatch to first order: standard deviation of I_Q", 100 * std::sqrt(total.I) / nominal.operating_point("i(vis)"),
              "%");
    for (const auto& group : groups) {
        out.claim(fmt::format("contribution to the variance of V_Q, {}", group.name), 100 * group.variance.V / total.V, "%");
        out.claim(fmt::format("contribution to the variance of I_Q, {}", group.name), 100 * group.variance.I / total.I, "%");
    }
    return {};
}

/// The spread of V_Q with the divider's bulks connected in other ways; fig. 52 does not show them. `as_built`: chips with mismatch only.
Result<void> claim_bulk_connections(StudyResult& out, const Chips& as_built) {
    const auto add_claim = [&](const std::string& connection, const Chips& chips) {
        auto& c = out.claim(fmt::format("biasing, mismatch, {}: standard deviation of V_Q", connection),
                            sample_statistics(chips, "v(q)").cv_percent(), "%")
                      .published_as(published_percent, "table 17, by another reading of fig. 52")
                      .of_kind(ClaimKind::misprint);
        if (c.needs_explanation())
            c.explain(
                "closer to the published value than the circuit as built. Fig. 52 does not show the bulks of the divider, and the divider "
                "adds spread for every bulk connection that the figure allows");
    };
    const double mean = sample_statistics(as_built, "v(q)").mean;
    out.claim("biasing, mismatch, each bulk of the divider at its source, as built: standard deviation of V_Q relative to V_REF",
              100 * sample_statistics(as_built, "v(q,ref)").standard_deviation / mean, "%")
        .published_as(published_percent, "table 17, relative to V_REF; as in table17-18")
        .of_kind(ClaimKind::identity);
    out.claim("biasing, mismatch, as built: standard deviation of V_REF", sample_statistics(as_built, "v(ref)").cv_percent(), "%");
    const auto at_rails = substitute_in_embedded_text(
        "circuits/bias.cir", {{"m2a top top ref ref", "m2a top top ref 0"}, {"m1b low low ref ref", "m1b low low ref vdd"}});
    const auto lifted = substitute_in_embedded_text("circuits/bias.cir", {{"m1a top top vdd vdd", "m1a top top vdd bp"},
                                                                          {"m2a top top ref ref", "m2a top top ref bn"},
                                                                          {"m1b low low ref ref", "m1b low low ref bp"},
                                                                          {"m2b low low 0   0  ", "m2b low low 0   bn "}});
    for (const auto& [connection, text] :
         {std::pair{"divider's bulks at the rails", &at_rails}, {"divider's bulks at BP and BN", &lifted}}) {
        if (!*text) return text->error();
        const auto chips = TRY(simulate_chips(**text, mismatch_only));
        add_claim(connection, chips);
    }
    return {};
}

/// Relation of I_Q and V_BN from chip to chip, with process variation only.
void claim_early_voltage(StudyResult& out, const Chips& chips) {
    StudyCurve points;  // ln(I_Q / 1 A) over V_BN, one point for each chip, in any order
    for (const auto& chip : chips)
        points.x.push_back(chip.operating_point("v(bn)")), points.y.push_back(std::log(chip.operating_point("i(vis)")));
    const auto fit = points.fit_line();
    const auto V_BN = sample_statistics(points.x), ln_I_Q = sample_statistics(points.y);
    out.claim("biasing, process: standard deviation of V_BN", V_BN.standard_deviation, "V");
    out.claim("biasing, process: Early voltage with which I_Q falls as V_BN rises", -1 / fit.slope, "V");
    out.claim("biasing, process: contribution of this fall to the variance of I_Q",
              100 * std::pow(fit.slope * V_BN.standard_deviation / ln_I_Q.standard_deviation, 2), "%");
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto circuit = TRY(elaborate_study_netlist({"bias"}));
    const auto process = simulate_chips("bias", process_only), mismatch = simulate_chips("bias", mismatch_only);
    TRY(check_all(process, mismatch));
    TRY(claim_bulk_connections(out, *mismatch));
    TRY(options.report_progress(0.5));
    TRY(claim_contributions(out, *circuit));
    claim_early_voltage(out, *process);
    return out;
}

const Study study{"bias-spread", "Sources of the bias generator's spread",
                  "Which transistors cause the spread of V_Q and I_Q in tables 17 and 18, and what does fig. 52 leave open? Thesis E.2",
                  ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::bias_spread
