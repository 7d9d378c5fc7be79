#include "circuit/export/uicm_subcircuit.hpp"

#include <fmt/format.h>

#include <array>

namespace corpuscle::circuit {
namespace {

// uicm_g is the charge q at one end as a function of a new unknown z, chosen so that q + ln q is nearly linear in z. Newton's method then
// converges, and q is never below 0. With p and q the charges at the two ends, h the larger and l the smaller of them, k = zeta, and i and
// q_S, q_D as in mos_channel.hpp:
//
//     d = q_S - q_D with velocity saturation;            y = q_S + q_D of these = p + q + |p - q| - |d|
//     t = y + 2 - zeta |i| = (y + 2) / (1 + zeta |d|);   i = d t
//
// uicm_charge is the channel charge of an end, with the sign of d for that end. None of these quantities has a kink at V_DS = 0,
// where ngspice takes 0 as the derivative of |x|.
constexpr std::string_view functions = R"(.func uicm_g(z) {z > 300 ? z+0.6931471805599453 : asinh(exp(min(z,300)))}
.func uicm_ln_g(z) {z < -30 ? z : ln(uicm_g(max(z,-30)))}
.func uicm_root(h,k) {sqrt((1+k)*(1+k)+2*k*h)}
.func uicm_d(d,h,l,k) {d*(1-k+uicm_root(h,k))/(1+k+uicm_root(h,k)+k*(h-l)-2*k*l/h)}
.func uicm_t(d,y,k) {(y+2)/(1+k*abs(d))}
.func uicm_charge(d,y,t) {y/4+d/12+d*d/(12*t)-d*d*d/(60*t*t)}
)";

// Field {0} is the name; the others are:
//
//     {1} {2} {3}          voltages from gate, source and drain to bulk, with the signs of the polarity
//
//     {4}                  terminals between which the channel current flows
//
//     {5}                  sign of the channel charges
//
//     {6} {7} {8} {9}      anode and cathode of the source junction, then of the drain junction
//
//     {10} {11}            pinch-off voltage; factor n / slope with an asterisk
//
//     {12} {13} {14}       parameters and lines of the body effect; lines of the bulk charge
constexpr std::string_view subcircuit = R"(.subckt {0} d g s b vt=0.5 slope=1.3 phit=0.02587 sigma=0 zeta=0 is=0 va=1e6
+ cox=0 cgs=0 cgd=0 cgb=0 iss=0 isd=0 tops=0 topd=0 njphit=0.02587 cjs=0 cjd=0 pb=0.8 mj=0.4 fc=0.5{12}
{13}* q + ln q = x at source and drain
bzs zs 0 i=uicm_g(v(zs))+uicm_ln_g(v(zs))-1-({10}-{2})/phit
bzd zd 0 i=uicm_g(v(zd))+uicm_ln_g(v(zd))-1-({10}-{3})/phit
bqs qs 0 i=v(qs)-uicm_g(v(zs))
bqd qd 0 i=v(qd)-uicm_g(v(zd))
* channel current
bd d1 0 i=v(d1)-uicm_d(v(qs)-v(qd),max(max(v(qs),v(qd)),1e-90),max(min(v(qs),v(qd)),0),zeta)
by y 0 i=v(y)-max(v(qs)+v(qd)+abs(v(qs)-v(qd))-abs(v(d1)),0)
bi {4} i=is*{11}v(d1)*uicm_t(v(d1),max(v(y),0),zeta)*(1+(sqrt(v(d,s)*v(d,s)+16*phit*phit)-4*phit)/va)
* channel charges: one capacitor for each end, with a voltage source at its other side; the bulk supplies the depletion charge
cqd d cd {{slope*cox}}
bqdg cd g v=v(d,g){5}phit*{11}uicm_charge(-v(d1),max(v(y),0),uicm_t(v(d1),max(v(y),0),zeta))
cqs s cs {{slope*cox}}
bqsg cs g v=v(s,g){5}phit*{11}uicm_charge(v(d1),max(v(y),0),uicm_t(v(d1),max(v(y),0),zeta))
{14}cgd g d {{cgd}}
cgs g s {{cgs}}
* junctions: currents, then charges and gmin
bjs {6} {7} i=iss*(exp(min(v({6},{7})/njphit,tops))*(1+max(v({6},{7})/njphit-tops,0))-1)
bjd {8} {9} i=isd*(exp(min(v({8},{9})/njphit,topd))*(1+max(v({8},{9})/njphit-topd,0))-1)
djs {6} {7} js temp=27
djd {8} {9} jd temp=27
.model js d(is=1e-40 n=10 cjo={{cjs}} vj={{pb}} m={{mj}} fc={{fc}} tnom=27)
.model jd d(is=1e-40 n=10 cjo={{cjd}} vj={{pb}} m={{mj}} fc={{fc}} tnom=27)
.ends
)";

// With a constant slope factor, and with a body effect (pinch_off.hpp): r, V_P without DIBL, and n / slope are nodes.
constexpr std::string_view constant_bulk = R"(bqb g b i=(1-1/slope)*(i(bqdg)+i(bqsg))
cgb g b {cgb+cox*(slope-1)/slope}
)";
constexpr std::string_view body_parameters = " bw=0 bwphi=1 pera=1 phi=1", body_lines = R"(* body effect
br r 0 v=sqrt(max(bwphi*bwphi+({0}-vt)*pera,(bw+(bwphi-bw)/4)*(bw+(bwphi-bw)/4)))
bvp vp 0 v=(v(r)-bw)*(v(r)-bw)-phi+min(bwphi*bwphi+({0}-vt)*pera-(bw+(bwphi-bw)/4)*(bw+(bwphi-bw)/4),0)*(v(r)-bw)/v(r)
bnr nr 0 v=v(r)/(v(r)-bw)*(bwphi-bw)/bwphi
)";
constexpr std::string_view body_bulk = R"(cqb g cb {{slope*cox}}
bqbb cb b v=v(g,b){0}(v(nr)-1/slope)*phit*(uicm_charge(-v(d1),max(v(y),0),uicm_t(v(d1),max(v(y),0),zeta))+
+ uicm_charge(v(d1),max(v(y),0),uicm_t(v(d1),max(v(y),0),zeta)))
cdep g ce {{cox}}
bdep ce b v={0}(vt+v(vp))
cgb g b {{cgb}}
)";

}  // namespace

std::string uicm_functions() { return std::string(functions); }

std::string uicm_subcircuit_name(bool pmos, bool has_body_effect) {
    return fmt::format("uicm_{}{}", pmos ? 'p' : 'n', has_body_effect ? "_body" : "");
}

std::string uicm_subcircuit(bool pmos, bool has_body_effect) {
    const std::string_view gate = pmos ? "v(b,g)" : "v(g,b)", source = pmos ? "v(b,s)" : "v(s,b)", drain = pmos ? "v(b,d)" : "v(d,b)",
                           sign = pmos ? "-" : "+";
    const auto pinch_off = has_body_effect ? fmt::format("(v(vp)+sigma*({}+{})/slope)", source, drain)
                                           : fmt::format("({}-vt+sigma*({}+{}))/slope", gate, source, drain);
    const auto lines = has_body_effect ? fmt::format(body_lines, gate) : "";
    const auto bulk = has_body_effect ? fmt::format(body_bulk, sign) : std::string(constant_bulk);
    const auto ends = pmos ? std::array{"s", "b", "d", "b"} : std::array{"b", "s", "b", "d"};
    return fmt::format(subcircuit, uicm_subcircuit_name(pmos, has_body_effect), gate, source, drain, pmos ? "s d" : "d s", sign, ends[0],
                       ends[1], ends[2], ends[3], pinch_off, has_body_effect ? "v(nr)*" : "", has_body_effect ? body_parameters : "", lines,
                       bulk);
}

std::string uicm_parameters(const UicmCard& card, const UicmInstance& size, double temperature, bool pmos) {
    const auto c = uicm_constants(card, size, temperature, pmos);
    std::string out = fmt::format("vt={} slope={} phit={} sigma={} zeta={} is={} va={}\n", c.V_T, card.n, 1 / c.per_phi_t,
                                  c.sigma_n * card.n, c.zeta, c.I_S, 1 / c.lambda);
    out += fmt::format("+ cox={} cgs={} cgd={} cgb={}", card.C_ox * size.area(), c.C_gs, c.C_gd, c.C_gb);
    out += fmt::format(" iss={} isd={} tops={} topd={} njphit={}\n", c.I_sat_s, c.I_sat_d, c.exp_limit_s, c.exp_limit_d, 1 / c.per_n_phi_t);
    if (card.gamma > 0) out += fmt::format("+ bw={} bwphi={} pera={} phi={}\n", c.body_w, c.body_w_phi, c.per_a, c.phi);
    return out + fmt::format("+ cjs={} cjd={} pb={} mj={} fc={}\n", c.C_js, c.C_jd, card.P_B, card.M_J, card.F_C);
}

}  // namespace corpuscle::circuit
