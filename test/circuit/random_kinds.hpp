#pragma once
// One function for each kind of random circuit; it returns a netlist and a check of its run. Currents are from 1 fA to 1 mA, capacitances
// from 1 fF to 1 mF.

#include "circuit/random_circuits.hpp"

namespace corpuscle::circuit {

RandomCircuit make_relaxation(RandomSource&);        ///< relaxation oscillator: a Schmitt trigger and a mirror, made of transistors
RandomCircuit make_ideal_relaxation(RandomSource&);  ///< relaxation oscillator made of expressions
RandomCircuit make_ring(RandomSource&);              ///< ring oscillator: inverters made of transistors
RandomCircuit make_ideal_ring(RandomSource&);        ///< ring oscillator: three saturating transconductors
RandomCircuit make_first_order(RandomSource&);       ///< RC or RL driven by PULSE or PWL
RandomCircuit make_sine_first_order(RandomSource&);  ///< RC or RL driven by a sine
RandomCircuit make_tank(RandomSource&);              ///< free oscillation of an RLC circuit
RandomCircuit make_gm_c(RandomSource&);              ///< a differential pair that drives a capacitor, compared with .ac
RandomCircuit make_rectifier(RandomSource&);         ///< a diode, a capacitor and a load

}  // namespace corpuscle::circuit
