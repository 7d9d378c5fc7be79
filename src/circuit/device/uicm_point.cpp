#include "circuit/device/uicm_point.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {
namespace {

constexpr double off_below = 1e-7;  // some 10 fA a square

std::string_view inversion_word(double i) { return i < off_below ? "off" : i < 1 ? "weak" : i > 100 ? "strong" : "moderate"; }

std::string_view region_word(double i, double V_DS, double phi_t) {
    if (i < off_below) return "off";
    return std::abs(V_DS) < phi_t * (std::sqrt(1 + i) + 3) ? "triode" : "saturation";
}

}  // namespace

UicmPoint uicm_point(const UicmConstants& c, const double (&v)[4]) {
    using Of = Terminals;
    const Uicm<double> device(c);
    const auto inside = device.inside(v);
    UicmAnswer<double> at;
    device.eval(v, at);

    const double i_f = inside.q_S * (inside.q_S + 2), i_r = inside.q_D * (inside.q_D + 2), most = std::max(i_f, i_r);
    const double ends = c.polarity * (v[Of::D] + v[Of::S] - 2 * v[Of::B]);  // V_DB + V_SB
    UicmPoint p{};
    p.inversion = inversion_word(most), p.region = region_word(most, v[Of::D] - v[Of::S], 1 / c.per_phi_t);
    p.i_f = i_f, p.i_r = i_r;
    p.I_D = c.polarity * inside.I, p.I_bs = c.polarity * inside.I_s, p.I_bd = c.polarity * inside.I_d;
    p.V_T = c.V_T - c.sigma_n / c.per_n * ends;
    const double g_bd = -at.di[Of::B][Of::D];
    p.g_mg = at.di[Of::D][Of::G], p.g_ms = -at.di[Of::D][Of::S], p.g_md = at.di[Of::D][Of::D] - g_bd, p.g_mb = at.di[Of::D][Of::B] + g_bd;
    p.C_gs = -at.dq[Of::G][Of::S], p.C_gd = -at.dq[Of::G][Of::D], p.C_gb = -at.dq[Of::G][Of::B];
    p.C_bs = -at.dq[Of::B][Of::S], p.C_bd = -at.dq[Of::B][Of::D];
    return p;
}

}  // namespace corpuscle::circuit
