#pragma once
// The model card of the EKV 2.6 transistor, and the values that follow from it at a temperature.

#include "circuit/device/mos/mos_device.hpp"
#include "circuit/device/mos/mos_line.hpp"

namespace corpuscle::circuit {

/// `.model n nmos (level=55 vto=0.5 gamma=0.7 ...)`. vto is negative for an enhancement PMOS, and tcv has the sign of vto.
struct EkvCard {
    double cox = 0.7e-3, xj = 0.1e-6, dw = 0, dl = 0, vto = 0.5, gamma = 1, phi = 0.7, kp = 50e-6, e0 = 1e12, theta = 0;
    double ucrit = 2e6, lambda = 0.5, weta = 0.25, leta = 0.1, q0 = 0, lk = 0.29e-6, iba = 0, ibb = 3e8, ibn = 1;
    double tcv = 1e-3, bex = -1.5, ucex = 0.8, ibbt = 9e-4, kf = 0, af = 1, hdif = 0, rsh = 0, rd = 0, rs = 0;
    double cgso = 0, cgdo = 0, cgbo = 0, is = 1e-14, js = 0, jsw = 0, n = 1, xti = 0, cbd = 0, cbs = 0;
    double cj = 0, mj = 0.5, pb = 0.8, cjsw = 0, mjsw = 0.33, pbsw = 0.8, fc = 0.5, tnom = 25, avto = 0, akp = 0, agamma = 0;

    static constexpr std::string_view name = "ekv", description = "MOS transistor, EKV 2.6";
    static constexpr std::string_view source =
        "Bucher, Lallement, Enz, Theodoloz and Krummenacher, The EPFL-EKV MOSFET Model Equations for Simulation, version 2.6, EPFL 1998";
    static constexpr ParameterDef<EkvCard> fields[] = {
        {"cox", &EkvCard::cox, "F/m^2", 1e-6, 1, "gate capacitance for each area"},
        {"xj", &EkvCard::xj, "m", 1e-9, 1e-3, "depth of the junctions"},
        {"dw", &EkvCard::dw, "m", -1e-3, 1e-3, "added to w"},
        {"dl", &EkvCard::dl, "m", -1e-3, 1e-3, "added to l"},
        {"vto", &EkvCard::vto, "V", -100, 100, "threshold of a long transistor at v_s = v_b"},
        {"gamma", &EkvCard::gamma, "V^0.5", 0, 100, "body effect"},
        {"phi", &EkvCard::phi, "V", 0.1, 10, "surface potential"},
        {"kp", &EkvCard::kp, "A/V^2", 0, 1e3, "transconductance parameter"},
        {"e0", &EkvCard::e0, "V/m", 0, 1e30, "vertical field that halves the mobility; 0: theta applies instead"},
        {"theta", &EkvCard::theta, "1/V", 0, 100, "mobility reduction by the pinch-off voltage, if e0 is not given"},
        {"ucrit", &EkvCard::ucrit, "V/m", 1e3, 1e30, "longitudinal critical field, for velocity saturation"},
        {"lambda", &EkvCard::lambda, "", 0, 100, "depletion length coefficient, for channel length modulation"},
        {"weta", &EkvCard::weta, "", 0, 100, "narrow-channel effect"},
        {"leta", &EkvCard::leta, "", 0, 100, "short-channel effect"},
        {"q0", &EkvCard::q0, "C/m^2", -1, 1, "reverse short-channel effect: peak charge density"},
        {"lk", &EkvCard::lk, "m", 1e-9, 1, "reverse short-channel effect: length"},
        {"iba", &EkvCard::iba, "1/m", 0, 1e15, "impact ionisation: first coefficient; 0: none"},
        {"ibb", &EkvCard::ibb, "V/m", 1e3, 1e15, "impact ionisation: second coefficient"},
        {"ibn", &EkvCard::ibn, "", 0, 100, "impact ionisation: factor of the saturation voltage"},
        {"tcv", &EkvCard::tcv, "V/K", -1, 1, "vto falls by this with temperature"},
        {"bex", &EkvCard::bex, "", -10, 10, "temperature exponent of kp"},
        {"ucex", &EkvCard::ucex, "", -10, 10, "temperature exponent of ucrit"},
        {"ibbt", &EkvCard::ibbt, "1/K", -1, 1, "temperature coefficient of ibb"},
        {"kf", &EkvCard::kf, "", 0, 1, "flicker noise coefficient"},
        {"af", &EkvCard::af, "", 1, 1, "flicker noise exponent; only 1 is supported"},
        {"hdif", &EkvCard::hdif, "m", 0, 1, "half the length of a source or drain: without ad, 2 hdif w; with rsh a resistance"},
        {"rsh", &EkvCard::rsh, "ohm", 0, 1e12, "resistance of drain and source for each square"},
        {"rd", &EkvCard::rd, "ohm", 0, 1e12, "drain resistance; without it rsh nrd, or rsh hdif / w without nrd"},
        {"rs", &EkvCard::rs, "ohm", 0, 1e12, "source resistance; without it rsh nrs, or rsh hdif / w without nrs"},
        {"cgso", &EkvCard::cgso, "F/m", 0, 1, "gate-source overlap capacitance for each width"},
        {"cgdo", &EkvCard::cgdo, "F/m", 0, 1, "gate-drain overlap capacitance for each width"},
        {"cgbo", &EkvCard::cgbo, "F/m", 0, 1, "gate-bulk overlap capacitance for each length"},
        {"is", &EkvCard::is, "A", 1e-40, 1e3, "saturation current of each bulk junction, if js and jsw are 0"},
        {"js", &EkvCard::js, "A/m^2", 0, 1e9, "the same for each area"},
        {"jsw", &EkvCard::jsw, "A/m", 0, 1e9, "the same for each perimeter"},
        {"n", &EkvCard::n, "", 0.1, 10, "emission coefficient of the junctions"},
        {"xti", &EkvCard::xti, "", -100, 100, "temperature exponent of the junctions' saturation current"},
        {"cbd", &EkvCard::cbd, "F", 0, 1, "capacitance of the drain junction at 0 V; without it cj ad"},
        {"cbs", &EkvCard::cbs, "F", 0, 1, "capacitance of the source junction at 0 V; without it cj as"},
        {"cj", &EkvCard::cj, "F/m^2", 0, 10, "capacitance of a junction at 0 V for each area"},
        {"mj", &EkvCard::mj, "", 0, 0.95, "grading coefficient of the area"},
        {"pb", &EkvCard::pb, "V", 0.1, 10, "potential of the area"},
        {"cjsw", &EkvCard::cjsw, "F/m", 0, 1, "capacitance of a junction at 0 V for each perimeter"},
        {"mjsw", &EkvCard::mjsw, "", 0, 0.95, "grading coefficient of the perimeter"},
        {"pbsw", &EkvCard::pbsw, "V", 0.1, 10, "potential of the perimeter"},
        {"fc", &EkvCard::fc, "", 0, 0.95, "fraction of pb above which the junction capacitances are extrapolated linearly"},
        {"tnom", &EkvCard::tnom, "C", -273, 1000, "temperature at which the parameters were measured"},
        {"avto", &EkvCard::avto, "V m", 0, 1, "mismatch of vto; without effect"},
        {"akp", &EkvCard::akp, "m", 0, 1, "mismatch of kp; without effect"},
        {"agamma", &EkvCard::agamma, "V^0.5 m", 0, 1, "mismatch of gamma; without effect"},
    };
};

/// Constants of one device at its temperature, for the polarity of an NMOS.
struct EkvConstants {
    double vt, kelvin;               ///< kT/q, V; K
    double vto, gamma, phi;          ///< with the reverse short-channel effect in vto
    double kp_w;                     ///< A m/V^2: kp times the effective width
    double l, w, m;                  ///< m: effective length and width; transistors in parallel
    double cox;                      ///< F/m^2
    double l_c;                      ///< m: sqrt(eps_si xj / cox)
    double ucrit, v_c, lambda;       ///< V/m, V (ucrit l), coefficient
    double short_term, narrow_term;  ///< V^0.5 for each V^0.5: factors of the changes of gamma
    double field;                    ///< 1/V: cox / (eps_si e0); 0: theta applies
    double theta, eta;               ///< 1/V; weight of the inversion charge in the vertical field
    double iba, ibb, ibn;            ///< 1/m, V/m
    double kf;
};

Result<EkvCard> read_ekv_card(const Model&);
Result<EkvConstants> ekv_constants(const EkvCard&, const MosSize&, double kelvin, bool pmos);
/// Junctions, overlaps and resistances.
MosSurroundings ekv_surroundings(const EkvCard&, const Model&, const Element&, const MosSize&, double kelvin);

}  // namespace corpuscle::circuit
