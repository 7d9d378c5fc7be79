#pragma once
// The operating point of a transistor, as .op prints it.

#include <string_view>

#include "circuit/device/uicm.hpp"

namespace corpuscle::circuit {

/// Currents have their real sign: into the drain, out of the bulk. All other quantities are those of the equivalent NMOS.
struct UicmOperatingPoint {
    std::string_view inversion_level;     ///< by i, the larger of i_f and i_r: off (i < 1e-7), weak (i < 1), moderate or strong (i > 100)
    std::string_view region;              ///< off; triode; saturation, |V_DS| >= phi_t (sqrt(1 + i_f) + 3)
    double i_f, i_r;                      ///< inversion coefficients q (q + 2) at source and drain
    double I_D, I_bs, I_bd;               ///< A: channel, drain to source; junctions, bulk to source and bulk to drain
    double V_T;                           ///< V, with DIBL at these voltages
    double g_mg, g_ms, g_md, g_mb;        ///< S, channel only; g_ms = -dI_D/dV_S, so that g_mg + g_md + g_mb = g_ms
    double C_gs, C_gd, C_gb, C_bs, C_bd;  ///< F, -dq/dv, with overlaps and junctions
};

UicmOperatingPoint uicm_operating_point(const UicmConstants&, const double (&v)[4]);

}  // namespace corpuscle::circuit
