// Thesis fig. 5: the nerve's instantaneous discharge frequency under the press. The curves are lost; their words, and what is known of
// them elsewhere with how well it is known, are held against the models.

#include <fmt/format.h>

#include "study/studies.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::fig5 {

using press::count;

constexpr auto words = "thesis 1.2, fig. 5";
constexpr auto inferred = "Birznieks et al. 2001, population mean, inferred from the thesis's parameters, not read";

bool falls(const Line& line) {
    for (std::size_t k = 1; k < line.y.size(); ++k)
        if (line.y[k] >= line.y[k - 1]) return false;
    return true;
}

void slow(Outcome& out, const std::vector<double>& train) {
    const double peak = measure<PeakRate>(train, press::up), last = measure<LastRate>(train, press::plateau);
    const auto plateau = press::frequency(train).between(press::plateau.from, press::plateau.to);
    press::known_as(out.claim("SA-I: peak in protraction", peak, "Hz"), 38, inferred);
    press::known_as(out.claim("SA-I: first frequency of the plateau", plateau.y.front(), "Hz"), 30, inferred);
    press::known_as(out.claim("SA-I: last of the plateau", last, "Hz"), 15, inferred);
    out.claim("SA-I: peak over the plateau's last", peak / last).between(2, 3, "thesis 1.2: high, then sustained; the range is ours");
    out.finds("SA-I: frequency falls steadily through the plateau", falls(plateau), words);
    out.claim("SA-I: spikes after 40 % of retraction", count(train, {0.675, 0.75}), "spikes")
        .at_most(1, "thesis 1.2: almost no response; the number is ours");
}

void fast(Outcome& out, const std::vector<double>& train) {
    const double up = measure<PeakRate>(train, {0.25, 0.5}), down = measure<PeakRate>(train, {0.625, 1.0});
    press::known_as(out.claim("FA-I: peak of the rising force", up, "Hz"), 25, inferred);
    press::known_as(out.claim("FA-I: peak of the falling force", down, "Hz"), 19, inferred);
    out.claim("FA-I: one over the other", up / down)
        .between(1.2, 1.5, "thesis 1.2: asymmetrical, protraction above retraction; the range is ours");
    out.claim("FA-I: spikes in the plateau's last 100 ms", count(train, press::late), "spikes").between(0, 0, words);
    const double tail = count(train, press::plateau) + count(train, press::after);
    auto& c =
        out.claim("FA-I: spikes outside of protraction and retraction", tail, "spikes").between(0, 0, fmt::format("{}: only there", words));
    if (c.needs_reason())
        c.because("the filter's corner is 2 Hz, and what it holds at a ramp's end goes on driving the neuron (errata B13)");
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const auto sa1 = train_of({"sa1"}), fa1 = train_of({"fa1"});
    const auto force = press::samples(1e-3);
    if (!sa1) return sa1.error();
    if (!fa1) return fa1.error();
    if (!force) return force.error();
    if (auto ok = options.at(0.5); !ok) return ok.error();
    slow(out, *sa1), fast(out, *fa1);
    const auto ahead = press::frequency(*sa1), behind = press::frequency_behind(*sa1);
    out.claim("SA-I: time of the peak, each frequency drawn at the interval's start", ahead.peak(), "s");
    out.claim("the same, drawn at the interval's end", behind.peak(), "s");
    for (const auto& [name, train] : {std::pair{"SA-I", &*sa1}, {"FA-I", &*fa1}})
        out.plot(fmt::format("{}: instantaneous frequency", name), "time (s)", "frequency (Hz)")
            .points("to the next spike, at the first", press::frequency(*train))
            .points("the same at the second", press::frequency_behind(*train))
            .add("force, 10 Hz for a newton", force->times(1, 10))
            .shape(name == std::string_view("SA-I")
                       ? "high in protraction, sustained and slowly decaying in the plateau, almost nothing in retraction"
                       : "discharges in protraction and retraction only, unequally high");
    out.note(
        "The thesis draws a frequency at the spike that begins the interval (3.3), so the last spike has none (errata B14); many tools "
        "draw it at "
        "the one that ends it. An interval that begins in protraction and ends in the plateau is protraction's here.");
    out.note(
        "Frequencies go with 1 / (theta - u_rst), which are not printed: 0.25 V are a choice (errata B10a). Single units at 4 N peak at 50 "
        "to 150 Hz, SA-I holding 20 to 50 Hz, from memory, unverified.");
    out.note(
        "That nearly all of the 196 afferents answered was read in the paper's abstract; that they were 73 SA-I, 41 SA-II, 72 FA-I and 10 "
        "FA-II is "
        "from memory, unverified. The paper's curves are of populations: one model of one unit has no spread to show.");
    return out;
}

const Study study{
    "fig5", "Instantaneous discharge frequency under the press",
    "SA-I: high in protraction, sustained but slowly decaying in the plateau, almost none in retraction. FA-I: asymmetrical discharges in "
    "protraction and retraction only. Thesis 1.2, fig. 5, after Birznieks et al. 2001",
    work};

}  // namespace corpuscle::studies::fig5
