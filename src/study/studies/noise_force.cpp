// What the circuits' noise is as a force: sensor, transducer, signal processing and oscillator input of SA-I, at 0.2 and at 4 N, from 1 Hz
// (the press lasts a second; what is slower is drift) to 100 Hz (above it no afferent here fires, and filter B ends at 30 Hz).

#include <fmt/format.h>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/force_sensor.hpp"

namespace corpuscle::studies::noise_force {

constexpr double from = 1, to = 100;  // Hz
constexpr double boltzmann = 1.380649e-23, kelvin = 300.15;
constexpr double repeats = 0.02;  // of the force: the sensor's own repeatability, by its data sheet

/// Sensor, transducer and signal processing as circuits/sa1.cir has them; the membrane is held at half the supply.
const std::string chain = R"(Force to membrane current
.lib '../process/tsmc180.lib' tt
.include 'parts/transducer.inc'
.include 'parts/asp_sa1.inc'
vdd vdd 0 0.7
vy vy 0 0.1
vforce force 0 0.2
xfsr force vx 0 fsr
iba pga 0 100n
xtransducer vx top vy pga vdd transducer
vif if top 0
ibb pgb 0 200n
ibf vdd gf 700n
vu u 0 0.35
hf i_f 0 vif 1
hi i_m 0 vi 1
rf i_f 0 1g
ri i_m 0 1g
.nodeset v(xrectb.en)=0 v(xrectc.en)=0 v(xrectb.cmp)=0.5 v(xrectc.cmp)=0.5
)";
const std::string oscillator = R"(What the oscillator's input adds to the membrane current
.lib '../process/tsmc180.lib' tt
.include 'parts/trigger.inc'
.include 'parts/oscillator.inc'
vdd vdd 0 0.7
xcco u s gl gc vdd oscillator c_u=4.5p
ilk gl 0 7p
ich gc 0 1n
vu u 0 0.35
hu out 0 vu 1
ro out 0 1g
.nodeset v(s)=0 v(xcco.sb)=0.7
)";

/// Force noise in the band at one place of a netlist with a source vforce, N rms.
Result<double> as_force(const std::string& circuit, const std::string& output, double newtons, const std::string& more = "") {
    const auto found =
        found_in({circuit, {fmt::format("vforce={}", newtons)}, more + fmt::format(".noise v({}) vforce dec 20 {} {}", output, from, to)});
    if (!found) return found.error();
    return found->number("inoise_total");
}

/// dI/dF of the membrane current, A/N.
Result<double> gain(double newtons) {
    const auto found = found_in({chain, {}, fmt::format(".dc vforce {} {} {}", 0.99 * newtons, 1.01 * newtons, 0.005 * newtons)});
    if (!found) return found.error();
    return found->line("dc", "i(vi)").slope_at(newtons);
}

/// Of the sensor as a resistor, N rms.
double of_sensor(double newtons) {
    const ForceSensor sensor;
    const double gf = newtons / gram_force;
    return std::sqrt(4 * boltzmann * kelvin * sensor.conductance(gf) * (to - from)) / (0.1 * sensor.slope(gf) / gram_force);
}

struct Parts {
    double sensor, transducer, processing, oscillator, chain, filter_B, filter_C;
};
Result<Parts> parts_at(double newtons) {
    const auto dI_dF = gain(newtons);
    const auto cco = found_in({oscillator, {}, fmt::format(".noise v(out) ilk dec 20 {} {}", from, to)});
    if (!dI_dF) return dI_dF.error();
    if (!cco) return cco.error();
    const std::string read = "ha i_a 0 via 1\nra i_a 0 1g\n";
    const auto t = as_force(chain, "i_f", newtons), all = as_force(chain, "i_m", newtons), asp = as_force("asp_sa1", "i_a", newtons, read);
    const auto b = as_force(chain, "hpb", newtons), c = as_force(chain, "hpc", newtons);
    for (const auto* r : {&t, &all, &asp, &b, &c})
        if (!*r) return r->error();
    return Parts{of_sensor(newtons), *t, *asp, cco->number("onoise_total") / *dI_dF, *all, *b, *c};
}

Result<void> tell(Outcome& out, double newtons) {
    const auto p = parts_at(newtons);
    if (!p) return p.error();
    const auto what = [&](const char* words) { return fmt::format("{:g} N: {}", newtons, words); };
    const double total = std::hypot(p->sensor, p->chain, p->oscillator);
    out.claim(what("sensor, as a resistor (4 k T G)"), p->sensor, "N");
    out.claim(what("transducer, at I_F"), p->transducer, "N");
    out.claim(what("signal processing, at I_A"), p->processing, "N");
    out.claim(what("transducer and signal processing, at the membrane"), p->chain, "N");
    out.claim(what("oscillator's input, by dI/dF"), p->oscillator, "N");
    out.claim(what("all of it"), total, "N")
        .at_most(repeats * newtons,
                 "thesis E.4: \"adequate for its application\"; taken here as below the sensor's own repeatability, 2 % of the force "
                 "(FSR 400 series data sheet, Interlink)");
    out.claim(what("filter B's output alone"), p->filter_B, "N").at_most(repeats * newtons, "the same");
    out.claim(what("filter C's output alone"), p->filter_C, "N").at_most(repeats * newtons, "the same");
    out.claim(what("of the press's 3.8 N, all of it"), 100 * total / 3.8, "%");
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    for (const double newtons : {0.2, 4.0}) {
        if (auto ok = tell(out, newtons); !ok) return ok.error();
        if (auto ok = options.at(newtons / 10); !ok) return ok.error();
    }
    Plot& spectrum = out.plot("Noise of transducer and signal processing as a force", "frequency (Hz)", "mN / sqrt(Hz)");
    spectrum.log_x = spectrum.log_y = true;
    for (const double newtons : {0.2, 4.0})
        for (const auto& [name, node] : {std::pair{"transducer", "i_f"}, {"at the membrane", "i_m"}}) {
            const auto found =
                found_in({chain, {fmt::format("vforce={}", newtons)}, fmt::format(".noise v({}) vforce dec 10 0.1 1k", node)});
            if (!found) return found.error();
            spectrum.add(fmt::format("{}, {:g} N", name, newtons), found->line("noise", "inoise_spectrum").times(1, 1e3));
        }
    Line transducer, membrane, sensor;
    for (const double newtons : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        const auto t = as_force(chain, "i_f", newtons), m = as_force(chain, "i_m", newtons);
        if (!t) return t.error();
        if (!m) return m.error();
        for (auto [line, value] : {std::pair{&transducer, *t}, {&membrane, *m}, {&sensor, repeats * newtons}})
            line->x.push_back(newtons), line->y.push_back(1e3 * value);
    }
    Plot& along = out.plot("Noise from 1 to 100 Hz along the force", "force (N)", "mN rms");
    along.log_x = along.log_y = true;
    along.add("transducer", transducer).add("at the membrane", membrane).add("2 %, the sensor's repeatability", sensor);
    out.note(
        "By .noise about rest: force stands still, the rectifiers of I_B and I_C are open, so that the membrane has I_A's noise alone; "
        "what I_B and I_C "
        "add while the force moves is told at the filters' outputs. The oscillator's trigger (jitter of its thresholds) is left out.");
    out.note(
        "The thesis names no resolution of the sensor and no noise of the chain. The sensor's own 1/f noise is left out: no number is "
        "known of it. "
        "The card's 1/f noise is a choice (process/tsmc180.lib).");
    return out;
}

const Study study{"noise-force", "The circuits' noise as a force",
                  "The thesis names noise as the price of analog processing (1.3) and calls INVC's adequate for its application (E.4); how "
                  "many newtons is "
                  "it?",
                  work};

}  // namespace corpuscle::studies::noise_force
