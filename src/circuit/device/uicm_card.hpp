#pragma once
// What a netlist says of a transistor: its process card (.model) and its size (the M line); and the numbers that follow from both.

#include <cstdint>

#include "circuit/device/uicm_constants.hpp"
#include "signal/field.hpp"

namespace corpuscle::circuit {

/// A process card: `.model nch nmos (level=80 isq=112n vto=0.461 ...)`. The two polarities are mirror images, so the same numbers mean
/// the same for both: vto > 0 is an enhancement device, also for PMOS.
/// Effects of length: DIBL and velocity saturation go with 1/L, the Early voltage with L. For zeta = mu phi_t / (L v_sat) that is what
/// it means; for all three it is what makes a stack of units the one device of their summed length.
struct UicmCard {
    double I_SQ = 112e-9, V_T0 = 0.461, n = 1.27, sigma_L = 0, zeta_L = 0, V_E = 8e6, C_ox = 8.42e-3;
    double C_GSO = 0, C_GDO = 0, C_GBO = 0;
    double C_J = 0, C_JSW = 0, P_B = 0.8, M_J = 0.4, F_C = 0.5, J_S = 0, J_SSW = 0, n_dio = 1, E_g = 1.11, XTI = 3, L_dif = 0.5e-6;
    double alpha_VT = -0.4e-3, I_S_exponent = 0.5, T_nom = 27, N_ot = 0;
    double A_VT = 0, A_IS = 0, S_VT0 = 0, S_IS = 0;

    static constexpr double level = 80;  ///< the level= of this model in a .model line: one that no SPICE has given away
    static constexpr std::string_view name = "uicm", sentence = "UICM transistor, all regions (ACM2 for what UICM leaves out)";
    static constexpr std::string_view source = "choice: circuits of 0.18 um; see process/tsmc180.lib";
    static constexpr Field<UicmCard> fields[] = {
        {"isq", &UicmCard::I_SQ, "A", 1e-15, 1, "specific current of a square, mu C_ox n phi_t^2 / 2"},
        {"vto", &UicmCard::V_T0, "V", -5, 5, "threshold: V_GB where V_P = 0; positive for enhancement devices of both polarities"},
        {"n", &UicmCard::n, "", 1.000001, 5, "slope factor"},
        {"sigmal", &UicmCard::sigma_L, "m", 0, 1e-3, "DIBL times length: V_T falls by sigmal / L times V_DB + V_SB"},
        {"zetal", &UicmCard::zeta_L, "m", 0, 1e-3, "velocity saturation times length, mu phi_t / v_sat"},
        {"ve", &UicmCard::V_E, "V/m", 1, 1e30, "Early voltage of a metre of channel: V_A = V_E L"},
        {"cox", &UicmCard::C_ox, "F/m^2", 0, 10, "gate capacitance of an area"},
        {"cgso", &UicmCard::C_GSO, "F/m", 0, 1, "overlap of gate and source, of a width"},
        {"cgdo", &UicmCard::C_GDO, "F/m", 0, 1, "overlap of gate and drain, of a width"},
        {"cgbo", &UicmCard::C_GBO, "F/m", 0, 1, "overlap of gate and bulk, of a length"},
        {"cj", &UicmCard::C_J, "F/m^2", 0, 10, "junction capacitance at 0 V, of an area"},
        {"cjsw", &UicmCard::C_JSW, "F/m", 0, 1, "junction capacitance at 0 V, of a perimeter; with pb and mj of the area"},
        {"pb", &UicmCard::P_B, "V", 0.1, 5, "built-in potential of the junctions"},
        {"mj", &UicmCard::M_J, "", 0, 0.95, "grading of the junctions"},
        {"fc", &UicmCard::F_C, "", 0, 0.95, "part of pb above which the junction capacitance follows its tangent"},
        {"js", &UicmCard::J_S, "A/m^2", 0, 1, "saturation current of the junctions, of an area"},
        {"jssw", &UicmCard::J_SSW, "A/m", 0, 1, "saturation current of the junctions, of a perimeter"},
        {"nj", &UicmCard::n_dio, "", 0.5, 10, "ideality of the junctions (n_dio)"},
        {"eg", &UicmCard::E_g, "V", 0.1, 5, "band gap, for the junctions' temperature law"},
        {"xti", &UicmCard::XTI, "", -10, 20, "power of T in the junctions' saturation current"},
        {"ldif", &UicmCard::L_dif, "m", 0, 1, "length of a source or drain that says neither area nor perimeter"},
        {"tcv", &UicmCard::alpha_VT, "V/K", -0.1, 0.1, "change of vto with temperature"},
        {"tis", &UicmCard::I_S_exponent, "", -5, 5, "power of T in isq: 2 from phi_t^2, less the mobility's"},
        {"tnom", &UicmCard::T_nom, "C", -273, 500, "temperature at which the card's numbers hold"},
        {"nt", &UicmCard::N_ot, "1/m^2", 0, 1e25, "effective traps of an area, for flicker noise"},
        {"avt", &UicmCard::A_VT, "V m", 0, 1, "mismatch of vto between devices, times the root of the gate area (Pelgrom)"},
        {"ais", &UicmCard::A_IS, "m", 0, 1, "relative mismatch of isq between devices, times the root of the gate area"},
        {"svt0", &UicmCard::S_VT0, "V", 0, 5, "spread of vto from run to run of the process (deviation)"},
        {"sis", &UicmCard::S_IS, "", 0, 5, "relative spread of isq from run to run of the process (deviation)"},
    };
};

/// A transistor's size: `m1 d g s b nch w=1.5u l=0.5u m=2 stack=8`. It is m parallel columns of `stack` units in series under one gate,
/// W and L those of a unit, taken as one device of I_S = I_SQ m W / (stack L). The series identity (thesis eq. 31) makes this exact for
/// the currents of the plain model. Not exact: charges of inner nodes in motion, sigma, zeta and Early voltage (each of the array is that
/// of the summed length, where really the unit at the drain bears most of it), and what is left out: junctions and overlaps of inner nodes.
struct UicmInstance {
    double W = 1e-6, L = 1e-6, m = 1, stack = 1, delvto = 0, mulu0 = 1, AS = -1, AD = -1, PS = -1, PD = -1;

    static constexpr Field<UicmInstance> fields[] = {
        {"w", &UicmInstance::W, "m", 1e-9, 1, "width of a unit"},
        {"l", &UicmInstance::L, "m", 1e-9, 1, "length of a unit"},
        {"m", &UicmInstance::m, "", 1e-6, 1e9, "columns in parallel"},
        {"stack", &UicmInstance::stack, "", 1, 1e6, "units in series in each column"},
        {"delvto", &UicmInstance::delvto, "V", -5, 5, "added to vto; positive is slower, for both polarities"},
        {"mulu0", &UicmInstance::mulu0, "", 1e-6, 1e6, "factor of the mobility: of isq and zetal"},
        {"as", &UicmInstance::AS, "m^2", -1, 1, "area of a column's source; below 0: w ldif"},
        {"ad", &UicmInstance::AD, "m^2", -1, 1, "area of a column's drain; below 0: w ldif"},
        {"ps", &UicmInstance::PS, "m", -1, 1, "perimeter of a column's source; below 0: 2 (w + ldif)"},
        {"pd", &UicmInstance::PD, "m", -1, 1, "perimeter of a column's drain; below 0: 2 (w + ldif)"},
    };
    double area() const { return W * L * m * stack; }
};

/// Junction currents beyond this go on along their tangents: far above all these devices carry, and Newton cannot overflow.
inline constexpr double junction_current_top = 10e-3;

/// temperature in C.
UicmConstants uicm_constants(const UicmCard&, const UicmInstance&, double temperature, bool pmos);

/// How a transistor differs from its design.
struct UicmShift {
    double V_T = 0, factor = 1;  ///< V; of I_SQ
};

/// A transistor's own part, drawn for (seed, device, chip): A_VT / sqrt(area) times a normal deviate, and exp(A_IS / sqrt(area) times
/// another), over the gate area of the whole array. `device` numbers the transistors of a netlist.
UicmShift mismatch(const UicmCard&, const UicmInstance&, std::uint64_t seed, std::uint32_t device, std::uint64_t chip);
/// The same as the instance's delvto and mulu0.
UicmInstance with_mismatch(UicmInstance, const UicmCard&, std::uint64_t seed, std::uint32_t device, std::uint64_t chip);

/// What all transistors of a chip share, as normal deviates drawn for (seed, chip): V_T0 of NMOS and of PMOS, then I_SQ of both.
struct ProcessDeviates {
    double of[4];
};
ProcessDeviates process_deviates(std::uint64_t seed, std::uint64_t chip);
UicmShift process(const UicmCard&, bool pmos, const double (&deviates)[4]);
/// The card as the process made it on one chip.
UicmCard with_process(UicmCard, bool pmos, std::uint64_t seed, std::uint64_t chip);

/// The numbers of a transistor that its own part and the process have shifted: those of with_mismatch and with_process, to rounding.
UicmConstants shifted(UicmConstants, const UicmShift& own, const UicmShift& process);

}  // namespace corpuscle::circuit
