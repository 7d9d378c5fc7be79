#pragma once
// One function a kind: netlist and judgement. Currents from 1 fA to 1 mA, capacitances from 1 fF to 1 mF.

#include "circuit/random_circuits.hpp"

namespace corpuscle::circuit {

RandomCircuit draw_relaxation(Dice&);        ///< a Schmitt trigger and a mirror, of transistors
RandomCircuit draw_ideal_relaxation(Dice&);  ///< of formulas: any current, any capacitance
RandomCircuit draw_ring(Dice&);              ///< inverters of transistors
RandomCircuit draw_ideal_ring(Dice&);        ///< three saturating transconductors
RandomCircuit draw_first_order(Dice&);       ///< RC or RL under a pulse or a polygon
RandomCircuit draw_sine_first_order(Dice&);  ///< RC or RL under a sine
RandomCircuit draw_tank(Dice&);              ///< RLC left to itself
RandomCircuit draw_gm_c(Dice&);              ///< a differential pair that drives a capacitor, against .ac
RandomCircuit draw_rectifier(Dice&);         ///< a diode, a capacitor and a load

}  // namespace corpuscle::circuit
