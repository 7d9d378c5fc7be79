// Equations (16) to (20) of the analog signal processing, corrected by the errata, compared with the circuits; and the results of the
// printed forms.
// Symbols. I_F is the transducer's output current, V_F the voltage made of it, I_A0 its copy for the summer, whose output is I_A. S_n is
// the aspect ratio of M_n. k_N and k_P are the gains of INVC's mirrors, k_A and k_X those of summer and rectifier.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/active_load.hpp"

namespace corpuscle::studies::eq16_20 {

constexpr double I_BIASF = 700e-9, V_DD = 0.7, pi = std::numbers::pi;  // A, V

/// Aspect ratio of an array: W/L times columns over unit transistors in series.
double aspect(const circuit::Circuit& c, const std::string& name) {
    const auto& e = c.elements[static_cast<std::size_t>(c.find_element(name))];
    const auto value = [&](const char* key, double otherwise) {
        const auto at = e.values.find(key);
        return at == e.values.end() ? otherwise : at->second;
    };
    return value("w", 0) / value("l", 1) * value("m", 1) / value("stack", 1);
}

/// Aspect ratio of the first array over that of the second.
double ratio(const circuit::Circuit& c, const std::string& first, const std::string& second) {
    return aspect(c, first) / aspect(c, second);
}

/// Current gain of a current-splitting mirror of the arrays M_A to M_D: exact, by (38) and (39), and approximate, as printed in (19), (20)
/// and (40).
struct SplitMirrorGain {
    double exact, printed;
    SplitMirrorGain(const circuit::Circuit& c, const std::string& A, const std::string& B, const std::string& C, const std::string& D)
        : exact(aspect(c, B) * aspect(c, D) / (aspect(c, A) * (aspect(c, B) + aspect(c, C) + aspect(c, D)))),
          printed(ratio(c, B, A) * ratio(c, D, C)) {}
};

Result<void> eq_16_18(StudyResult& out) {
    const auto found = run_study_netlist({"current_to_voltage", {}, ".dc if 0.2u 2.6u 10n"}),
               cell = run_study_netlist({"invb", {}, ".dc vin 0.3 0.4 1m"});
    if (!found) return found.error();
    if (!cell) return cell.error();
    const auto V_F = found->curve("dc", "v(vf)"), I_A0 = found->curve("dc", "i(va0)");
    // k_1 and k_4 are the mirror ratios of (16), R is the resistance of INVB as a load at half the supply
    const double k_1 = ratio(*found->circuit, "m3b", "m3a"), k_4 = ratio(*found->circuit, "m4b", "m4a");
    const double R = analyse_load(cell->curve("dc", "i(vin)").scaled(1, -1)).resistance.at(0.35);
    out.claim("(16), (18): k_1 = S_3B / S_3A of table 3", k_1, "times").derived_as(0.5, "table 3, errata S1");
    out.claim("(16): simulated copy I_A0 / I_F at I_F = 1.4 uA", I_A0.at(1.4e-6) / 1.4e-6, "times").derived_as(k_1, "eq. 16, errata S1");
    out.claim("V_F where (S_3B/S_3A) I_F = (S_4B/S_4A) I_BIASF, I_F = 1.4 uA", V_F.at(k_4 * I_BIASF / k_1), "V")
        .derived_as(V_DD / 2, "eq. 18, errata S2a");
    out.claim("V_F at I_F = I_BIASF, as the text states", V_F.at(I_BIASF), "V")
        .derived_as(V_DD / 2, "thesis 4.3.1: V_DD/2 for I_F1 = I_BIASF")
        .explain("I_F1 is the current of M3B, half of I_F (errata S2a)");
    out.claim("slope dV_F/dI_F at I_F = 1.4 uA", V_F.slope_at(1.4e-6), "ohm")
        .derived_as(k_1 * R, "eq. 18 divided by G_m1, which is that of INVB as a load (errata S2)")
        .explain("the output conductance of the mirrors is in parallel with the load");
    StudyCurve by_18;
    for (const double I : V_F.x) by_18.x.push_back(I), by_18.y.push_back(V_DD / 2 + (k_1 * I - k_4 * I_BIASF) * R);
    out.claim(
           "V_F against (18), I_F 1 to 1.8 uA: largest difference",
           [&] {
               double largest = 0;
               for (const double I : V_F.between(1e-6, 1.8e-6).x) largest = std::max(largest, std::abs(V_F.at(I) - by_18.at(I)));
               return largest;
           }(),
           "V")
        .allow_max(10e-3, "eq. 18, errata S2; in the linear range of INVB; 10 mV is our choice");
    out.claim("(18) as printed multiplies by G_m1: rise of V_F when I_F rises by 0.2 uA", k_1 * 0.2e-6 / R, "V")
        .derived_as(V_F.at(1.6e-6) - V_F.at(1.4e-6), "simulated rise of the circuit's V_F")
        .explain("A times S is not V; (16) divides (errata S2)");
    out.plot("V_F over I_F, and (18)", "I_F (uA)", "V_F (V)")
        .add("circuit", V_F.scaled(1e6, 1))
        .add("(18), divided by G_m1", by_18.scaled(1e6, 1));
    return {};
}

/// Largest relative difference (%) of a filter's magnitude |H| from (17), s / (s + 2 pi corner), with the filter's own corner (Hz), up to
/// the frequency `to` (Hz).
double difference_from_17(const StudyCurve& magnitude, double corner, double to) {
    double largest = 0;
    const auto band = magnitude.between(0, to);
    for (std::size_t k = 0; k < band.x.size(); ++k)
        largest = std::max(largest, std::abs(band.y[k] / (band.x[k] / std::hypot(band.x[k], corner)) - 1));
    return 100 * largest;
}

Result<void> eq_17_19(StudyResult& out) {
    const auto found =
        run_study_netlist({"high_pass", {}, ".ac dec 20 10m 10k\n.meas ac f_c when vp(hpc)=0.785398\n.meas ac f_b when vp(hpb)=0.785398"});
    // ideal: without length modulation
    const auto invc = run_study_netlist({"invc", {}, ".dc vin 0.34 0.36 0.5m"}),
               ideal = run_study_netlist({"invc", {}, ".dc vin 0.34 0.36 0.5m", ideal_mirrors});
    if (!found) return found.error();
    if (!invc) return invc.error();
    if (!ideal) return ideal.error();
    const auto H_B = found->curve("ac", "vm(hpb)"), H_C = found->curve("ac", "vm(hpc)");
    for (const auto& [name, line, corner] : {std::tuple{"B", H_B, found->number("f_b")}, {"C", H_C, found->number("f_c")}}) {
        auto& c = out.claim(fmt::format("(17): |H| of filter {} against s / (s + 2 pi f_c), 10 mHz to 1 kHz: largest difference", name),
                            difference_from_17(line, corner, 1e3), "%")
                      .allow_max(10, "eq. 17; a tenth is our choice");
        if (c.needs_explanation())
            c.explain("the parasitic capacitance of its node attenuates its signal at all frequencies (study fig30)");
    }
    // slope of INVB's output current over that of INVC's
    const auto division_ratio = [](const NetlistResult& f) {
        return f.curve("dc", "i(vb)").slope_at(0.35) / f.curve("dc", "i(vhalf)").slope_at(0.35);
    };
    const auto& c = *invc->circuit;
    const SplitMirrorGain P(c, "xl.mp3a", "xl.mp3b", "xl.mp3c", "xl.mp3d"), N(c, "xl.mn4a", "xl.mn4b", "xl.mn4c", "xl.mn4d");
    const double last = ratio(c, "xl.mn6b", "xl.mn6a");
    out.claim("(19): k_N as the product of the printed ratios, with M6 corrected", N.printed * last)
        .published_as(1.0 / 16000, "thesis 4.3.1: about 16000 times; errata S5, S7");
    out.claim("(19): k_N as the product of the printed ratios, M6 as printed (8x2 to 2x4)", N.printed / 8, "")
        .published_as(1.0 / 16000, "thesis 4.3.1")
        .explain("8x2 to 2x4 is 1/8, but M5 has 1/64 (errata S7)");
    out.claim("exact 1/k_N, by (38) and (39)", 1 / (N.exact * last), "times").derived_as(18432, "errata S7b");
    out.claim("exact 1/k_P of the P mirrors, by (38) and (39)", 1 / (P.exact * ratio(c, "xl.mp5b", "xl.mp5a")), "times")
        .derived_as(18432, "errata S7a");
    out.claim("division ratio of the circuit without length modulation", division_ratio(*ideal), "times").derived_as(18432, "errata S7b");
    out.claim("division ratio of the circuit", division_ratio(*invc), "times")
        .derived_as(16384, "eq. 19 with 1/256 instead of 1/288")
        .explain("length modulation of the mirrors' diodes, and the exact split of 1/288 (errata S7b)");
    const double G = std::abs(invc->curve("dc", "i(vb)").slope_at(0.35));
    out.claim("filter B's corner if the product of ratios is 1/k_N, as (19) prints, instead of k_N",
              G / (N.printed * last) / (2 * pi * 0.8e-12), "Hz")
        .allow_range(27, 33, "thesis 4.3.1: 30 Hz, plus or minus a tenth")
        .explain("k_N of (17) is less than one; (19) prints its inverse (errata S5)");
    out.plot("|H| of the filters, and (17) with their own corners", "frequency (Hz)", "magnitude").add("B", H_B).add("C", H_C);
    auto& p = out.plots.back();
    p.log_x = p.log_y = true;
    for (const auto& [name, corner] : {std::pair{"(17), B", found->number("f_b")}, {"(17), C", found->number("f_c")}}) {
        StudyCurve line = H_B;
        for (std::size_t k = 0; k < line.x.size(); ++k) line.y[k] = line.x[k] / std::hypot(line.x[k], corner);
        p.add(name, line);
    }
    return {};
}

Result<void> eq_20(StudyResult& out) {
    const auto found = run_study_netlist({"summer", {}, ".dc iin 0.05u 2.6u 10n"});
    if (!found) return found.error();
    const auto& c = *found->circuit;
    // at 4 N: the input iin is I_F / 2, 1.22 uA (circuits/summer.cir)
    const auto division_ratio = [&](const char* curve) { return 2 * 1.22e-6 / found->curve("dc", curve).at(1.22e-6); };
    const SplitMirrorGain first(c, "x1.mn1a", "x1.mn1b", "x1.mn1c", "x1.mn1d");
    // 0.5 is I_A0 / I_F; then come the mirrors M2 and M3
    const double other_stages = 0.5 * ratio(c, "x1.mp2b", "x1.mp2a") * ratio(c, "x1.mn3b", "x1.mn3a");
    out.claim("(20): 1 / k_A by the printed ratios, k_A = I_A / I_F", 1 / (other_stages * first.printed), "times")
        .derived_as(262144, "eq. 20, errata S10");
    out.claim("(20): exact 1 / k_A", 1 / (other_stages * first.exact), "times").derived_as(294912, "eq. 20 with 1/288, errata S7b, S10");
    out.claim("division ratio of the summer for I_F, without length modulation", division_ratio("i(va3)"), "times")
        .derived_as(1 / (other_stages * first.exact), "eq. 20, exact");
    out.claim("division ratio of the summer for I_F, at 4 N", division_ratio("i(va)"), "times")
        .derived_as(1 / (other_stages * first.printed), "eq. 20")
        .explain("1/288 instead of 1/256, and length modulation of three mirrors (circuits/summer.cir)");
    const auto rectifier = run_study_netlist({"rectifier_sa", {}, ".dc vhp 0.37 0.39 1m"});
    if (!rectifier) return rectifier.error();
    const auto gain = [&](const char* curve) {
        return rectifier->curve("dc", curve).slope_at(0.38) / rectifier->curve("dc", "i(vn)").slope_at(0.38);
    };
    out.claim("k_X = S_2B / S_6B: simulated gain of I_B", gain("i(vb)"), "times")
        .derived_as(ratio(*rectifier->circuit, "xb.mn2b", "xres.mn6b"), "errata S9: output over input");
    out.claim("k_X: simulated gain of I_C with the sizes of table 6", gain("i(vc)"), "times")
        .derived_as(ratio(*rectifier->circuit, "xc.mn2b", "xres.mn6b"), "errata S9");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    for (const auto add_part : {eq_16_18, eq_17_19, eq_20}) {
        if (auto ok = add_part(out); !ok) return ok.error();
        if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    }
    out.note("Ratios are those of the array sizes in the netlists, which a test compares with tables 3 to 7.");
    return out;
}

const Study study{
    "eq16-20", "Equations (16) to (20) as corrected, compared with the circuits",
    "Do V_F, the filters and the summer follow their equations, and what do the printed forms give? Thesis 4.3.1; errata S1 to S10",
    compute};

}  // namespace corpuscle::studies::eq16_20
