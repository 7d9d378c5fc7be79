#pragma once
// The model card of SPICE's level 1 MOS transistor, and the values that follow from it at a temperature.

#include "circuit/device/mos/mos_device.hpp"
#include "circuit/device/mos/mos_line.hpp"

namespace corpuscle::circuit {

/// `.model n nmos (vto=0.7 kp=100u ...)`. vto is negative for an enhancement PMOS. Units are those of SPICE: u0 in cm^2/(V s), nsub in
/// 1/cm^3, nss in 1/cm^2.
struct Mos1Card {
    double vto = 0, kp = 2e-5, gamma = 0, phi = 0.6, lambda = 0, rd = 0, rs = 0, rsh = 0;
    double is = 1e-14, js = 0, pb = 0.8, cbd = 0, cbs = 0, cj = 0, mj = 0.5, cjsw = 0, mjsw = 0.5, fc = 0.5;
    double cgso = 0, cgdo = 0, cgbo = 0, tox = 0, ld = 0, u0 = 600, nsub = 0, nss = 0, tpg = 1, kf = 0, af = 1, tnom = 27;

    static constexpr std::string_view name = "mos1", description = "MOS transistor, SPICE level 1 (Shichman-Hodges)";
    static constexpr std::string_view source = "Shichman and Hodges, IEEE J. Solid-State Circuits 3, 1968; defaults of SPICE";
    static constexpr ParameterDef<Mos1Card> fields[] = {
        {"vto", &Mos1Card::vto, "V", -1e3, 1e3, "threshold at v_bs = 0; without it computed from tox and nsub, or 0"},
        {"kp", &Mos1Card::kp, "A/V^2", 0, 1e3, "transconductance parameter; without it u0 times the capacitance of tox, if tox is given"},
        {"gamma", &Mos1Card::gamma, "V^0.5", 0, 1e3, "bulk threshold parameter; without it computed from tox and nsub, or 0"},
        {"phi", &Mos1Card::phi, "V", 0.01, 10, "surface potential; without it computed from nsub if tox is given, too"},
        {"lambda", &Mos1Card::lambda, "1/V", 0, 1e3, "channel length modulation"},
        {"rd", &Mos1Card::rd, "ohm", 0, 1e12, "drain resistance; without it rsh nrd"},
        {"rs", &Mos1Card::rs, "ohm", 0, 1e12, "source resistance; without it rsh nrs"},
        {"rsh", &Mos1Card::rsh, "ohm", 0, 1e12, "resistance of drain and source for each square"},
        {"is", &Mos1Card::is, "A", 0, 1e3, "saturation current of each bulk junction; 0: no current"},
        {"js", &Mos1Card::js, "A/m^2", 0, 1e9, "the same for each area; used if ad and as are not 0"},
        {"pb", &Mos1Card::pb, "V", 0.1, 10, "potential of the bulk junctions"},
        {"cbd", &Mos1Card::cbd, "F", 0, 1, "capacitance of the drain junction at 0 V; without it cj ad"},
        {"cbs", &Mos1Card::cbs, "F", 0, 1, "capacitance of the source junction at 0 V; without it cj as"},
        {"cj", &Mos1Card::cj, "F/m^2", 0, 10, "capacitance of a junction at 0 V for each area"},
        {"mj", &Mos1Card::mj, "", 0, 0.95, "grading coefficient of the area"},
        {"cjsw", &Mos1Card::cjsw, "F/m", 0, 1, "capacitance of a junction at 0 V for each perimeter"},
        {"mjsw", &Mos1Card::mjsw, "", 0, 0.95, "grading coefficient of the perimeter"},
        {"fc", &Mos1Card::fc, "", 0, 0.95, "fraction of pb above which the junction capacitances are extrapolated linearly"},
        {"cgso", &Mos1Card::cgso, "F/m", 0, 1, "gate-source overlap capacitance for each width"},
        {"cgdo", &Mos1Card::cgdo, "F/m", 0, 1, "gate-drain overlap capacitance for each width"},
        {"cgbo", &Mos1Card::cgbo, "F/m", 0, 1, "gate-bulk overlap capacitance for each length"},
        {"tox", &Mos1Card::tox, "m", 0, 1, "oxide thickness; without it, or 0, the channel has no charge"},
        {"ld", &Mos1Card::ld, "m", 0, 1, "lateral diffusion; the channel is 2 ld shorter than l"},
        {"u0", &Mos1Card::u0, "cm^2/(V s)", 0, 1e6, "mobility, for kp"},
        {"nsub", &Mos1Card::nsub, "1/cm^3", 0, 1e22, "doping of the bulk"},
        {"nss", &Mos1Card::nss, "1/cm^2", -1e20, 1e20, "density of surface states"},
        {"tpg", &Mos1Card::tpg, "", -1, 1, "gate: 1 doped unlike the bulk, -1 like it, 0 aluminium"},
        {"kf", &Mos1Card::kf, "", 0, 1, "flicker noise coefficient"},
        {"af", &Mos1Card::af, "", 0.1, 10, "flicker noise exponent"},
        {"tnom", &Mos1Card::tnom, "C", -273, 1000, "temperature at which the parameters were measured"},
    };
};

/// Constants of one device at its temperature, for the polarity of an NMOS and all transistors in parallel.
struct Mos1Constants {
    double beta;             ///< A/V^2: kp W / L
    double vbi, gamma, phi;  ///< V, V^0.5, V: threshold vbi + gamma sqrt(phi - v_bs)
    double lambda;           ///< 1/V
    double C_ox;             ///< F, of the channel
    double flicker, af;      ///< A^2/Hz at 1 Hz and 1 A; exponent
    double kelvin;
};

/// All names that a card may have.
std::vector<std::string_view> mos1_parameter_names();
/// The parameters of levels 2 and 3 that have no effect here.
std::span<const std::string_view> parameters_of_higher_levels();

/// Reads the card and computes what SPICE derives from tox, nsub, u0, tpg and nss.
Result<Mos1Card> read_mos1_card(const Model&);
Result<Mos1Constants> mos1_constants(const Mos1Card&, const MosSize&, double kelvin, bool pmos);
/// The .model line of a card for ngspice.
std::string mos1_model_line(const Model&, std::string_view name);
/// Junctions, overlaps and resistances.
MosSurroundings mos1_surroundings(const Mos1Card&, const Model&, const MosSize&, double kelvin);

}  // namespace corpuscle::circuit
