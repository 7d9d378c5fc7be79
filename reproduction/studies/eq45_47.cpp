// Equations 45 to 47, corrected by the errata, compared with the simulated circuits. Equations with a misprint are also compared
// as printed.
// Symbols. V_Q and I_Q are voltage and current of an inverter with its output tied to its input, V_Q0 is V_Q with the bulks at the output.
// G_m, G_o and G_mb are the slopes of the output current over input, output and bulk voltage. A_V is G_m / G_o.

#include <fmt/format.h>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/thesis/inverters.hpp"

namespace corpuscle::studies::eq45_47 {

constexpr double phi_t = 1.380649e-23 * 300.15 / 1.602176634e-19, e = 2.718281828459045;  // V at 27 C
constexpr double low = 0.4;        // V: a supply at which all transistors are in weak inversion
constexpr double saturated = 0.6;  // V: a supply at which they are almost in weak inversion, and saturated, as eq. 46 needs

// An array and a unit transistor; and inverters of 2x8 arrays, with the output tied to the input, held at v_q, or open. `low` is the
// supply, `stronger` a factor on the PMOS current of one inverter.
constexpr const char* circuit = R"(Arrays and inverters in weak inversion
.lib '../process/tsmc180.lib' tt
.param low=0.4 v_q=0.2 stronger=1
vdd vdd 0 {low}
vd d 0 0.2
vg g 0 0.2
vs1 d d1 0
m1 d1 g 0 0 nch w=1.5u l=0.5u m=2 stack=8
vs2 d d2 0
m2 d2 g 0 0 nch w=1.5u l=0.5u
* output tied to input, both bulks biased equally
vbn bn 0 0
ebp bp 0 vdd bn 1
visq sq 0 0
mpq q q vdd bp pch w=6u l=0.5u m=2 stack=8
mnq q q sq  bn nch w=1.5u l=0.5u m=2 stack=8
* the same with the bulks at the output
mp0 q0 q0 vdd q0 pch w=6u l=0.5u m=2 stack=8 mulu0={stronger}
mn0 q0 q0 0   q0 nch w=1.5u l=0.5u m=2 stack=8
* output held at v_q, bulk voltages moved from the rails by vb; then an open output
vin in 0 {v_q}
vb b 0 0
ebpb bph 0 vdd 0 1
vh h 0 {v_q}
eb1 bp1 bph b 0 1
mph h in vdd bp1 pch w=6u l=0.5u m=2 stack=8
mnh h in 0   b   nch w=1.5u l=0.5u m=2 stack=8
mpo o in vdd vdd pch w=6u l=0.5u m=2 stack=8
mno o in 0   0   nch w=1.5u l=0.5u m=2 stack=8
)";

Result<NetlistResult> run(const std::vector<std::string>& settings, const std::string& directives) {
    return run_study_netlist({circuit, settings, directives});
}

/// An array's parameters from the process card: slope factor, threshold (V, a magnitude), specific current (A), Early voltage (V). V_A is
/// that of a transistor as long as the complete stack.
struct Array {
    double n, V_T, I_S, V_A;
    Array(const circuit::Circuit& c, const char* name) {
        const auto& m = c.elements[static_cast<std::size_t>(c.find_element(name))];
        const auto& values = c.models[static_cast<std::size_t>(m.model)].values;
        const auto value_of = [](const circuit::Values& v, const char* key) { return v.find(key)->second; };
        n = value_of(values, "n"), V_T = value_of(values, "vto"),
        V_A = value_of(values, "ve") * value_of(m.values, "l") * value_of(m.values, "stack");
        I_S = value_of(values, "isq") * value_of(m.values, "w") / value_of(m.values, "l") * value_of(m.values, "m") /
              value_of(m.values, "stack");
    }
    /// Saturation current (A) by eq. 45 as printed; the corrected equation has twice this current (errata I1).
    double weak(double V_GS, double V_BS) const { return I_S * e * std::exp((V_GS + (n - 1) * V_BS - V_T) / (n * phi_t)); }
};

/// Claims on a simulated quantity over that of the equation, as corrected and as printed.
void claim_both(StudyResult& out, const std::string& quantity, double by_corrected, double by_printed, const char* equation,
                const char* erratum) {
    out.claim(fmt::format("{}, over eq. {} as corrected", quantity, equation), by_corrected)
        .derived_as(1, fmt::format("errata {}", erratum));
    auto& c =
        out.claim(fmt::format("{}, over eq. {} as printed", quantity, equation), by_printed).derived_as(1, fmt::format("eq. {}", equation));
    if (c.needs_explanation()) c.explain(fmt::format("misprinted: errata {}", erratum));
}

Result<void> claim_currents(StudyResult& out) {
    const auto f = run({}, ".dc vbn 0 0.15 5m");
    if (!f) return f.error();
    const Array N(*f->circuit, "m1");
    const double I_D = f->curve("dc", "i(vs1)").at(0), I_unit = f->curve("dc", "i(vs2)").at(0);
    claim_both(out, "array: I_D at V_GS = 0.2 V", I_D / (2 * N.weak(0.2, 0)), I_D / N.weak(0.2, 0), "45a", "I1");
    const auto I_Q = f->curve("dc", "i(visq)"), V_Q = f->curve("dc", "v(q)");
    for (const double V_BN : {0.0, 0.15}) {
        const double weak = N.weak(V_Q.at(V_BN), V_BN);
        claim_both(out, fmt::format("I_Q at {:g} V and V_BN = {:g} V", low, V_BN), I_Q.at(V_BN) / (2 * weak), I_Q.at(V_BN) / weak, "45b",
                   "I1, I1a");
    }
    const double slope = std::log(I_Q.at(0.1) / I_Q.at(0.05)) / 0.05;
    out.claim("slope of ln I_Q over V_BN, both bulks biased equally", slope, "1/V")
        .derived_as((N.n - 1) / (N.n * phi_t), "E.1: I_Q grows exponentially with (n-1) V_BN; by eq. 45b (n-1)/(n phi_t)");
    out.claim("I_D of a 2x8 array over that of one unit transistor", I_D / I_unit).derived_as(2.0 / 8, "eq. 45c with eq. 31: S_eq");
    return {};
}

/// G_m, G_o and G_mb (S) of the inverter with its output held: absolute slopes of its output current over input, output and bulk voltage.
struct Slopes {
    double G_m = 0, G_o = 0, G_mb = 0;
    /// With input and output at V_Q (V), the bulks at the rails.
    static Result<Slopes> at(double V_Q, double supply) {
        const std::vector<std::string> settings = {fmt::format("v_q={}", V_Q), fmt::format("low={}", supply)};
        Slopes out;
        for (auto& [source, slope] : {std::pair{"vin", &out.G_m}, {"vh", &out.G_o}, {"vb", &out.G_mb}}) {
            const double middle = source == std::string_view("vb") ? 0 : V_Q;
            const auto f = run(settings, fmt::format(".dc {} {} {} 1m", source, middle - 2e-3, middle + 2e-3));
            if (!f) return f.error();
            *slope = std::abs(f->curve("dc", "i(vh)").slope_at(middle));
        }
        return out;
    }
};

Result<void> claim_gain(StudyResult& out) {
    const std::vector<std::string> settings = {fmt::format("low={}", saturated)};
    const auto rest = run(settings, ".op");
    if (!rest) return rest.error();
    const double V_Q = rest->operating_point("v(q)"), I_Q = rest->operating_point("i(visq)");
    const Array N(*rest->circuit, "mnq"), P(*rest->circuit, "mpq");
    const auto s = Slopes::at(V_Q, saturated);
    if (!s) return s.error();
    out.claim(fmt::format("G_m at {:g} V", saturated), s->G_m, "S")
        .derived_as(I_Q / phi_t * (1 / P.n + 1 / N.n), "eq. 46b with the simulated I_Q");
    out.claim(fmt::format("G_o at {:g} V", saturated), s->G_o, "S")
        .derived_as(I_Q * (1 / P.V_A + 1 / N.V_A), "eq. 46c with the simulated I_Q and V_A = V_E L of the process card");
    const double by_printed = 1 / (N.n * phi_t * (1 / P.V_A + 1 / N.V_A));
    claim_both(out, fmt::format("A_V = G_m / G_o at {:g} V", saturated), s->G_m / s->G_o / (2 * by_printed), s->G_m / s->G_o / by_printed,
               "46d", "I2");
    const double step = 20e-6;
    const auto open = run(settings, fmt::format(".dc vin {} {} 1u", V_Q - step, V_Q + step));
    if (!open) return open.error();
    const auto V_o = open->curve("dc", "v(o)");
    out.claim("V_Q - V_o for an input 20 uV above V_Q", V_Q - V_o.at(V_o.x[V_o.x.size() - 1]), "V")
        .derived_as(s->G_m / s->G_o * (V_o.x.back() - V_Q), "eq. 46a");
    const auto inverters = InverterSweep::run(1e-3);
    if (!inverters) return inverters.error();
    auto& c = out.claim("INVA biased at 200 nA and 0.7 V: G_m", inverters->transconductance_at_zero('a'), "S")
                  .derived_as(2 * inverters->supply_current('a').at(0) / (N.n * phi_t), "eq. 46b with INVA's simulated I_Q");
    if (c.needs_explanation()) c.explain("eq. 46b holds in weak inversion; 200 nA in these arrays is moderate inversion");
    return {};
}

Result<void> claim_rest(StudyResult& out) {
    const auto f = run_study_netlist({"quiescent", {}, ".op"});
    if (!f) return f.error();
    const double V_Q = f->operating_point("v(qa)"), V_Q0 = f->operating_point("v(qb)"), V_DD = 0.7;
    const Array N(*f->circuit, "mn2a"), P(*f->circuit, "mp1a");
    const auto s = Slopes::at(low / 2, low);
    if (!s) return s.error();
    const double offset = V_Q0 - V_DD / 2;  // V_Q0: rest voltage with the bulks at the output
    out.claim("V_Q with bulks at the rails", V_Q, "V")
        .derived_as(V_Q0 + (N.n - 1) * offset, "eq. 47a, second line, with the simulated V_Q0 (errata I4: as printed)");
    out.claim("V_Q - V_Q0", V_Q - V_Q0, "V").derived_as((N.n - 1) * offset, "eq. 47a, second line");
    out.claim("G_mb / (G_m + G_o) at 0.4 V", s->G_mb / (s->G_m + s->G_o)).derived_as(N.n - 1, "eq. 47a, both lines");
    for (const double stronger : {1.0, 2.0, 4.0}) {
        const auto result = run({fmt::format("stronger={}", stronger)}, ".op");
        if (!result) return result.error();
        // P.V_T is the magnitude of V_TP
        const double middle = low / 2 + (N.V_T - P.V_T) / (2 * N.n), shift = phi_t / 2 * std::log(stronger * P.I_S / N.I_S);
        out.claim(fmt::format("V_Q0 at {:g} V with I_SP = {:g} I_SN", low, stronger), result->operating_point("v(q0)"), "V")
            .derived_as(middle + shift, "eq. 47b with + and V_TP < 0 (errata I5)");
        if (stronger == 1) continue;
        out.claim(fmt::format("V_Q0 - [V_DD / 2 + (V_TP + V_TN) / 2n] with I_SP = {:g} I_SN", stronger),
                  result->operating_point("v(q0)") - middle, "V")
            .derived_as(-shift, "eq. 47b with the printed -")
            .explain("the sign is misprinted: a stronger PMOS raises V_Q (errata I5)");
    }
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    if (auto ok = claim_currents(out); !ok) return ok.error();
    if (auto ok = options.report_progress(0.3); !ok) return ok.error();
    if (auto ok = claim_gain(out); !ok) return ok.error();
    if (auto ok = options.report_progress(0.6); !ok) return ok.error();
    if (auto ok = claim_rest(out); !ok) return ok.error();
    out.note(
        "The computed values are simulated with the process card at 0.4 V, so that all transistors are in weak inversion (eq. 46 at 0.6 V, "
        "where drains are saturated as well). The published values are the equations with n, V_T, I_SQ and V_E of the process card.");
    return out;
}

const Study study{"eq45-47", "The inverter's equations",
                  "I_Q, G_m, G_o, A_V and V_Q by eq. 45 to 47, compared with simulated circuits. Thesis E.1 (errata I1, I2, I4, I5)",
                  compute};

}  // namespace corpuscle::studies::eq45_47
