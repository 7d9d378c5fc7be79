#pragma once
// The operating point of a transistor, as .op prints it.

#include <string_view>

#include "circuit/device/uicm.hpp"

namespace corpuscle::circuit {

/// Currents have their real sign: positive into the drain and out of the bulk. All other quantities are those of the equivalent NMOS.
struct UicmOperatingPoint {
    // i is the larger of i_f and i_r.
    std::string_view inversion_level;     ///< off (i < 1e-7), weak (i < 1), moderate or strong (i > 100)
    std::string_view region;              ///< off, triode, or saturation: |V_DS| >= phi_t (sqrt(1 + i) + 3)
    double i_f, i_r;                      ///< inversion coefficients q (q + 2) at source and drain
    double I_D, I_bs, I_bd;               ///< A: channel, drain to source; junctions, bulk to source and bulk to drain
    double V_T;                           ///< V: threshold with DIBL at these voltages
    double g_mg, g_ms, g_md, g_mb;        ///< S, channel only: g_mx = dI_D/dV_x, but g_ms = -dI_D/dV_S, so that g_mg + g_md + g_mb = g_ms
    double C_gs, C_gd, C_gb, C_bs, C_bd;  ///< F: C_ab = -dq_a/dv_b, with overlaps and junctions
};

UicmOperatingPoint uicm_operating_point(const UicmConstants&, const double (&v)[4]);

}  // namespace corpuscle::circuit
