#pragma once
// One function a kind: netlist and judgement. Currents from 1 fA to 1 mA, capacitances from 1 fF to 1 mF.

#include "circuit/random_circuits.hpp"

namespace corpuscle::circuit {

RandomCircuit make_relaxation(RandomSource&);        ///< a Schmitt trigger and a mirror, of transistors
RandomCircuit make_ideal_relaxation(RandomSource&);  ///< of formulas: any current, any capacitance
RandomCircuit make_ring(RandomSource&);              ///< inverters of transistors
RandomCircuit make_ideal_ring(RandomSource&);        ///< three saturating transconductors
RandomCircuit make_first_order(RandomSource&);       ///< RC or RL under a pulse or a polygon
RandomCircuit make_sine_first_order(RandomSource&);  ///< RC or RL under a sine
RandomCircuit make_tank(RandomSource&);              ///< RLC left to itself
RandomCircuit make_gm_c(RandomSource&);              ///< a differential pair that drives a capacitor, against .ac
RandomCircuit make_rectifier(RandomSource&);         ///< a diode, a capacitor and a load

}  // namespace corpuscle::circuit
