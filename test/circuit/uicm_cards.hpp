#pragma once
// Devices of the transistor model UICM for tests: a card of the plain model, a card with every effect enabled, and random devices.

#include <cmath>
#include <cstdint>
#include <numbers>

#include "circuit/device/uicm.hpp"
#include "circuit/device/uicm_card.hpp"
#include "core/random.hpp"

namespace corpuscle::circuit::test {

/// Elementary charge (C), Boltzmann constant (J/K), and thermal voltage at 27 C (V).
inline constexpr double elementary_charge = 1.602176634e-19, boltzmann = 1.380649e-23, phi_t = boltzmann * 300.15 / elementary_charge;
enum { D, G, S, B };  ///< order of the terminals

/// The instance with the same mismatch as changes of delvto and mulu0.
inline UicmInstance with_mismatch(UicmInstance instance, const UicmCard& card, std::uint64_t seed, std::uint32_t device,
                                  std::uint64_t chip) {
    const UicmShift shift = sample_mismatch(card, instance, seed, device, chip);
    instance.delvto += shift.V_T, instance.mulu0 *= shift.factor;
    return instance;
}

/// The card with the process variation of one chip.
inline UicmCard with_process(UicmCard card, bool pmos, std::uint64_t seed, std::uint64_t chip) {
    const UicmShift shift = process_shift(card, pmos, sample_process(seed, chip));
    card.V_T0 += shift.V_T, card.I_SQ *= shift.factor;
    return card;
}

/// UICM alone: no velocity saturation, no DIBL, a practically infinite Early voltage, no junctions, only the gate capacitance.
inline UicmCard plain_card() {
    UicmCard card;
    card.V_E = 1e30;
    return card;
}

/// Every effect of the model enabled.
inline UicmCard full_card() {
    UicmCard card;
    card.sigma_L = 5e-9, card.zeta_L = 0.02e-6, card.C_GSO = 3.7e-10, card.C_GDO = 3e-10, card.C_GBO = 1e-11;
    card.C_J = 1e-3, card.C_JSW = 2e-10, card.J_S = 1e-6, card.J_SSW = 1e-13, card.n_dio = 1.05, card.N_ot = 3e11;
    return card;
}

/// The constants of an array of m columns and `stack` rows. W, L: m. T: degrees Celsius.
inline UicmConstants constants_of_size(const UicmCard& card, double W, double L, double m = 1, double stack = 1, bool pmos = false,
                                       double T = 27) {
    UicmInstance instance;
    instance.W = W, instance.L = L, instance.m = m, instance.stack = stack;
    return uicm_constants(card, instance, T, pmos);
}

/// Evaluates a device at the voltages of drain, gate, source and bulk.
inline UicmEvaluation<double> evaluate(const UicmConstants& c, double d, double g, double s, double b) {
    UicmEvaluation<double> out;
    Uicm<double>(c).eval({d, g, s, b}, out);
    return out;
}

/// The channel current, A.
inline double current(const UicmConstants& c, double d, double g, double s, double b = 0) {
    return Uicm<double>(c).internals({d, g, s, b}).I;
}

/// Number k of a series of random devices with random terminal voltages: weak to strong inversion, some bulks forward-biased, and V_DS
/// about 0 in every fourth.
struct RandomDevice {
    UicmConstants c;
    double v[4];  ///< V, in order D, G, S, B
    explicit RandomDevice(std::uint32_t k) {
        const auto z = [k](std::uint32_t quantity) { return normal(7, k, quantity, 0); };
        UicmCard card = full_card();
        if (k % 3 == 0) card.sigma_L = 0;
        if (k % 5 == 0) card.zeta_L = 0;
        if (k % 7 == 0) card.zeta_L *= 20;
        if (k % 6 < 2) card.gamma = k % 12 < 6 ? 0.45 : 0.2;
        c = constants_of_size(card, 1.5e-6, 0.5e-6, 1 + k % 4, 1 + k % 8, k % 2 == 1, -55 + 180 * (0.5 + 0.5 * std::tanh(z(4))));
        for (std::uint32_t n = 0; n < 4; ++n) v[n] = (k % 2 == 1 ? -1 : 1) * (0.3 + 0.45 * z(n));
        if (k % 16 < 4) v[G] *= 3;
        if (k % 4 == 0) v[S] = v[D] + (k % 8 == 0 ? 0 : 1e-7 * z(5));
    }
};

}  // namespace corpuscle::circuit::test
