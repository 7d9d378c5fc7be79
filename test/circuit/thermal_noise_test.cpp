// Thermal and shot noise compared with their laws: kT/C, 4kTg, 2qI.

#include <fmt/format.h>
#include <numbers>

#include "netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double boltzmann = 1.380649e-23, charge = 1.602176634e-19;
double kelvin(double celsius) { return celsius + 273.15; }

// The total is integrated from 200 points per decade, with a power law of f between two points, which causes an error of 2e-5. The noise at
// more than five decades from the corner is missing: 1.3e-5.
TEST(ThermalNoise, OfAnyResistorIsKTByCOnACapacitor) {
    for (const auto& [R, C] : {std::pair{1e3, 1e-9}, {413e3, 8.8e-12}, {6.6e9, 0.8e-12}})
        for (const double celsius : {-55.0, 27.0, 125.0}) {
            const double corner = 1 / (2 * std::numbers::pi * R * C);
            const auto run =
                run_netlist(fmt::format("kT/C\nv1 in 0 0\nr1 in out {}\nc1 out 0 {}\n.temp {}\n.noise v(out) v1 dec 200 {} {}\n", R, C,
                                        celsius, corner * 1e-5, corner * 1e5));
            EXPECT_NEAR(std::pow(run.number("onoise_total"), 2) / (boltzmann * kelvin(celsius) / C), 1, 5e-5) << R << " ohm";
        }
}

TEST(ThermalNoise, OfManyResistorsIsTogetherKTByC) {
    const auto run = run_netlist(
        "kT/C\ni1 0 a 0\nr1 a b 1k\nr2 b 0 10k\nr3 b c 100k\nr4 c a 3k\nr5 a 0 1meg\nc1 a 0 1n\n.noise v(a) i1 dec 200 100m 1g\n");
    EXPECT_NEAR(std::pow(run.number("onoise_total"), 2) / (boltzmann * kelvin(27) / 1e-9), 1, 5e-5);
}

TEST(ThermalNoise, OfAResistorIs4kTRTimesTheBandwidthFromZeroHertz) {
    for (const int points : {2, 3, 101}) {
        const auto run = run_netlist(fmt::format("white\nv1 in 0 0\nr1 in out 1k\n.noise v(out) v1 lin {} 0 1k\n", points));
        EXPECT_NEAR(std::pow(run.number("onoise_total"), 2) / (4 * boltzmann * kelvin(27) * 1e3 * 1e3), 1, 1e-6) << points;
        EXPECT_NEAR(run.number("inoise_total"), run.number("onoise_total"), 1e-15) << points;
    }
}

TEST(ThermalNoise, ReferredToASourceThatDoesNotReachTheOutputIsFinite) {
    const auto run = run_netlist("apart\nv1 in 0 1\nr0 in 0 1\nr1 out 0 1k\nr2 other 0 1k\n.noise v(out) v1 dec 2 1 1k\n");
    EXPECT_GT(run.number("inoise_total"), 0);
    EXPECT_TRUE(std::isfinite(run.number("inoise_total")));
}

/// A transistor of the card whose drain is connected only to a capacitor: at rest V_DS = 0. A current drives it in .ac, so v(d) is the
/// impedance of the drain and the capacitor.
std::string open_drain(const char* type, double gate, double bulk, double celsius, const std::string& more_lines, double from, double to) {
    return fmt::format(
        "open drain\n.lib 'tsmc180.lib' tt\nvg g 0 {}\nvb b 0 {}\ni1 0 d ac 1\nm1 d g 0 b {} w=1.5u l=0.5u m=2 stack=8\n.temp {}\n"
        ".options gmin=0\n{}\n.ac dec 1 {} {}\n.noise v(d) i1 dec 200 {} {}\n",
        gate, bulk, type, celsius, more_lines, from, to, from, to);
}

// C includes the drain's own capacitances from .ac, 1.5 to 12 fF here. The junction's shot noise, 2q times twice its saturation current,
// exceeds 4kT times its conductance by the factor n_dio = 1.05. This matters only where the channel conducts less than the junction.
TEST(ThermalNoise, OfATransistorIsKTByCWithItsOwnCapacitances) {
    for (const char* type : {"nch", "pch", "nch_hv"})
        for (const double gate : {0.3, 0.5, 0.9, 1.8})
            for (const char* load : {"", "c1 d 0 3f", "c1 d 0 1p"})
                for (const double celsius : {-55.0, 27.0, 95.0}) {
                    const double sign = type[0] == 'p' ? -1 : 1;
                    const auto impedance_run = run_netlist(open_drain(type, sign * gate, 0, celsius, load, 1, 1e6));
                    const auto y = 1.0 / impedance_run.complex_curve("v(d)")[0];  // at 1 Hz
                    const double C = y.imag() / (2 * std::numbers::pi), corner = y.real() / (2 * std::numbers::pi * C);
                    const auto run = run_netlist(open_drain(type, sign * gate, 0, celsius, load, corner * 1e-5, corner * 1e5));
                    EXPECT_NEAR(std::pow(run.number("onoise_total"), 2) / (boltzmann * kelvin(celsius) / C), 1, 1e-4)
                        << type << " V_G " << gate << " at " << celsius << " C, " << C << " F, corner " << corner << " Hz";
                }
}

/// Noise density of a transistor's drain current (A^2/Hz) at 1 Hz without flicker noise, and its current and conductance.
struct Drain {
    double S, I, g;
    Drain(const std::string& model, double d, double g, double b, double celsius = 27) {
        const auto run =
            run_netlist(fmt::format("drain\n{}\nvg g 0 {}\nvb b 0 {}\nvd d 0 {} ac 1\nm1 d g 0 b x w=1.5u l=0.5u\nh1 out 0 vd 1\nr1 out 0 "
                                    "1\n.temp {}\n.options gmin=0\n.op\n.ac lin 1 1 1\n.noise v(out) vd lin 1 1 1\n",
                                    model, g, b, d, celsius));
        S = std::pow(run.number("onoise_spectrum"), 2);
        I = -run.number("i(vd)");
        this->g = -run.complex_curve("i(vd)", "ac").back().real();
    }
};
constexpr const char* plain = ".model x nmos(level=80 isq=112n vto=0.46 n=1.27 zetal=0 ve=1e30 nt=0 js=0 jssw=0)";
constexpr const char* full = ".model x nmos(level=80 isq=112n vto=0.46 n=1.27 zetal=15n ve=8e6 nt=0 js=0 jssw=0)";

TEST(ThermalNoise, InWeakInversionIsShotNoiseOfBothDirections) {
    for (const double V_DS : {1e-3, 10e-3, 50e-3, 0.1, 0.3, 0.7})
        for (const double celsius : {-55.0, 27.0, 95.0}) {
            const Drain at(plain, V_DS, 0, 0, celsius);
            const double v_t = boltzmann * kelvin(celsius) / charge;
            EXPECT_NEAR(at.S / (2 * charge * at.I / std::tanh(V_DS / (2 * v_t))), 1, 1e-4) << V_DS;  // i_f is at most 1e-4
        }
}

TEST(ThermalNoise, InSaturationIs2qIInWeakAndTwoThirdsOf4kTgmsInStrongInversion) {
    const Drain weak(plain, 0.5, 0.1, 0), strong(plain, 3, 4, 0);
    EXPECT_NEAR(weak.S / (2 * charge * weak.I), 1, 1e-4);
    const double v_t = boltzmann * kelvin(27) / charge, I_S = 112e-9 * 3;
    const double g_ms = 2 * I_S / v_t * (std::sqrt(1 + strong.I / I_S) - 1);     // thesis eq. 28
    EXPECT_NEAR(strong.S / (4 * boltzmann * kelvin(27) * g_ms), 2.0 / 3, 0.01);  // the limit; the difference is 1 / (1 + i_f)^(1/2)
}

TEST(ThermalNoise, AtZeroDrainVoltageIs4kTg) {
    for (const char* model : {plain, full})
        for (const double gate : {0.0, 0.3, 0.46, 0.7, 1.8})
            for (const double bulk : {-0.3, 0.0, 0.4})
                for (const double celsius : {-55.0, 27.0, 95.0}) {
                    const Drain at(model, 0, gate, bulk, celsius);
                    EXPECT_NEAR(at.S / (4 * boltzmann * kelvin(celsius) * at.g), 1, 1e-9) << gate << ", bulk " << bulk;
                }
}

}  // namespace
}  // namespace corpuscle::circuit
