#include "circuit/device/uicm_card.hpp"

#include <algorithm>

#include "circuit/device/physical_constants.hpp"
#include "core/random.hpp"

namespace corpuscle::circuit {
namespace {

/// x^p with the project's exp and log: bit-identical on every machine.
double power(double x, double p) { return num::exp(p * num::log(x)); }

/// The source or drain regions of all columns together: area, m^2, and perimeter, m.
struct Diffusion {
    double area, perimeter;
};
/// `area`, `perimeter`: those of one column; negative: computed from W and L_dif.
Diffusion diffusion(const UicmCard& card, const UicmInstance& instance, double area, double perimeter) {
    return {instance.m * (area < 0 ? instance.W * card.L_dif : area),
            instance.m * (perimeter < 0 ? 2 * (instance.W + card.L_dif) : perimeter)};
}

/// Temperature factor of I_sat, as in SPICE: (T / T_nom)^(XTI / n_dio) exp((T / T_nom - 1) E_g / (n_dio phi_t)).
double junction_growth(const UicmCard& card, double T, double T_nom, double phi_t) {
    return power(T / T_nom, card.XTI / card.n_dio) * num::exp((T / T_nom - 1) * card.E_g / (card.n_dio * phi_t));
}

/// Argument of exp, from 0 to 600, at which the junction current is junction_current_limit.
double exp_limit_of(double I_sat) { return I_sat > 0 ? std::clamp(num::log(junction_current_limit / I_sat), 0.0, 600.0) : 0; }

enum RandomPurpose : std::uint32_t { mismatch_purpose = 0x75690001, process_purpose };  // each is a random stream of its own

constexpr double off_below = 1e-7;  // of the inversion coefficient; corresponds to about 10 fA per square

std::string_view inversion_name(double i) { return i < off_below ? "off" : i < 1 ? "weak" : i > 100 ? "strong" : "moderate"; }

std::string_view region_name(double i, double V_DS, double phi_t) {
    if (i < off_below) return "off";
    return std::abs(V_DS) < phi_t * (std::sqrt(1 + i) + 3) ? "triode" : "saturation";
}

}  // namespace

UicmConstants uicm_constants(const UicmCard& card, const UicmInstance& instance, double temperature, bool pmos) {
    const double T = temperature + zero_celsius, T_nom = card.T_nom + zero_celsius, phi_t = boltzmann * T / electron_charge;
    const double length = instance.L * instance.stack, width = instance.W * instance.m, C_gate = card.C_ox * instance.area();
    const double I_S = card.I_SQ * instance.mulu0 * power(T / T_nom, card.I_S_exponent) * width / length;
    const double growth = junction_growth(card, T, T_nom, phi_t);
    const Diffusion source = diffusion(card, instance, instance.AS, instance.PS),
                    drain = diffusion(card, instance, instance.AD, instance.PD);
    const auto I_sat = [&](const Diffusion& d) { return growth * (card.J_S * d.area + card.J_SSW * d.perimeter); };
    const auto C_0 = [&](const Diffusion& d) { return card.C_J * d.area + card.C_JSW * d.perimeter; };

    UicmConstants c{};
    c.polarity = pmos ? -1 : 1;
    c.V_T = card.V_T0 + instance.delvto + card.alpha_VT * (temperature - card.T_nom);
    c.per_n = 1 / card.n, c.per_phi_t = 1 / phi_t;
    const double root_phi = num::sqrt(card.phi), a = card.n - card.gamma / (2 * root_phi);
    c.body_w = card.gamma / (2 * a), c.body_w_phi = c.body_w + root_phi, c.per_a = 1 / a, c.phi = card.phi;
    c.sigma_n = card.sigma_L / length / card.n, c.zeta = card.zeta_L * instance.mulu0 / length;
    c.I_S = I_S, c.lambda = 1 / (card.V_E * length), c.knee = 4 * phi_t;
    c.Q_0 = card.n * phi_t * C_gate, c.C_dep = (card.n - 1) / card.n * C_gate;
    c.C_gs = card.C_GSO * width, c.C_gd = card.C_GDO * width, c.C_gb = card.C_GBO * length * instance.m;
    c.I_sat_s = I_sat(source), c.I_sat_d = I_sat(drain), c.exp_limit_s = exp_limit_of(c.I_sat_s), c.exp_limit_d = exp_limit_of(c.I_sat_d);
    c.C_js = C_0(source), c.C_jd = C_0(drain);
    c.per_n_phi_t = 1 / (card.n_dio * phi_t), c.per_P_B = 1 / card.P_B, c.v_limit = card.F_C * card.P_B;
    c.charge_exponent = 1 - card.M_J, c.P_B_per_charge_exponent = card.P_B / c.charge_exponent, c.per_P_B_M_J = card.M_J / card.P_B;
    // The formulas of uicm.hpp with mu expressed by I_S. Uicm::noise() multiplies by the normalized channel charge and current.
    c.thermal = 8 * boltzmann * T * I_S / phi_t;
    const double e_n = electron_charge / (card.n * card.C_ox * phi_t);  // m^2: normalized charge density of one electron per m^2
    c.flicker = card.C_ox > 0 ? 2 * e_n * e_n * card.N_ot * I_S / instance.area() : 0;
    return c;
}

UicmShift sample_mismatch(const UicmCard& card, const UicmInstance& instance, std::uint64_t seed, std::uint32_t device,
                          std::uint64_t chip) {
    const double per_root_area = 1 / num::sqrt(instance.area());
    const auto deviates = normal_pair(seed, device, mismatch_purpose, chip);
    return {card.A_VT * per_root_area * deviates.first, num::exp(card.A_IS * per_root_area * deviates.second)};
}

std::array<double, 4> sample_process(std::uint64_t seed, std::uint64_t chip) {
    const auto n = normal_pair(seed, 0, process_purpose, chip), p = normal_pair(seed, 1, process_purpose, chip);
    return {n.first, p.first, n.second, p.second};
}

UicmShift process_shift(const UicmCard& card, bool pmos, const std::array<double, 4>& deviates) {
    return {card.S_VT0 * deviates[pmos ? 1 : 0], num::exp(card.S_IS * deviates[pmos ? 3 : 2])};
}

UicmConstants with_shifts(UicmConstants c, const UicmShift& mismatch, const UicmShift& process) {
    const double factor = mismatch.factor * process.factor;
    c.V_T += mismatch.V_T + process.V_T;
    c.I_S *= factor, c.thermal *= factor, c.flicker *= factor;
    c.zeta *= mismatch.factor;
    return c;
}

UicmOperatingPoint uicm_operating_point(const UicmConstants& c, const double (&v)[4]) {
    using Terminal = Terminals;
    const Uicm<double> device(c);
    const auto inside = device.internals(v);
    UicmEvaluation<double> evaluation;
    device.eval(v, evaluation);

    const double i_f = inside.q_S * (inside.q_S + 2), i_r = inside.q_D * (inside.q_D + 2), larger = std::max(i_f, i_r);
    const double V_ends = c.polarity * (v[Terminal::D] + v[Terminal::S] - 2 * v[Terminal::B]);  // V_DB + V_SB
    UicmOperatingPoint p{};
    p.inversion_level = inversion_name(larger), p.region = region_name(larger, v[Terminal::D] - v[Terminal::S], 1 / c.per_phi_t);
    p.i_f = i_f, p.i_r = i_r;
    p.I_D = c.polarity * inside.I, p.I_bs = c.polarity * inside.I_s, p.I_bd = c.polarity * inside.I_d;
    p.V_T = c.V_T - c.sigma_n / c.per_n * V_ends;
    const double g_bd = -evaluation.di[Terminal::B][Terminal::D];  // of the drain junction, which di[D] contains
    p.g_mg = evaluation.di[Terminal::D][Terminal::G], p.g_ms = -evaluation.di[Terminal::D][Terminal::S],
    p.g_md = evaluation.di[Terminal::D][Terminal::D] - g_bd, p.g_mb = evaluation.di[Terminal::D][Terminal::B] + g_bd;
    p.C_gs = -evaluation.dq[Terminal::G][Terminal::S], p.C_gd = -evaluation.dq[Terminal::G][Terminal::D],
    p.C_gb = -evaluation.dq[Terminal::G][Terminal::B];
    p.C_bs = -evaluation.dq[Terminal::B][Terminal::S], p.C_bd = -evaluation.dq[Terminal::B][Terminal::D];
    return p;
}

}  // namespace corpuscle::circuit
