#pragma once
// The equations of Gummel and Poon (Bell System Technical Journal 49, 1970) as SPICE2 has them (Nagel 1975; Antognetti and Massobrio,
// "Semiconductor device modeling with SPICE", 1988). All voltages and currents have the signs of an NPN transistor.
//
//     i_f = ibe (exp(v_be / (nf V_t)) - 1),   i_r = ibc (exp(v_bc / (nr V_t)) - 1)         junction currents; ibe = ibc = is as a rule
//
//     q_1 = 1 / (1 - v_bc/vaf - v_be/var),    q_2 = i_f / ikf + i_r / ikr
//
//     q_b = q_1 (1 + (1 + 4 q_2)^nkf) / 2                                                 base charge, relative to that at 0 V
//
//     i_ce = (i_f - i_r) / q_b                                                            from collector to emitter
//
//     i_be = i_f / bf + ise (exp(v_be / (ne V_t)) - 1),   i_bc = i_r / br + isc (exp(v_bc / (nc V_t)) - 1)
//
//     r_b = rbm + (rb - rbm) / q_b,    or with irb   r_b = rbm + 3 (rb - rbm) (tan z - z) / (z tan^2 z)
//
//     z = (sqrt(1 + 144 x / pi^2) - 1) / (24 sqrt(x) / pi^2),   x = (i_be + i_bc) / irb
//
//     q_be = tf (1 + xtf (i_f / (i_f + itf))^2 exp(v_bc / (1.44 vtf))) i_f / q_b + the charge of cje
//
//     q_bc = tr i_r + the charge of cjc xcjc
//
// The rest of cjc, and the substrate junction, are functions of other voltages. Left out: excess phase, quasi-saturation, breakdown.

#include <algorithm>

#include "circuit/device/gummel_poon/card.hpp"
#include "circuit/device/gummel_poon/dual.hpp"

namespace corpuscle::circuit {

/// The currents (A) through the three branches of the inner transistor, and what follows from them.
struct BipolarCurrents {
    Dual forward, reverse;                                 ///< i_f and i_r
    Dual collector_emitter, base_emitter, base_collector;  ///< i_ce, i_be, i_bc
    Dual base_charge;                                      ///< q_b
};

/// q_1 = 1 / u, continued as a straight line below u = 0.01, where SPICE's q_1 would go to infinity and change its sign.
inline Dual early_factor(Dual u) {
    constexpr double least = 0.01;
    if (u.value >= least) return 1 / u;
    return (2 - u / least) / least;
}

/// q_b; see above.
inline Dual base_charge(const BipolarCard& c, double v_be, double v_bc, Dual forward, Dual reverse) {
    Dual u(1);
    if (c.vaf > 0) u = u - Dual(v_bc, 0, 1) / c.vaf;
    if (c.var > 0) u = u - Dual(v_be, 1, 0) / c.var;
    const Dual q1 = early_factor(u);
    if (c.ikf == 0 && c.ikr == 0) return q1;
    Dual sum(1);
    if (c.ikf > 0) sum = sum + 4 * forward / c.ikf;
    if (c.ikr > 0) sum = sum + 4 * reverse / c.ikr;
    if (!(sum.value > 0)) return q1 / 2;  // far reverse, with a knee current below the saturation current
    const double power = c.nkf == 0.5 ? std::sqrt(sum.value) : std::pow(sum.value, c.nkf);
    return q1 * (1 + sum.mapped(power, c.nkf * power / sum.value)) / 2;
}

/// The currents of the inner transistor. gmin (S) is in parallel with both junctions.
inline BipolarCurrents bipolar_currents(const BipolarCard& c, double v_t, double v_be, double v_bc, double gmin) {
    BipolarCurrents out;
    out.forward = Dual::of_be(junction_current(v_be, c.ibe, c.nf * v_t));
    out.reverse = Dual::of_bc(junction_current(v_bc, c.ibc, c.nr * v_t));
    out.base_charge = base_charge(c, v_be, v_bc, out.forward, out.reverse);
    out.collector_emitter = (out.forward - out.reverse) / out.base_charge;
    out.base_emitter = out.forward / c.bf + Dual(gmin * v_be, gmin, 0);
    if (c.ise > 0) out.base_emitter = out.base_emitter + Dual::of_be(junction_current(v_be, c.ise, c.ne * v_t));
    out.base_collector = out.reverse / c.br + Dual(gmin * v_bc, 0, gmin);
    if (c.isc > 0) out.base_collector = out.base_collector + Dual::of_bc(junction_current(v_bc, c.isc, c.nc * v_t));
    return out;
}

/// 3 (tan z - z) / (z tan^2 z) and its slope over x. It falls from 1 at x = 0, and is 1 below.
inline ValueSlope crowding(double x) {
    constexpr double A = 144 / (3.141592653589793 * 3.141592653589793);
    if (!(x > 0)) return {1, 0};
    const double s = std::sqrt(1 + A * x), y = 36 * x / ((s + 1) * (s + 1));  // y = z^2, without the difference of nearly equal numbers
    const double dy = 36 / ((s + 1) * (s + 1)) * (1 - A * x / (s * (s + 1)));
    if (y < 0.01)  // series of cot z / z - cot^2 z
        return {1 - y * (4.0 / 15 + y * (4.0 / 105 + y * (8.0 / 1575 + y * 4 / 6237))),
                -(4.0 / 15 + y * (8.0 / 105 + y * (8.0 / 525 + y * 16 / 6237))) * dy};
    const double z = std::sqrt(y), t = 1 / std::tan(z), dt = -1 - t * t;  // t = cot z
    return {3 * (t / z - t * t), 3 * (dt / z - t / y - 2 * t * dt) / (2 * z) * dy};
}

/// r_b, ohm.
inline Dual base_resistance(const BipolarCard& c, const BipolarCurrents& i) {
    if (c.irb == 0) return c.rbm + (c.rb - c.rbm) / i.base_charge;
    const Dual x = (i.base_emitter + i.base_collector) / c.irb;
    const auto falls = crowding(x.value);
    return c.rbm + (c.rb - c.rbm) * x.mapped(falls.value, falls.slope);
}

/// The charge (C) of the transit of i_f; see above.
inline Dual transit_charge(const BipolarCard& c, const BipolarCurrents& i, double v_bc) {
    Dual more = 0;
    if (c.xtf > 0 && i.forward.value > 0) {
        more = c.xtf;
        if (c.vtf > 0) {
            const double growth = std::exp(std::min(v_bc / (1.44 * c.vtf), 80.0));
            more = more * Dual(growth, 0, v_bc / (1.44 * c.vtf) < 80 ? growth / (1.44 * c.vtf) : 0);
        }
        const Dual part = i.forward / (i.forward + c.itf);
        more = more * part * part;
    }
    return c.tf * (1 + more) * i.forward / i.base_charge;
}

/// The charges (C) between inner base and emitter, and between inner base and collector.
struct BipolarCharges {
    Dual base_emitter, base_collector;
};
inline BipolarCharges bipolar_charges(const BipolarCard& c, const BipolarCurrents& i, double v_be, double v_bc) {
    return {transit_charge(c, i, v_bc) + Dual::of_be(depletion_charge(v_be, c.cje, c.vje, c.mje, c.fc)),
            c.tr * i.reverse + Dual::of_bc(depletion_charge(v_bc, c.cjc * c.xcjc, c.vjc, c.mjc, c.fc))};
}

}  // namespace corpuscle::circuit
