// Thesis fig. 11: a passive and an active high-pass, made of an ideal resistor, an ideal transconductor, and transistors.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle::studies::fig11 {

/// A plain inverter and INVC as loads, each with its output tied to its input.
constexpr auto loads = R"(Currents of loads
.lib '../process/tsmc180.lib' tt
.include 'parts/transconductor.inc'
vdd vdd 0 0.7
ibias gp 0 200n
xbias vdd gp bp bn bias
vin in 0 0.35
ea a 0 in 0 1
xa a a vdd bp bn inva
ec c 0 in 0 1
xc c c gpc gnc vdd bp bn invc
.dc vin 0.15 0.55 5m
.save i(ea) i(ec)
.end
)";
/// Filter C (8.8 pF) with INVC and with a resistor r, under a step of voltage of `size` from half the supply, at 50 ms.
constexpr auto steps = R"(High-passes under a step
.lib '../process/tsmc180.lib' tt
.include 'parts/transconductor.inc'
.param size=20m r=1g
vdd vdd 0 0.7
ibias gp 0 200n
xbias vdd gp bp bn bias
vf vf 0 pwl(0 0.35 50m 0.35 50.1m {0.35+size})
cc vf hp 8.8p
xc hp hp gpc gnc vdd bp bn invc
ca vf a 8.8p
ra a mid {r}
vmid mid 0 0.35
.tran 1m 0.4
.save v(hp) v(a)
.end
)";
constexpr double half = 0.35, offset = 0.1,
                 on = 50.1e-3;  // V: half the supply; V: distance from it at which loads are compared; s: end of the step's rise

/// Largest absolute difference between two curves with the same x.
double largest_difference(const StudyCurve& a, const StudyCurve& b) {
    double out = 0;
    for (std::size_t k = 0; k < a.x.size(); ++k) out = std::max(out, std::abs(a.y[k] - b.y[k]));
    return out;
}

void add_ideal_claims(StudyResult& out, const NetlistResult& ideal) {
    const auto a = ideal.curve("ac", "vm(a)"), b = ideal.curve("ac", "vm(b)");
    out.claim("ideal: largest difference of the active filter's gain from the passive one's", largest_difference(a, b))
        .allow_max(1e-6, "thesis 2.3: tau = C / G_m instead of RC; R is 1 / G_m here");
    for (const auto& [node, C, printed] : {std::tuple{"b", 0.8e-12, 30.0}, {"c", 8.8e-12, 2.7}}) {
        const double f = ideal.curve("ac", fmt::format("vp({})", node)).crossing(M_PI / 4);
        out.claim(fmt::format("ideal, 6.6 Gohm and {:.2g} pF: corner", C * 1e12), f, "Hz").published_as(printed, "thesis 4.3.1");
        out.claim(fmt::format("ideal, {:.2g} pF: tau over C / G_m", C * 1e12), 1 / (2 * M_PI * f) / (C * 6.6e9))
            .derived_as(1, "thesis 2.3");
    }
    out.plot("Gain", "frequency (Hz)", "gain", true, true)
        .add("passive: C and R", a)
        .add("active: C and G_m", b)
        .add("active, eleven times the C", ideal.curve("ac", "vm(c)"))
        .describe_published("the same high-pass, with 1 / G_m instead of R");
}

/// A load's current times its resistance at half the supply (V), over the voltage relative to half the supply (V). A resistor gives y = x.
StudyCurve normalised_current(const StudyCurve& current) {
    const double slope = current.slope_at(half), middle = current.at(half);
    StudyCurve out;
    for (std::size_t k = 0; k < current.x.size(); ++k)
        out.x.push_back(current.x[k] - half), out.y.push_back((current.y[k] - middle) / slope);
    return out;
}
/// Largest deviation (%) of a normalised current from a resistor's, at the voltages +offset and -offset.
double nonlinearity(const StudyCurve& normalised) {
    return 100 * std::max(std::abs(normalised.at(-offset) / offset + 1), std::abs(normalised.at(offset) / offset - 1));
}

void add_load_claims(StudyResult& out, const NetlistResult& found) {
    const auto plain = normalised_current(found.curve("dc", "i(ea)")), invc = normalised_current(found.curve("dc", "i(ec)"));
    out.claim("a plain inverter as a load: nonlinearity of its current at 100 mV", nonlinearity(plain), "%")
        .allow_min(5, "thesis 2.3: active devices are very non-linear by nature; more than 5 % is our choice");
    out.claim("INVC as a load: nonlinearity of its current at 100 mV", nonlinearity(invc), "%")
        .allow_max(nonlinearity(plain), "thesis 2.3: techniques that balance linearity and low transconductance");
    out.plot("Current times the resistance at half the supply", "voltage from half the supply (V)", "current times resistance (V)")
        .add("plain inverter", plain)
        .add("INVC", invc)
        .add("resistor", {{-0.2, 0.2}, {-0.2, 0.2}})
        .describe_published("a resistor obeys Ohm's law; a transconductor of transistors does not");
}

/// Fraction of a voltage step that remains at the filter's output 50 ms later, with INVC, v(hp), and with the resistor, v(a).
struct Remainder {
    double invc, resistor;
};
/// For a step of `size` (V) and a resistor of `resistance` (ohm). Adds the responses to `plot`, unless it is null.
Result<Remainder> remainder_after_step(double size, double resistance, StudyPlot* plot) {
    const auto found = run_study_netlist({steps, {fmt::format("size={}", size), fmt::format("r={}", resistance)}, {}});
    if (!found) return found.error();
    // relative to the voltage before the step, as a fraction of the voltage at its end
    const auto normalised_step = [&](const char* node) {
        auto v = found->curve("tran", node);
        const double before = v.at(on - 2e-4), top = v.at(on + 1e-4) - before;
        for (double& y : v.y) y = (y - before) / top;
        return v;
    };
    const auto hp = normalised_step("v(hp)"), a = normalised_step("v(a)");
    if (plot) plot->add(fmt::format("INVC, {:g} mV", size * 1e3), hp);
    if (plot && size > offset) plot->add("resistor", a);
    return Remainder{hp.at(on + 50e-3), a.at(on + 50e-3)};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const auto ideal = run_study_netlist({"high_pass_ideal", {}, ".ac dec 50 10m 10k"}), real_loads = run_study_netlist({loads, {}, {}});
    if (!ideal) return ideal.error();
    if (!real_loads) return real_loads.error();
    add_ideal_claims(out, *ideal), add_load_claims(out, *real_loads);
    if (auto ok = options.report_progress(0.5); !ok) return ok.error();
    const double resistance = 1 / real_loads->curve("dc", "i(ec)").absolute().slope().absolute().at(half + 10e-3);
    StudyPlot plot{"Response to a step, relative to the voltage before it", "time (s)", "fraction of the step", {}};
    const auto small = remainder_after_step(20e-3, resistance, &plot), large = remainder_after_step(200e-3, resistance, &plot),
               resistor = remainder_after_step(20e-3, resistance, nullptr);
    for (const auto* p : {&small, &large, &resistor})
        if (!*p) return p->error();
    out.claim("resistor: remainder of 200 mV after 50 ms, over that of 20 mV", large->resistor / small->resistor)
        .derived_as(1, "thesis 2.3: linear");
    out.claim("INVC: remainder of 200 mV after 50 ms, over that of 20 mV", large->invc / small->invc)
        .allow_max(1, "thesis 2.3: large signals are distorted; beyond its linear range INVC takes more current than a resistor");
    out.plots.push_back(std::move(plot));
    out.note(
        "Of the circuits for a low transconductance in the references (bulk- or drain-driven inputs, pseudo-resistors) only those of "
        "figs. 12 and 13 and the thesis's own are simulated here.");
    return out;
}

const Study study{"fig11", "Passive and active high-pass",
                  "An active load of transconductance G_m replaces R, so tau = C / G_m. A resistor and an ideal transconductor are linear; "
                  "transistors are not. Thesis 2.3, fig. 11",
                  compute};

}  // namespace corpuscle::studies::fig11
