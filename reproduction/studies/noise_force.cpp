// The circuits' noise expressed as a force: sensor, transducer, signal processing and oscillator input of SA-I, at 0.2 and 4 N. The band is
// 1 Hz (the stimulus lasts a second; slower noise is drift) to 100 Hz (no afferent here fires faster, and filter B ends at 30 Hz).

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/force_sensor.hpp"

namespace corpuscle::studies::noise_force {

constexpr double from = 1, to = 100;                         // Hz
constexpr double boltzmann = 1.380649e-23, kelvin = 300.15;  // J/K; K
constexpr double repeatability = 0.02;                       // fraction of the force: the sensor's repeatability, from its data sheet

/// Sensor, transducer and signal processing as in circuits/sa1.cir; the membrane is held at half the supply. Nodes i_f and i_m have I_F and
/// the membrane current as voltages, 1 V per A.
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
/// The oscillator with its membrane held; node out has the noise current as a voltage, 1 V per A.
const std::string oscillator = R"(Noise current of the oscillator's input
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

/// The noise in the band at node `output` of a netlist, expressed as a force (N rms) at its source vforce, at a mean force of `newtons`.
Result<double> force_noise(const std::string& circuit, const std::string& output, double newtons, const std::string& extra_lines = "") {
    const auto found = TRY(run_study_netlist(
        {circuit, {fmt::format("vforce={}", newtons)}, extra_lines + fmt::format(".noise v({}) vforce dec 20 {} {}", output, from, to)}));
    return found.number("inoise_total");
}

/// dI/dF of the membrane current (A/N) at this force.
Result<double> gain(double newtons) {
    const auto found =
        TRY(run_study_netlist({chain, {}, fmt::format(".dc vforce {} {} {}", 0.99 * newtons, 1.01 * newtons, 0.005 * newtons)}));
    return found.curve("dc", "i(vi)").slope_at(newtons);
}

/// Thermal noise of the sensor, taken as a resistor with 0.1 V across it, in the band, N rms.
double sensor_noise(double newtons) {
    const double gf = newtons / gram_force;
    return std::sqrt(4 * boltzmann * kelvin * sensor_conductance(gf) * (to - from)) / (0.1 * sensor_slope(gf) / gram_force);
}

struct NoiseParts {
    // N rms. chain: transducer and signal processing together; filter_B, filter_C: the same up to the output of the filter
    double sensor, transducer, processing, oscillator, chain, filter_B, filter_C;
};
Result<NoiseParts> noise_parts(double newtons) {
    const auto dI_dF = gain(newtons);
    const auto cco = run_study_netlist({oscillator, {}, fmt::format(".noise v(out) ilk dec 20 {} {}", from, to)});
    TRY(check_all(dI_dF, cco));
    const std::string readout = "ha i_a 0 via 1\nra i_a 0 1g\n";
    const auto t = force_noise(chain, "i_f", newtons), all = force_noise(chain, "i_m", newtons),
               asp = force_noise("asp_sa1", "i_a", newtons, readout);
    const auto b = force_noise(chain, "hpb", newtons), c = force_noise(chain, "hpc", newtons);
    TRY(check_all(t, all, asp, b, c));
    return NoiseParts{sensor_noise(newtons), *t, *asp, cco->number("onoise_total") / *dI_dF, *all, *b, *c};
}

Result<void> add_claims(StudyResult& out, double newtons) {
    const auto p = TRY(noise_parts(newtons));
    const auto label = [&](const char* quantity) { return fmt::format("noise at {:g} N: {}", newtons, quantity); };
    const double total = std::hypot(p.sensor, p.chain, p.oscillator);
    out.claim(label("sensor, as a resistor (4 k T G)"), p.sensor, "N");
    out.claim(label("transducer, at I_F"), p.transducer, "N");
    out.claim(label("signal processing, at I_A"), p.processing, "N");
    out.claim(label("transducer and signal processing, at the membrane"), p.chain, "N");
    out.claim(label("oscillator's input, from dI/dF"), p.oscillator, "N");
    out.claim(label("total of sensor, transducer, signal processing and oscillator"), total, "N")
        .allow_max(repeatability * newtons,
                   "thesis E.4: \"adequate for its application\"; taken here as below the sensor's own repeatability, 2 % of the force "
                   "(FSR 400 series data sheet, Interlink)");
    out.claim(label("at filter B's output"), p.filter_B, "N").allow_max(repeatability * newtons, "the sensor's own repeatability");
    out.claim(label("at filter C's output"), p.filter_C, "N").allow_max(repeatability * newtons, "the sensor's own repeatability");
    out.claim(label("total, over the 3.8 N range of the press stimulus"), 100 * total / 3.8, "%");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    for (const double newtons : {0.2, 4.0}) {
        TRY(add_claims(out, newtons));
        TRY(options.report_progress(newtons / 10));
    }
    StudyPlot& spectrum = out.plot("Noise of transducer and signal processing as a force", "frequency (Hz)", "mN / sqrt(Hz)");
    spectrum.log_x = spectrum.log_y = true;
    for (const double newtons : {0.2, 4.0})
        for (const auto& [name, node] : {std::pair{"transducer", "i_f"}, {"at the membrane", "i_m"}}) {
            const auto found =
                run_study_netlist({chain, {fmt::format("vforce={}", newtons)}, fmt::format(".noise v({}) vforce dec 10 0.1 1k", node)});
            if (!found) return found.error();
            spectrum.add(fmt::format("{}, {:g} N", name, newtons), found->curve("noise", "inoise_spectrum").scaled(1, 1e3));
        }
    StudyCurve transducer, membrane, sensor;
    for (const double newtons : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        const auto t = force_noise(chain, "i_f", newtons), m = force_noise(chain, "i_m", newtons);
        TRY(check_all(t, m));
        for (auto [line, value] : {std::pair{&transducer, *t}, {&membrane, *m}, {&sensor, repeatability * newtons}})
            line->x.push_back(newtons), line->y.push_back(1e3 * value);
    }
    StudyPlot& by_force = out.plot("Noise from 1 to 100 Hz over the force", "force (N)", "mN rms");
    by_force.log_x = by_force.log_y = true;
    by_force.add("transducer", transducer).add("at the membrane", membrane).add("2 %, the sensor's repeatability", sensor);
    out.note(
        "The .noise analysis linearises about the operating point: the force is constant and the rectifiers of I_B and I_C are open, so "
        "the membrane has only I_A's noise. The claims at the filters' outputs show the noise of I_B and I_C while the force changes. The "
        "oscillator's trigger (jitter of its thresholds) is left out.");
    out.note(
        "The thesis gives no resolution of the sensor and no noise of the chain. The sensor's 1/f noise is left out because no value is "
        "known. The 1/f noise of the process card is our choice (process/tsmc180.lib).");
    return out;
}

const Study study{
    "noise-force", "The circuits' noise as a force",
    "The thesis names noise as the price of analog processing (1.3) and calls INVC's noise adequate for its application (E.4). "
    "How large is the noise as a force?",
    ClaimKind::ours, compute};

}  // namespace corpuscle::studies::noise_force
