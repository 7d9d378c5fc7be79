// Thesis fig. 10: the differentiator with an ideal operational amplifier.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::fig10 {

/// circuits/differentiator.cir under the press stimulus, one volt per newton.
constexpr auto under_press = R"(A differentiator under the press
v1 in 0 dc 0 force 1
c1 in minus 8n
r1 minus out 1meg
e1 out 0 0 minus 1e6
.force press
.tran 1m 1 0 1m
.save v(in) v(out)
.end
)";
constexpr double capacitor_density = 2e-3;  // F/m^2, 2 fF/um^2: the density of the thesis's MIM capacitors (errata S4)

/// Slope of the gain on two logarithmic axes between two frequencies (Hz): decades of gain per decade of frequency.
double gain_slope(const StudyCurve& magnitude, double from, double to) {
    return std::log10(magnitude.at(to) / magnitude.at(from)) / std::log10(to / from);
}

/// Compares the differentiator's output under the press stimulus with -RC dF/dt; tau is RC (s).
void add_press_claims(StudyResult& out, const NetlistResult& press, double tau) {
    const auto force = press.curve("tran", "v(in)"), response = press.curve("tran", "v(out)");
    const auto slope = force.slope().scaled(1, -tau);  // -RC dF/dt
    double largest_error = 0;
    for (std::size_t k = 0; k < response.x.size(); ++k)
        if (const double d = std::abs(response.y[k] - slope.at(response.x[k])); d > largest_error) largest_error = d;
    out.claim("under the press stimulus: largest difference from -RC dF/dt, relative to the largest -RC dF/dt",
              100 * largest_error / slope.absolute().max(), "%")
        .allow_max(2, "thesis 2.2 and 2.3: a differentiator; the range is our choice, for steps of at most 1 ms");
    out.plot("Under the press stimulus, one volt per newton", "time (s)", "voltage (V)").add("v(out)", response).add("-RC dF/dt", slope);
}

Result<StudyResult> compute(const StudyOptions&) {
    StudyResult out;
    const auto ac = run_study_netlist({"differentiator", {}, ".ac dec 20 0.1 1k"}), press = run_study_netlist({under_press, {}, {}});
    if (!ac) return ac.error();
    if (!press) return press.error();
    const auto magnitude = ac->curve("ac", "vm(out)"), phase = ac->curve("ac", "vp(out)");
    const double tau = 1 / (2 * M_PI * magnitude.crossing(1)), model_B = 1 / (2 * M_PI * 20), model_C = 1 / (2 * M_PI * 2);
    out.claim("tau of the differentiator, from the frequency at which its gain is 1", tau, "s")
        .allow_range(1e-3, 10e-3, "thesis 2.3: tau = RC in the order of milliseconds; a decade is our choice");
    out.claim("tau of the model's fast filter (20 Hz)", model_B, "s").allow_range(1e-3, 10e-3, "thesis 2.3: in accordance with the model");
    out.claim("tau of the model's slow filter (2 Hz)", model_C, "s")
        .allow_range(1e-3, 10e-3, "thesis 2.3: in accordance with the model")
        .explain("section 2.3 is about the differentiator of Kim's model; the thesis's own slow filter comes later (3.3)");
    out.claim("growth of the gain from 1 to 100 Hz, decades per decade", gain_slope(magnitude, 1, 100))
        .derived_as(1, "thesis 3.3: amplitude increases proportionally with frequency");
    out.claim("growth of the gain from 100 Hz to 1 kHz, decades per decade", gain_slope(magnitude, 100, 1000))
        .derived_as(1, "thesis 3.3: susceptible to high frequencies");
    out.claim("phase at 20 Hz", phase.at(20) * 180 / M_PI, "degrees").derived_as(-90, "an inverted derivative: 90 - 180 degrees");
    const double high_pass_gain = 1 / std::sqrt(1 + std::pow(20.0 / 1e3, 2));
    out.claim("gain at 1 kHz over that of a high-pass of 20 Hz and gain 1", magnitude.at(1e3) / high_pass_gain)
        .allow_min(10, "thesis 3.3: the gain must be limited above a corner; ten times is our choice");
    for (const double R : {1e6, 1e9})
        out.claim(fmt::format("plate area of C for this tau at R = {}", R < 1e9 ? "1 Mohm" : "1 Gohm"), tau / R / capacitor_density * 1e12,
                  "um^2");
    add_press_claims(out, *press, tau);
    out.plot("Gain", "frequency (Hz)", "gain", true, true)
        .add("ideal differentiator", magnitude)
        .add("gain 1", {{magnitude.x.front(), magnitude.x.back()}, {1, 1}});
    out.note(
        "R, C and the amplifier's gain (1 Mohm, 8 nF, 1e6) are our choice; the bandwidth of a real amplifier is left out. The plate area "
        "explains both statements of the thesis, \"relatively easy to implement with discrete components\" and \"a large size\": at 1 Mohm "
        "the plate has a side of millimetres.");
    return out;
}

const Study study{
    "fig10", "The differentiator with an ideal operational amplifier",
    "Its time constant tau = RC is in the order of milliseconds; its gain grows with frequency without limit. Thesis 2.2, 2.3, fig. 10",
    compute};

}  // namespace corpuscle::studies::fig10
