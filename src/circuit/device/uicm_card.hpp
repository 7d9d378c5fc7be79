#pragma once
// The parameters of a transistor: its model card (.model) and its instance (M line); and the constants computed from both.

#include <array>

#include "circuit/device/uicm.hpp"
#include "core/parameter.hpp"

namespace corpuscle::circuit {

/// A process card: `.model nch nmos (level=80 isq=112n vto=0.461 ...)`. The two polarities are mirror images: parameters have the same
/// sign for both, and vto > 0 is an enhancement device, also for PMOS.
/// Effects of length: drain-induced barrier lowering (DIBL) and velocity saturation are proportional to 1/L, the Early voltage to L. For
/// velocity saturation this follows from the definition zeta = mu phi_t / (L v_sat). With these proportions a stack of elements has the
/// parameters of one device of their total length.
struct UicmCard {
    double I_SQ = 112e-9, V_T0 = 0.461, n = 1.27, gamma = 0, phi = 0.85, sigma_L = 0, zeta_L = 0, V_E = 8e6, C_ox = 8.42e-3;
    double C_GSO = 0, C_GDO = 0, C_GBO = 0;
    double C_J = 0, C_JSW = 0, P_B = 0.8, M_J = 0.4, F_C = 0.5, J_S = 0, J_SSW = 0, n_dio = 1, E_g = 1.11, XTI = 3, L_dif = 0.5e-6;
    double alpha_VT = -0.4e-3, I_S_exponent = 0.5, T_nom = 27, N_ot = 0;
    double A_VT = 0, A_IS = 0, S_VT0 = 0, S_IS = 0;

    static constexpr double level = 80;  ///< level= of this model in a .model line; no SPICE simulator uses level 80 for another model
    static constexpr std::string_view name = "uicm", description = "UICM transistor, all regions (with extensions from ACM2)";
    static constexpr std::string_view source = "choice: circuits of 0.18 um; see process/tsmc180.lib";
    static constexpr ParameterDef<UicmCard> fields[] = {
        {"isq", &UicmCard::I_SQ, "A", 1e-15, 1, "specific current per square, mu C_ox n phi_t^2 / 2"},
        {"vto", &UicmCard::V_T0, "V", -5, 5, "threshold: V_GB where V_P = 0; positive for enhancement devices of both polarities"},
        {"n", &UicmCard::n, "", 1.000001, 5, "slope factor; if gamma > 0, that at V_P = 0"},
        {"gamma", &UicmCard::gamma, "V^0.5", 0, 10, "body factor, which makes n fall as V_GB rises; 0: n is constant"},
        {"phi", &UicmCard::phi, "V", 0.1, 2, "surface potential at threshold, for gamma"},
        {"sigmal", &UicmCard::sigma_L, "m", 0, 1e-3, "DIBL times length: V_T falls by sigmal / L times V_DB + V_SB"},
        {"zetal", &UicmCard::zeta_L, "m", 0, 1e-3, "velocity saturation times length, mu phi_t / v_sat"},
        {"ve", &UicmCard::V_E, "V/m", 1, 1e30, "Early voltage per metre of channel length: V_A = V_E L"},
        {"cox", &UicmCard::C_ox, "F/m^2", 0, 10, "gate capacitance per area"},
        {"cgso", &UicmCard::C_GSO, "F/m", 0, 1, "gate-source overlap capacitance per width"},
        {"cgdo", &UicmCard::C_GDO, "F/m", 0, 1, "gate-drain overlap capacitance per width"},
        {"cgbo", &UicmCard::C_GBO, "F/m", 0, 1, "gate-bulk overlap capacitance per length"},
        {"cj", &UicmCard::C_J, "F/m^2", 0, 10, "junction capacitance at 0 V per area"},
        {"cjsw", &UicmCard::C_JSW, "F/m", 0, 1, "junction capacitance at 0 V per perimeter; pb and mj apply to it, too"},
        {"pb", &UicmCard::P_B, "V", 0.1, 5, "built-in potential of the junctions"},
        {"mj", &UicmCard::M_J, "", 0, 0.95, "grading coefficient of the junctions"},
        {"fc", &UicmCard::F_C, "", 0, 0.95, "fraction of pb above which the junction capacitance is extrapolated linearly"},
        {"js", &UicmCard::J_S, "A/m^2", 0, 1, "saturation current of the junctions per area"},
        {"jssw", &UicmCard::J_SSW, "A/m", 0, 1, "saturation current of the junctions per perimeter"},
        {"nj", &UicmCard::n_dio, "", 0.5, 10, "ideality factor of the junctions (n_dio)"},
        {"eg", &UicmCard::E_g, "V", 0.1, 5, "band gap, for the temperature dependence of the junctions"},
        {"xti", &UicmCard::XTI, "", -10, 20, "temperature exponent of the junctions' saturation current"},
        {"ldif", &UicmCard::L_dif, "m", 0, 1, "length of a source or drain region without given area and perimeter"},
        {"tcv", &UicmCard::alpha_VT, "V/K", -0.1, 0.1, "temperature coefficient of vto"},
        {"tis", &UicmCard::I_S_exponent, "", -5, 5, "temperature exponent of isq: 2 from phi_t^2, minus that of the mobility"},
        {"tnom", &UicmCard::T_nom, "C", -273, 500, "temperature at which the parameters are valid"},
        {"nt", &UicmCard::N_ot, "1/m^2", 0, 1e25, "effective trap density, for flicker noise"},
        {"avt", &UicmCard::A_VT, "V m", 0, 1, "mismatch of vto between devices, times the root of the gate area (Pelgrom)"},
        {"ais", &UicmCard::A_IS, "m", 0, 1, "relative mismatch of isq between devices, times the root of the gate area"},
        {"svt0", &UicmCard::S_VT0, "V", 0, 5, "process variation of vto between chips (standard deviation)"},
        {"sis", &UicmCard::S_IS, "", 0, 5, "relative process variation of isq between chips (standard deviation)"},
    };
};

/// The size of a transistor: `m1 d g s b nch w=1.5u l=0.5u m=2 stack=8`. It is an array of m parallel columns, each of `stack` elements in
/// series under one gate. W and L are those of an element. The array is modelled as one device with I_S = I_SQ m W / (stack L), which is
/// exact for the currents of the model without DIBL, velocity saturation and Early effect, by the series identity (thesis eq. 31).
/// Not exact: dynamic charges of inner nodes; DIBL, velocity saturation and Early effect, which are computed from the total length although
/// they occur mostly in the element at the drain. Left out: junctions and overlaps of inner nodes.
struct UicmInstance {
    double W = 1e-6, L = 1e-6, m = 1, stack = 1, delvto = 0, mulu0 = 1, AS = -1, AD = -1, PS = -1, PD = -1;

    static constexpr ParameterDef<UicmInstance> fields[] = {
        {"w", &UicmInstance::W, "m", 1e-9, 1, "width of an element"},
        {"l", &UicmInstance::L, "m", 1e-9, 1, "length of an element"},
        {"m", &UicmInstance::m, "", 1e-6, 1e9, "columns in parallel"},
        {"stack", &UicmInstance::stack, "", 1, 1e6, "elements in series in each column"},
        {"delvto", &UicmInstance::delvto, "V", -5, 5, "added to vto; a positive value means less current, for both polarities"},
        {"mulu0", &UicmInstance::mulu0, "", 1e-6, 1e6, "factor of the mobility; multiplies isq and zetal"},
        {"as", &UicmInstance::AS, "m^2", -1, 1, "source area of a column; negative: w ldif"},
        {"ad", &UicmInstance::AD, "m^2", -1, 1, "drain area of a column; negative: w ldif"},
        {"ps", &UicmInstance::PS, "m", -1, 1, "source perimeter of a column; negative: 2 (w + ldif)"},
        {"pd", &UicmInstance::PD, "m", -1, 1, "drain perimeter of a column; negative: 2 (w + ldif)"},
    };
    /// The gate area of the whole array, m^2.
    double area() const { return W * L * m * stack; }
};

/// Above this value (A) the current of a junction is extrapolated linearly, so that Newton iterations cannot overflow. Real currents are
/// far lower.
inline constexpr double junction_current_limit = 10e-3;

/// Computes the constants of a transistor at a temperature in degrees Celsius.
UicmConstants uicm_constants(const UicmCard&, const UicmInstance&, double temperature, bool pmos);

/// The deviation of a transistor from its nominal parameters.
struct UicmShift {
    double V_T = 0;     ///< V, added to the threshold
    double factor = 1;  ///< of I_SQ
};

/// The mismatch of one transistor, a random sample for (seed, device, chip): A_VT / sqrt(area) times a standard normal deviate, and the
/// factor exp(A_IS / sqrt(area) times another one). The area is the gate area of the whole array. `device`: number of the transistor, from
/// 0, among the transistors of the flat circuit.
UicmShift sample_mismatch(const UicmCard&, const UicmInstance&, std::uint64_t seed, std::uint32_t device, std::uint64_t chip);
/// A random sample for (seed, chip): standard normal deviates common to all transistors of a chip, V_T0 of NMOS and PMOS, then I_SQ of NMOS
/// and PMOS.
std::array<double, 4> sample_process(std::uint64_t seed, std::uint64_t chip);
/// The deviation of a transistor of this card and polarity. `deviates`: those of sample_process().
UicmShift process_shift(const UicmCard&, bool pmos, const std::array<double, 4>& deviates);
/// Applies mismatch and process shifts to the constants. The mismatch of I_SQ comes from the mobility and changes zeta as well; that of the
/// process does not.
UicmConstants with_shifts(UicmConstants, const UicmShift& mismatch, const UicmShift& process);

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
