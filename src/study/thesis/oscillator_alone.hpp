#pragma once
// The oscillator of fig. 38 by itself under a constant current, and the thresholds of its trigger.

#include "study/deck.hpp"

namespace corpuscle {

/// I_LEAK 2 pA, I_CHARGE 1 nA, 1.8 pF, as fig. 39 is printed.
struct OscillatorAlone {
    static constexpr double I_LEAK = 2e-12, I_CHARGE = 1e-9, C = 1.8e-12;  // A, F
    double current = 20e-12;                                               ///< A, from 10 ms on
    double until = 0.2;                                                    ///< s
    bool better_switches = false;                                          ///< of the higher threshold, which leak next to nothing
    double leak = I_LEAK;                                                  ///< A
};
/// v(u), v(s) in time; its spikes; v(u) at rest.
Result<Found> driven(const OscillatorAlone&);

/// An output over an input that goes up and down again.
struct Hysteresis {
    Line up, down;
    double V_H, V_L;  ///< where the output passes half the supply of 0.7 V, going up and going down
};
/// Of the first .dc of this word that has `updown`.
Hysteresis hysteresis_in(const Found&, const std::string& output);
Result<Hysteresis> trigger_alone();

}  // namespace corpuscle
