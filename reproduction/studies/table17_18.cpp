// Tables 17 and 18: V_Q and I_Q of 1000 chips, with and without the bias generator. A_VT is from table 12 and the process spread is fitted
// to the rows without biasing; the rest is predicted. The study bias-spread shows the sources of the spread.
// V_Q and I_Q are the voltage and the current of an inverter with its output tied to its input.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/histogram.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/arrays.hpp"
#include "reproduction/thesis/bias/bias_chips.hpp"

namespace corpuscle::studies::table17_18 {

using namespace bias_chips;

constexpr const char* divider_reason =
    "half of the variance is V_REF's, from the divider's four transistors; relative to V_REF, V_Q varies as published (bias-spread). No "
    "connection of the divider's bulks removes all of it; it is not known whether table 17's simulation had mismatch in the divider";
constexpr double tolerance = 25;  // %: largest relative error allowed for a standard deviation by mismatch, decided in advance

/// Claim on A_VT (V um) of the card against the mean of the seven arrays of table 12. For each array the variance due to A_IS is subtracted
/// from the published variance, and the rest divided by g_mg/I_D. This ratio and the area are computed from the published g_mg, so that
/// misprints of the columns A and g_mg/I_D (errata U11, U12) have no effect.
void claim_calibration(StudyResult& out, const circuit::Circuit& c) {
    const auto m4a = static_cast<std::size_t>(c.find_element("m4a"));
    const double A_IS = 1e6 * model_parameter(c, m4a, "ais");
    double mean = 0;
    for (const auto& a : published_rectangles) {
        const double variance = 1e-4 * a.sigma * a.sigma * a.g_mg / a.g_by_A;
        mean += std::sqrt(variance - A_IS * A_IS) / (a.g_mg / a.I_D) / static_cast<double>(std::size(published_rectangles));
    }
    out.claim("A_VT of the process card, fitted to table 12 only", 1e6 * model_parameter(c, m4a, "avt"), "V um")
        .published_as(mean, "tables 11 and 12, mean of seven arrays");
}

/// The reason for a deviation of a standard deviation: of V_Q if `voltage`, otherwise of I_Q. `variation` is an index in `variations`.
std::string reason(const InverterCase& row, std::size_t variation, bool voltage) {
    if (row.is_fitted && variation == 2 && voltage)
        return fmt::format(
            "the published rows disagree: {:g} % of process and {:g} % of mismatch give {:.3g} %, not {:g} %; the standard deviation of "
            "1000 chips has an uncertainty of 2.2 %",
            row.V[0].percent, row.V[1].percent, std::hypot(row.V[0].percent, row.V[1].percent), row.V[2].percent);
    if (row.is_fitted) return "A_VT is table 12's; the standard deviation of 1000 chips has an uncertainty of 2.2 %";
    if (voltage && variation == 0) return "published with one digit";
    if (voltage) return divider_reason;
    return "the simulated standard deviation comes mostly from the Early voltage: I_Q follows V_BN (bias-spread). The published one needs "
           "a larger effect or another cause, which is not known; the inferred bulks of fig. 52 are not the cause";
}

/// Claims on the mean and the standard deviation of V_Q or I_Q in one row of the tables.
void claim(StudyResult& out, const InverterCase& row, std::size_t variation, const SampleStatistics& s, bool voltage) {
    const auto& printed = (voltage ? row.V : row.I)[variation];
    const char *symbol = voltage ? "V_Q" : "I_Q", *table = voltage ? "table 17" : "table 18";
    const auto prefix = fmt::format("{}, {}{}: ", row.name, variations[variation].name, row.is_fitted && variation == 0 ? " (fitted)" : "");
    out.claim(prefix + "mean " + symbol, s.mean, voltage ? "V" : "A").published_as(printed.mean, table);
    auto& c = out.claim(prefix + "standard deviation of " + symbol, s.cv_percent(), "%").published_as(printed.percent, table);
    const double error = std::abs(100 * c.deviation());
    if (c.needs_explanation()) c.explain(reason(row, variation, voltage));
    if (variation != 1) return;  // mismatch only is predicted
    auto& tolerance_claim = out.claim(prefix + "relative error of this standard deviation", error, "%")
                                .allow_max(tolerance, "decided in advance, with A_VT of table 12");
    if (tolerance_claim.needs_explanation()) tolerance_claim.explain(divider_reason);
}

/// Statements of E.2 on the tables. I_Q: standard deviations (%) without and with biasing, for each of `variations`.
Result<void> claim_text(StudyResult& out, const circuit::Circuit& generator, const double (&I_Q)[2][3]) {
    out.claim("all: I_Q's standard deviation without biasing over that with biasing", I_Q[0][2] / I_Q[1][2], "times")
        .published_as(10, "E.2: ten times lower");
    out.claim("biasing: contribution of mismatch to the variance of I_Q", 100 * std::pow(I_Q[1][1] / I_Q[1][2], 2), "%")
        .allow_min(90, "E.2: almost exclusively a result of mismatch; nine tenths is our choice");
    out.claim("no biasing, process: standard deviation of I_Q, against the text", I_Q[0][0], "%")
        .published_as(27.2, "E.2's text; table 18 has this value for all and 28.4 % for process: errata I10");
    StudyNetlist larger{"bias", {}, fmt::format(".op\n.mc 1000 {}", variations[1].mc_options)};
    for (const auto& e : generator.elements)
        if (e.letter == 'm') larger.settings.push_back(e.name + "=4x16");
    const auto chips = run_study_variants(larger);
    if (!chips) return chips.error();
    out.claim("arrays of four times the area and the same aspect ratio (4x16): standard deviation of I_Q by mismatch, over that of 2x8",
              sample_statistics(*chips, "i(vis)").cv_percent() / I_Q[1][1], "times")
        .derived_as(0.5, "E.2: reduced by larger arrays; by Pelgrom inversely proportional to the square root of the area");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto circuit = elaborate_study_netlist({"bias"});
    if (!circuit) return circuit.error();
    claim_calibration(out, **circuit);
    double deviations[2][3];  // standard deviations of I_Q, %: [without or with biasing][variation]
    for (const auto& row : inverter_cases) {
        StudyPlot V_plot{fmt::format("V_Q of 1000 chips, {}", row.name), "V_Q (mV)", "chips, in 30 bins", {}};
        StudyPlot I_plot{fmt::format("I_Q of 1000 chips, {}", row.name), "I_Q (nA)", "chips, in 30 bins", {}};
        for (std::size_t k = 0; k < 3; ++k) {
            auto chips = simulate_chips(row.circuit, variations[k]);
            if (!chips) return chips.error();
            const auto V = sample_statistics(*chips, row.voltage), I = sample_statistics(*chips, row.current);
            claim(out, row, k, V, true), claim(out, row, k, I, false);
            V_plot.add(variations[k].name, histogram_of(V.values).scaled(1e3, 1)),
                I_plot.add(variations[k].name, histogram_of(I.values).scaled(1e9, 1));
            deviations[row.is_fitted ? 0 : 1][k] = I.cv_percent();
        }
        out.plots.push_back(std::move(V_plot)), out.plots.push_back(std::move(I_plot));
        if (auto ok = options.report_progress(row.is_fitted ? 0.4 : 0.8); !ok) return ok.error();
    }
    if (auto ok = claim_text(out, **circuit, deviations); !ok) return ok.error();
    return out;
}

const Study study{
    "table17-18", "V_Q and I_Q of 1000 chips",
    "Means and standard deviations for process, mismatch and all, with and without biasing. Thesis E.2, tables 17 and 18 (errata I9, I10)",
    compute};

}  // namespace corpuscle::studies::table17_18
