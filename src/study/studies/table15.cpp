// Table 15: ratios and mismatch of the trapezoidal arrays, and what the text makes of them.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "study/arrays.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::table15 {

void put_errata(Outcome& out) {
    put_ratio_rule(out, trapezoids, 1e-9, "errata U8: g_md a tenth of what table 14 prints");
    for (const auto& a : printed_trapezoids) {
        out.claim(fmt::format("{}: g_mg over A (table 13), as printed", a.name), a.g_mg / a.A * 1e6, "S/m^2")
            .printed_as(1e6 * a.g_by_A, "table 15, its nS read as uS: errata U9");
        out.claim(fmt::format("{}: g_mb/g_mg by table 14 as printed", a.name), a.g_mb / a.g_mg).printed_as(a.slope, "table 15, errata U5");
    }
}

void put_text(Outcome& out, const OurArrays& ours, const OurArrays& short_ones) {
    const std::string source = "thesis B.2";
    const auto gain = [&](const char* name) { return ours(name).gain(); };
    const auto V_A = [&](const char* name) { return ours(name).V_A(); };
    out.claim("G3's V_A over A's", V_A("G3") / short_ones("A").V_A()).printed_as(10, source);
    out.claim("F's V_A over E's", V_A("F") / V_A("E")).printed_as(33.38 / 37.82, source + ": similar; table 15");
    auto& lower = out.finds("F's gain is slightly lower than E's", gain("F") < gain("E"), source);
    if (lower.needs_reason())
        lower.because(
            "the short transistor's threshold lies 38 mV above the long one's here, 90 mV in table 14: less of the current's fall along F "
            "is "
            "lost to it");
    out.finds("G1's gain is considerably smaller than E's", gain("G1") < gain("E") - 3, source + "; 3 dB here, 7 printed");
    const auto best = std::max_element(ours.begin(), ours.end(), [](const auto& a, const auto& b) { return a.gain() < b.gain(); });
    out.finds("G2 has the largest gain", best->printed->name == std::string_view("G2"), source);
}

void put_mismatch_text(Outcome& out, const std::vector<double>& sigma, double of_a) {
    const std::string source = "thesis B.2";
    const auto of = [&](const char* name) { return sigma[static_cast<std::size_t>(&printed(trapezoids, name) - printed_trapezoids)]; };
    out.claim("E's deviation over G1's", of("E") / of("G1")).printed_as(2.36 / 5.77, source + ": half; table 15").because("");
    out.claim("E's deviation over G1's, by the areas of table 13", std::sqrt(0.6048 / 2.1924))
        .printed_as(2.36 / 5.77, "errata U18: 3.63 times the area")
        .because("and E is the further inverted: its g_mg/I_D is the smaller");
    out.finds("G3's is much greater than G1's and G2's", of("G3") > 1.5 * std::max(of("G1"), of("G2")),
              source + "; half as much again here, twice printed");
    out.claim("G3's over A's", of("G3") / of_a).printed_as(14.9 / 15.6, source + ": similar; tables 15 and 12");
    out.claim("G2's over G1's", of("G2") / of("G1")).printed_as(7.46 / 5.77, source + ": slightly more; table 15");
}

Result<Outcome> work(const StudyOptions&) {
    const auto ours = arrays_of(trapezoids), short_ones = arrays_of(rectangles);
    if (!ours || !short_ones) return ours ? short_ones.error() : ours.error();
    const auto sigma = mismatch_of(trapezoids), sigma_of_short_ones = mismatch_of(rectangles);
    if (!sigma || !sigma_of_short_ones) return sigma ? sigma_of_short_ones.error() : sigma.error();
    Outcome out;
    put_ratios(out, trapezoids, *ours);
    put_mismatch(out, trapezoids, *sigma);
    put_errata(out);
    put_text(out, *ours, *short_ones);
    put_mismatch_text(out, *sigma, sigma_of_short_ones->front());
    return out;
}

const Study study{"table15", "Ratios and mismatch of the trapezoidal arrays",
                  "g_mg/I_D, Early voltage, gain, n - 1, g_mg of an area and the mismatch of 1000 draws. Thesis B.2, table 15", work};

}  // namespace corpuscle::studies::table15
