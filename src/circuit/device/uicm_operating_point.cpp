#include "circuit/device/uicm_operating_point.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {
namespace {

constexpr double off_below = 1e-7;  // of the inversion coefficient; corresponds to about 10 fA per square

std::string_view inversion_name(double i) { return i < off_below ? "off" : i < 1 ? "weak" : i > 100 ? "strong" : "moderate"; }

std::string_view region_name(double i, double V_DS, double phi_t) {
    if (i < off_below) return "off";
    return std::abs(V_DS) < phi_t * (std::sqrt(1 + i) + 3) ? "triode" : "saturation";
}

}  // namespace

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
