// Fig. 62: noise of the three inverters, as if at their inputs, outputs held.

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/inverters.hpp"

namespace corpuscle::studies::fig62 {

constexpr double slow = 1e-3, fast = 1e5;  // Hz
constexpr double largest = 0.35;           // V: half the supply, what a filter's node can go to either side

/// V/sqrt(Hz) over Hz; alone: without what the bias generator adds.
Result<Line> input_noise(char which, bool alone) {
    const auto found = Inverters::ordered(fmt::format(".noise v(i{}) vin dec 10 {} {}", which, slow, fast),
                                          {fmt::format("c_bias={}", alone ? "1000" : "0")});
    if (!found) return found.error();
    return found->found.line("noise", "inoise_spectrum");
}

/// The least density is thermal; where 1/f noise is as large, Hz.
double corner(const Line& noise) { return noise.where(std::sqrt(2) * noise.least()); }

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    out.plot("Fig. 62: noise as if at the input", "Hz", "V/sqrt(Hz)");
    Line noise[3];
    for (int k = 0; k < 3; ++k) {
        auto alone = input_noise(inverter_letters[k], true), whole = input_noise(inverter_letters[k], false);
        for (const auto* line : {&alone, &whole})
            if (!*line) return line->error();
        const std::string name = inverter_names[k];
        out.plots[0].add(name, *alone).add(name + " with its bias generator", *whole);
        out.claim(name + ": thermal noise", alone->least(), "V/sqrt(Hz)");
        out.claim(name + ": at 1 mHz", alone->y.front(), "V/sqrt(Hz)");
        out.claim(name + ": thermal and 1/f noise are equal at", corner(*alone), "Hz");
        out.claim(name + ": at 100 Hz with the bias generator's, over its own", whole->at(100) / alone->at(100), "times");
        noise[k] = std::move(*alone);
        if (auto ok = options.at(0.3 * (k + 1)); !ok) return ok.error();
    }
    out.plots[0].log_x = out.plots[0].log_y = true;
    out.plots[0].shape("INVC's thermal noise orders of magnitude larger, its 1/f noise larger, too");
    const auto over = [](const Line& a, const Line& b, bool thermal) {
        return thermal ? a.least() / b.least() : a.y.front() / b.y.front();
    };
    for (int k = 0; k < 2; ++k) {
        out.claim(fmt::format("INVC's thermal noise over {}'s", inverter_names[k]), over(noise[2], noise[k], true), "times")
            .at_least(10, "E.4: orders of magnitude larger");
        out.claim(fmt::format("INVC's 1/f noise over {}'s, at 1 mHz", inverter_names[k]), over(noise[2], noise[k], false), "times")
            .at_least(1, "E.4: larger, as it has extra transistors");
    }
    const auto filter = Inverters::ordered(".noise v(load) vin dec 10 1m 100k");
    if (!filter) return filter.error();
    const double total = filter->found.number("onoise_total");
    out.claim("INVC as a load of 0.8 pF (filter B): noise from 1 mHz to 100 kHz", total, "V");
    out.claim("half the supply over that", 20 * std::log10(largest / total), "dB")
        .at_least(40, "E.4: adequate for its application; 40 dB is our word for it");
    const auto rest = Inverters::swept(0.35);
    if (!rest) return rest.error();
    double taken[3];
    for (int k = 0; k < 3; ++k)
        out.claim(fmt::format("{}: current taken at V_IN = 0", inverter_names[k]), taken[k] = rest->taken(inverter_letters[k]).at(0), "A");
    out.finds("INVC takes more than INVA and INVB", taken[2] > taken[0] && taken[2] > taken[1],
              "E.4: very power inefficient (INVC is meant, errata I14)");
    out.note(
        "The bias generator's divider is of very large resistances (E.2); its noise comes in through BN and BP until the capacitances at "
        "REF short "
        "it.");
    out.note("The cards' flicker noise is a choice (nt), so 1/f noises compare with each other, not with the thesis's.");
    return out;
}

const Study study{
    "fig62", "Noise of the three inverters",
    "INVC's thermal noise is orders of magnitude larger, its 1/f noise larger, but adequate in its bandwidth. Thesis E.4, fig. 62", work};

}  // namespace corpuscle::studies::fig62
