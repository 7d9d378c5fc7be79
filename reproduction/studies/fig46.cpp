// Fig. 46: the conventional mirror and the mirror of parallel and series arrays: ratio and output conductance over the output voltage. The
// study also shows the reason for arrays: transistors of different lengths have different thresholds, so the ratio of their currents
// differs from the ratio of their aspect ratios.

#include <fmt/format.h>
#include <cmath>

#include "circuit/cost/area.hpp"
#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/sample_statistics.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/array_text.hpp"

namespace corpuscle::studies::fig46 {

constexpr double I_in = 100e-9, V_out = 0.35;  // A, V: of all mirrors
constexpr int sizes[] = {1, 2, 4, 8};          // N: unit transistors in parallel and in series

/// Compares a mirror of a short and a long transistor, each with its own threshold (A and B1 of table 11), with a mirror of the same ratio
/// whose long transistor is an array of short ones in series.
Result<void> add_lengths(StudyResult& out) {
    const auto b1 = TRY(elaborate_study_netlist({"rectangular_arrays"}));
    const auto& values = b1->elements[static_cast<std::size_t>(b1->find_element("xb1.mg1"))].values;
    const double L = values.at("l"), shift = values.at("delvto"), ratio = L / 0.18e-6;
    const int n = static_cast<int>(std::lround(ratio));
    const std::string unit = "0 nch018 w=0.42u l=0.18u";
    const auto mirror = [&](const std::string& output) {
        return run_study_netlist(
            {fmt::format("mirror\n{}iin 0 in 100n\nma in in {}\nvo out 0 {}\n", process_card, "0 " + unit, V_out) + output, {}, ".op"});
    };
    const auto by_length = mirror(fmt::format("mb out in 0 0 nch018 w=0.42u l={} delvto={}\n", L, shift));
    const auto by_array = mirror(array_lines("b", "out", "in", "0", 1, n, unit));
    TRY(check_all(by_length, by_array));
    const double long_transistor = I_in / -by_length->operating_point("i(vo)"), array = I_in / -by_array->operating_point("i(vo)");
    out.claim(fmt::format("0.18 um to {:g} um: I_in/I_out over the ratio of aspect ratios", 1e6 * L), long_transistor / ratio)
        .derived_as(1, "thesis eq. 33")
        .of_kind(ClaimKind::fitted);
    if (auto& c = out.claims.back(); c.needs_explanation()) c.explain("their thresholds differ (table 11, A and B1)");
    out.claim(fmt::format("0.18 um to {} unit transistors of 0.18 um in series: I_in/I_out over the ratio of aspect ratios", n),
              array / ratio)
        .derived_as(1, "thesis C.1: a better mirror")
        .of_kind(ClaimKind::identity);
    out.claim_true("the ratio of the array is closer to the ratio of sizes than that of the long transistor",
                   std::abs(array / ratio - 1) < std::abs(long_transistor / ratio - 1), "thesis C.1");
    out.claims.back().of_kind(ClaimKind::fitted);  // to the thresholds of table 11
    return {};
}

/// Spread over chips of the output current of a mirror of ratio 1/16: 4 unit transistors in parallel to 4 in series, and 16 in parallel to
/// one.
Result<void> add_spread(StudyResult& out) {
    const std::string unit = "0 nch w=1.5u l=0.5u";
    // standard deviation of I_out (%), m in parallel at the input, n in series at the output
    const auto deviation = [&](int m, int n) -> Result<double> {
        const auto chips =
            run_study_variants({fmt::format("mirror\n{}iin 0 in 100n\nvo out 0 {}\n", process_card, V_out) +
                                    array_lines("a", "in", "in", "0", m, 1, unit) + array_lines("b", "out", "in", "0", 1, n, unit),
                                {},
                                ".op\n.mc 1000 process=0"});
        if (!chips) return chips.error();
        return sample_statistics(*chips, "i(vo)").cv_percent();
    };
    const auto arrays = deviation(4, 4), parallel = deviation(16, 1);
    TRY(check_all(arrays, parallel));
    out.claim("1/16 by 4 unit transistors in parallel to 4 in series: standard deviation of I_out over 1000 chips", std::abs(*arrays), "%")
        .allow_max(
            std::abs(*parallel),
            "thesis C.2: less variability, and less area, than parallel unit transistors only; the bound is their standard deviation");
    return {};
}

Result<StudyResult> compute(const StudyOptions&) {
    const auto found = TRY(run_study_netlist({"parallel_series_mirror", {}, ".dc vo 0 0.7 5m"}));
    StudyResult out;
    StudyPlot currents{"I_out of mirrors of N in parallel to N in series, 100 nA in", "V_out (V)", "I_out N^2 (nA)", {}};
    StudyPlot slopes{"Output conductance", "V_out (V)", "G_o N^2 (nS)", {}, false, true};
    for (const int n : sizes) {
        const double N2 = n * n;
        const auto I = found.curve("dc", fmt::format("i(v{})", n)).scaled(1, -1), slope = I.slope();
        const auto name = n == 1 ? std::string("conventional (46a), 1 to 1") : fmt::format("parallel-series (46b), N = {}", n);
        out.claim(fmt::format("{}: I_in/I_out at 0.35 V", name), I_in / I.at(V_out))
            .derived_as(N2, n == 1 ? "thesis eq. 33, 1 to 1" : "thesis eq. 34")
            .of_kind(ClaimKind::identity);
        auto& c = out.claim(
            fmt::format("{}: I_out/G_o over I_out/G_o of the 1 to 1 mirror", name),
            I.at(V_out) / slope.at(V_out) / (found.curve("dc", "i(v1)").at(V_out) / found.curve("dc", "i(v1)").slope().at(V_out)));
        c.derived_as(n, "thesis eq. 36: V_A = V_E L");
        if (n == 1) c.of_kind(ClaimKind::identity);
        if (c.needs_explanation())
            c.explain(
                "in a stack of N only the unit transistor at the drain has length modulation, so the effect is less than 1/N of a single "
                "transistor's");
        currents.add(name, I.scaled(1, 1e9 * N2)), slopes.add(name, slope.between(0.02, 0.7).scaled(1, 1e9 * N2));
        if (n == 1) continue;
        const double units = 2 * n, array = circuit::array_area(1.5e-6, 0.5e-6, units), plain = circuit::array_area(1.5e-6, 0.5e-6, N2 + 1);
        out.claim(fmt::format("{}: area of its {:g} unit transistors over that of {:g}, N^2 in parallel and one", name, units, N2 + 1),
                  array / plain)
            .allow_max(1, "thesis B.1, C.1: area-efficient")
            .of_kind(ClaimKind::arithmetic);
    }
    for (const auto add : {add_lengths, add_spread}) TRY(add(out));
    out.plots = {currents.describe_published("C.1: I_out is I_in over N^2"),
                 slopes.describe_published("C.1: G_o falls as the channel lengthens (eq. 36)")};
    return out;
}

const Study study{"fig46", "Current mirrors, conventional and of arrays",
                  "Ratio, output conductance, and the effect of different lengths. Thesis C.1, fig. 46", ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::fig46
