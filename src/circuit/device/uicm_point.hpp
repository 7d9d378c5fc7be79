#pragma once
// What is known of a transistor where it stands: the lines that .op prints.

#include <string_view>

#include "circuit/device/uicm.hpp"

namespace corpuscle::circuit {

/// Currents are as they flow, into drain and out of bulk; all else is said in the transistor's own polarity, thresholds and inversion as
/// for an NMOS.
struct UicmPoint {
    std::string_view inversion;           ///< of the end that has more: off, i < 1e-7; weak, i < 1; moderate; strong, i > 100
    std::string_view region;              ///< off; triode; saturation, |V_DS| >= phi_t (sqrt(1 + i_f) + 3)
    double i_f, i_r;                      ///< of source and drain, q (q + 2)
    double I_D, I_bs, I_bd;               ///< channel, drain to source; junctions, bulk to source and to drain
    double V_T;                           ///< with DIBL as it is here
    double g_mg, g_ms, g_md, g_mb;        ///< of the channel alone; g_ms = -dI_D/dV_S, so that g_mg + g_md + g_mb = g_ms
    double C_gs, C_gd, C_gb, C_bs, C_bd;  ///< -dq/dv, with overlaps and junctions
};

UicmPoint uicm_point(const UicmConstants&, const double (&v)[4]);

}  // namespace corpuscle::circuit
