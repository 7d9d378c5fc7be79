// Fig. 62: input-referred noise of the three inverters, outputs held. V_IN is relative to half the supply.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/inverters.hpp"

namespace corpuscle::studies::fig62 {

constexpr double min_frequency = 1e-3, max_frequency = 1e5;  // Hz
constexpr double largest_signal = 0.35;                      // V: half the supply, the largest excursion of a filter's node

/// Input-referred noise, V/sqrt(Hz) over Hz. without_bias: capacitors of 1000 F suppress the noise of the bias generator.
Result<StudyCurve> input_noise(char inverter, bool without_bias) {
    const auto found =
        InverterSweep::run_with_directives(fmt::format(".noise v(i{}) vin dec 10 {} {}", inverter, min_frequency, max_frequency),
                                           {fmt::format("c_bias={}", without_bias ? "1000" : "0")});
    if (!found) return found.error();
    return found->netlist_result.curve("noise", "inoise_spectrum");
}

/// Corner frequency (Hz), at which 1/f noise and thermal noise are equal. The smallest density of the curve is the thermal noise.
double corner_frequency(const StudyCurve& noise) { return noise.crossing(std::sqrt(2) * noise.min()); }

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    out.plot("Fig. 62: input-referred noise", "Hz", "V/sqrt(Hz)");
    StudyCurve noise[3];
    for (int k = 0; k < 3; ++k) {
        auto without_bias = input_noise(inverter_letters[k], true), with_bias = input_noise(inverter_letters[k], false);
        for (const auto* line : {&without_bias, &with_bias})
            if (!*line) return line->error();
        const std::string name = inverter_names[k];
        out.plots[0].add(name, *without_bias).add(name + " with its bias generator", *with_bias);
        out.claim(name + ": thermal noise", without_bias->min(), "V/sqrt(Hz)");
        out.claim(name + ": noise at 1 mHz", without_bias->y.front(), "V/sqrt(Hz)");
        out.claim(name + ": corner frequency of thermal and 1/f noise", corner_frequency(*without_bias), "Hz");
        out.claim(name + ": noise at 100 Hz, with over without the bias generator's noise", with_bias->at(100) / without_bias->at(100),
                  "times");
        noise[k] = std::move(*without_bias);
        if (auto ok = options.report_progress(0.3 * (k + 1)); !ok) return ok.error();
    }
    out.plots[0].log_x = out.plots[0].log_y = true;
    out.plots[0].describe_published("INVC's thermal noise is orders of magnitude larger, its 1/f noise is larger as well");
    // of thermal noises, or of the noises at 1 mHz
    const auto ratio = [](const StudyCurve& a, const StudyCurve& b, bool thermal) {
        return thermal ? a.min() / b.min() : a.y.front() / b.y.front();
    };
    for (int k = 0; k < 2; ++k) {
        out.claim(fmt::format("INVC's thermal noise over {}'s", inverter_names[k]), ratio(noise[2], noise[k], true), "times")
            .allow_min(10, "E.4: orders of magnitude larger");
        out.claim(fmt::format("INVC's 1/f noise over {}'s, at 1 mHz", inverter_names[k]), ratio(noise[2], noise[k], false), "times")
            .allow_min(1, "E.4: larger, as it has extra transistors");
    }
    const auto filter = InverterSweep::run_with_directives(".noise v(load) vin dec 10 1m 100k");
    if (!filter) return filter.error();
    const double total = filter->netlist_result.number("onoise_total");
    out.claim("INVC as a load of 0.8 pF (filter B): noise from 1 mHz to 100 kHz", total, "V");
    out.claim("half the supply over the noise of this load", 20 * std::log10(largest_signal / total), "dB")
        .allow_min(40, "E.4: adequate for its application; 40 dB is our choice");
    const auto at_rest = InverterSweep::run(0.35);
    if (!at_rest) return at_rest.error();
    double supply_currents[3];
    for (int k = 0; k < 3; ++k)
        out.claim(fmt::format("{}: supply current at V_IN = 0", inverter_names[k]),
                  supply_currents[k] = at_rest->supply_current(inverter_letters[k]).at(0), "A");
    out.claim_true("INVC takes more current than INVA and INVB",
                   supply_currents[2] > supply_currents[0] && supply_currents[2] > supply_currents[1],
                   "E.4: very power inefficient (INVC is meant, errata I14)");
    out.note(
        "The divider of the bias generator has very large resistances (E.2); its noise enters through BN and BP up to the frequency at "
        "which the capacitances at REF short it.");
    out.note(
        "The flicker noise parameter of the process card (nt) is our choice, so 1/f noises can be compared with each other but not with "
        "the thesis's.");
    return out;
}

const Study study{
    "fig62", "Noise of the three inverters",
    "INVC's thermal noise is orders of magnitude larger, its 1/f noise larger, but adequate in its bandwidth. Thesis E.4, fig. 62",
    compute};

}  // namespace corpuscle::studies::fig62
