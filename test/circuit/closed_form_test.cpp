// Netlists with closed-form solutions, or solutions of one scalar equation that the test solves itself.

#include <fmt/format.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "netlist_runner.hpp"
#include "support/raw_file.hpp"

namespace corpuscle::circuit {
namespace {

using Complex = std::complex<double>;
constexpr double pi = 3.14159265358979323846;
constexpr double v_t = 1.380649e-23 * 300.15 / 1.602176634e-19;

/// Compares a curve of .ac with a function of j omega, relative to its magnitude; differences below `rounding` are ignored.
void expect_curve(const NetlistRun& ran, const std::string& name, double tolerance, const std::function<Complex(Complex s)>& formula,
                  double rounding = 0) {
    const auto f = ran.curve("frequency");
    const auto run = ran.complex_curve(name);
    ASSERT_EQ(run.size(), f.size());
    for (std::size_t k = 0; k < f.size(); ++k) {
        const Complex wanted = formula({0, 2 * pi * f[k]});
        EXPECT_LE(std::abs(run[k] - wanted), tolerance * std::abs(wanted) + rounding)
            << name << " at " << f[k] << " Hz: " << run[k] << ", not " << wanted;
    }
}

TEST(ClosedForm, ALowPassHasOnePoleOverTwelveDecades) {
    for (const auto& [R, C] : {std::pair{1e3, 1e-6}, {413e3, 8.8e-12}, {6.6e9, 0.8e-12}}) {
        const auto run = run_netlist(fmt::format("low-pass\nv1 in 0 ac 1\nr1 in out {}\nc1 out 0 {}\n.ac dec 10 1m 1g\n", R, C));
        expect_curve(run, "v(out)", 1e-12, [r = R, c = C](Complex s) { return 1.0 / (1.0 + s * r * c); }, 3e-16);
        expect_curve(run, "i(v1)", 1e-12, [r = R, c = C](Complex s) { return -s * c / (1.0 + s * r * c); }, 3e-16 / R);
    }
}

TEST(ClosedForm, ASeriesRLCResonates) {
    const double R = 2, L = 10e-6, C = 100e-12;  // Q is 158, at 5.03 MHz
    const auto run = run_netlist("series\nv1 in 0 ac 1\nl1 in a 10u\nc1 a out 100p\nr1 out 0 2\n.ac dec 200 100k 100meg\n");
    expect_curve(run, "v(out)", 1e-9, [=](Complex s) { return R / (R + s * L + 1.0 / (s * C)); });
    expect_curve(run, "v(a,out)", 1e-9, [=](Complex s) { return 1.0 / (s * C) / (R + s * L + 1.0 / (s * C)); });
    expect_curve(run, "i(l1)", 1e-9, [=](Complex s) { return 1.0 / (R + s * L + 1.0 / (s * C)); });
    const auto at =
        run_netlist(fmt::format("at resonance\nv1 in 0 ac 1\nl1 in a 10u\nc1 a out 100p\nr1 out 0 2\n.ac lin 1 {0:.17g} {0:.17g}\n",
                                1 / (2 * pi * std::sqrt(L * C))));
    EXPECT_LE(std::abs(at.complex_curve("v(out)")[0] - 1.0), 1e-9);
    EXPECT_NEAR(std::abs(at.complex_curve("v(a,out)")[0]), std::sqrt(L / C) / R, 1e-7);
}

TEST(ClosedForm, AParallelRLCResonates) {
    const double G = 1 / 50e3, L = 1e-3, C = 1e-9;
    const auto run = run_netlist("parallel\ni1 0 a ac 1\nr1 a 0 50k\nl1 a 0 1m\nc1 a 0 1n\n.ac dec 200 10 100meg\n");
    expect_curve(run, "v(a)", 1e-9, [=](Complex s) { return 1.0 / (G + s * C + 1.0 / (s * L)); });
    expect_curve(run, "i(l1)", 1e-9, [=](Complex s) { return 1.0 / (s * L) / (G + s * C + 1.0 / (s * L)); });
}

/// Root of a rising function between `low` and `high`.
double crossing(double low, double high, const std::function<double(double)>& f) {
    for (int k = 0; k < 200; ++k) {
        const double mid = 0.5 * (low + high);
        (f(mid) < 0 ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

TEST(ClosedForm, DiodesAndResistorsInSeriesMatchTheirScalarEquation) {
    for (const int count : {1, 3, 20})
        for (const double volt : {0.1, 3.0, 200.0}) {
            std::string text = fmt::format("series\nv1 n0 0 {}\n.model dx d(is=1e-14 n=1.3)\n.options gmin=0\n", volt);
            for (int k = 0; k < count; ++k)
                text += fmt::format("r{0} n{0} m{0} 1k\nd{0} m{0} {1} dx\n", k, k + 1 < count ? fmt::format("n{}", k + 1) : "0");
            const double I =
                crossing(0, volt / (1e3 * count), [&](double i) { return count * (i * 1e3 + 1.3 * v_t * std::log1p(i / 1e-14)) - volt; });
            EXPECT_NEAR(-run_netlist(text + ".op\n").number("i(v1)") / I, 1, 1e-6) << count << " at " << volt << " V";
        }
}

TEST(ClosedForm, ALadderOfDiodesMatchesTheShootingMethod) {
    for (const int count : {2, 10, 40})
        for (const double volt : {0.5, 5.0}) {
            std::string text = fmt::format("ladder\nv1 n0 0 {}\n.model dx d(is=1e-14)\n.options gmin=0\n", volt);
            for (int k = 0; k < count; ++k) text += fmt::format("r{0} n{0} n{1} 100\nd{0} n{1} 0 dx\n", k, k + 1);
            const auto start = [&](double end) {  // the first node's voltage for a given voltage of the last node
                double v = end, i = 0;
                for (int k = 0; k < count && v < 2 * volt; ++k) i += 1e-14 * std::expm1(v / v_t), v += 100 * i;
                return v;
            };
            const double end = crossing(0, volt, [&](double v) { return start(v) - volt; });
            EXPECT_NEAR(run_netlist(text + ".op\n").number(fmt::format("v(n{})", count)), end, 1e-8 * end)
                << count << " at " << volt << " V";
        }
}

TEST(ClosedForm, AnR2RLadderMakesBinaryWeights) {
    constexpr int bits = 12;
    for (const int code : {0, 1, 2, 0x800, 0x555, 0xfff}) {
        std::string text = "R-2R\nr0 n0 0 2k\n";
        for (int k = 0; k < bits; ++k) {
            text += fmt::format("v{0} b{0} 0 {1}\nrb{0} b{0} n{0} 2k\n", k, (code >> k) & 1);
            if (k > 0) text += fmt::format("rs{0} n{1} n{0} 1k\n", k, k - 1);
        }
        const auto run = run_netlist(text + fmt::format(".op\n.tf v(n{0}) v{0}\n", bits - 1));
        EXPECT_NEAR(run.number(fmt::format("v(n{})", bits - 1)), code / 4096.0, 1e-13);
        EXPECT_NEAR(run.number("transfer_function"), 0.5, 1e-12);
        EXPECT_NEAR(run.number(fmt::format("output_impedance_at_v(n{})", bits - 1)), 1e3, 1e-7);
        EXPECT_NEAR(run.number(fmt::format("v{}#input_impedance", bits - 1)), 4e3, 1e-7);
    }
}

TEST(ClosedForm, AWheatstoneBridgeMatchesItsTheveninEquivalent) {
    const auto bridge = [](double r4) {
        return run_netlist(fmt::format("bridge\nv1 t 0 10\nr1 t a 1k\nr2 a 0 2k\nr3 t b 3k\nr4 b 0 {:.17g}\nr5 a b 5k\n.op\n", r4))
            .number("v(a,b)");
    };
    EXPECT_NEAR(bridge(6e3), 0, 1e-13);
    for (const double r4 : {1e3, 5.9e3, 6.1e3, 1e6}) {  // Thevenin equivalent between a and b
        const double open = 10 * (2.0 / 3 - r4 / (r4 + 3e3)), inner = 2e3 / 3 + r4 * 3e3 / (r4 + 3e3);
        EXPECT_NEAR(bridge(r4), open * 5e3 / (5e3 + inner), 1e-12);
    }
}

TEST(ClosedForm, AnAmplifierOfControlledSourcesHasItsGainAndResistances) {
    // a degenerated transconductance: v_in across r_pi drives g_m into r_e
    const double r_s = 600, r_pi = 10e3, g_m = 20e-3, r_e = 100, r_c = 5e3;
    const auto run = run_netlist("degenerated\nv1 in 0 1\nrs in b 600\nrpi b e 10k\nre e 0 100\ng1 c e b e 20m\nrc c 0 5k\n.tf v(c) v1\n");
    const double in = r_pi + (1 + g_m * r_pi) * r_e;
    EXPECT_NEAR(run.number("transfer_function"), -g_m * r_pi * r_c / (r_s + in), 1e-9);
    EXPECT_NEAR(run.number("v1#input_impedance"), r_s + in, 1e-6);
    EXPECT_NEAR(run.number("output_impedance_at_v(c)"), r_c, 1e-9);

    // an operational amplifier with gain A, made of E; feedback gives about -R2/R1
    const double A = 1e5, R1 = 1e3, R2 = 10e3, R_o = 75;
    const auto inverting = run_netlist("inverting\nv1 in 0 1\nr1 in m 1k\nr2 m out 10k\ne1 o 0 0 m 1e5\nro o out 75\n.tf v(out) v1\n");
    const double gain = (R_o - A * R2) / (R1 * (1 + A) + R2 + R_o);  // from the equations of nodes m and out
    EXPECT_NEAR(inverting.number("transfer_function"), gain, 1e-9);
    EXPECT_NEAR(inverting.number("output_impedance_at_v(out)"), R_o * (R1 + R2) / (R1 + R2 + R_o + A * R1), 1e-9);
    EXPECT_NEAR(inverting.number("v1#input_impedance"), R1 + (R2 + R_o) / (1 + A), 1e-8);

    const auto from_ground = run_netlist("divider\nv1 in 0 1\nr1 in out 3k\nr2 out 0 1k\n.tf v(0,out) v1\n");
    EXPECT_NEAR(from_ground.number("transfer_function"), -0.25, 1e-12);
    EXPECT_NEAR(from_ground.number("output_impedance_at_v(0,out)"), 750, 1e-9);

    // a current copied by F and converted to a voltage by H
    const auto currents = run_netlist(
        "currents\ni1 0 a 1m\nva a b 0\nr1 b 0 50\nf1 0 c va 20\nr2 c 0 1k\nvc c d 0\nr3 d 0 1k\nh1 out 0 vc 300\nr4 out 0 1\n"
        ".tf v(out) i1\n");
    EXPECT_NEAR(currents.number("transfer_function"), 20 * 0.5 * 300, 1e-9);
    EXPECT_NEAR(currents.number("i1#input_impedance"), 50, 1e-10);
}

/// A netlist with every kind of device that has a value, connected to a diode.
constexpr const char* everything =
    "v1 in 0 {v1}\nr1 in a {r1}\nd1 a 0 dx\nr2 a b {r2}\ng1 b 0 a 0 {g1}\nr3 b 0 {r3}\ni1 0 b {i1}\ne1 c 0 b 0 {e1}\nr4 c d {r4}\nr5 d 0 "
    "1k\n"
    ".model dx d(is=1e-14 n=1.2)\n";
constexpr std::pair<const char*, double> all_values[] = {{"v1", 2.0}, {"r1", 1e3},  {"r2", 2e3}, {"g1", 1e-3},
                                                         {"r3", 3e3}, {"i1", 1e-3}, {"e1", 2.0}, {"r4", 1e3}};

std::string with_values(const std::string& changed_name = "", double value = 0) {
    std::string text = "everything\n.param";
    for (const auto& [name, nominal] : all_values) text += fmt::format(" {}={:.17g}", name, name == changed_name ? value : nominal);
    return text + "\n" + everything;
}

TEST(ClosedForm, SensitivitiesEqualNumericalDerivatives) {
    const auto run = run_netlist(with_values() + ".sens v(d)\n");
    for (const auto& [name, value] : all_values) {
        const double h = 1e-3 * value;
        const auto d = [&, of = name, at = value](double step) {
            return run_netlist(with_values(of, at + step) + ".options reltol=1e-10 vntol=1e-13\n.op\n").number("v(d)");
        };
        const double slope = (8 * (d(h) - d(-h)) - (d(2 * h) - d(-2 * h))) / (12 * h);  // difference quotient of fourth order
        EXPECT_NEAR(run.number(name), slope, 1e-6 * std::abs(slope)) << name;
    }
}

TEST(ClosedForm, SensitivitiesEqualNgspices) {
    const auto text = with_values() + ".sens v(d)\n.options reltol=1e-9\n.end\n";
    const auto stem = std::filesystem::temp_directory_path() / fmt::format("corpuscle-sens-{}", getpid());
    std::ofstream(stem.string() + ".cir") << text;
    const auto command = fmt::format("ngspice -b -r '{0}.raw' '{0}.cir' >/dev/null 2>&1", stem.string());
    EXPECT_GE(std::system(command.c_str()), 0);
    const auto of_ngspice = read_raw_file(stem.string() + ".raw");
    for (const char* end : {".raw", ".cir"}) std::filesystem::remove(stem.string() + end);
    ASSERT_EQ(of_ngspice.size(), 1U);
    const auto of_corpuscle = run_netlist(text);
    for (const auto& [name, value] : all_values) {
        const auto* curve = of_ngspice[0].find_curve(fmt::format("v({}{})", name, name[0] == 'g' || name[0] == 'e' ? "_gain" : ""));
        ASSERT_NE(curve, nullptr) << name;
        EXPECT_NEAR(of_corpuscle.number(name) / curve->values[0].real(), 1, 1e-5) << name;
    }
}

}  // namespace
}  // namespace corpuscle::circuit
