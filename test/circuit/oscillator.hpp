#pragma once
// A relaxation oscillator: a current discharges the membrane, and a mirror charges it while the output of a Schmitt trigger is high.
// It fires about 37 spikes per second, which are pulses of v(s). u is the membrane.

#include <string>

namespace corpuscle::circuit {

/// Its netlist with a transient. `duration`: with a unit, such as "1" or "200m" (s).
inline std::string oscillator_netlist(const std::string& duration) {
    const std::string p = " vdd pch w=6u l=0.5u m=2 stack=4\n", n = " 0 nch w=1.5u l=0.5u ";
    return "oscillator\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\ncu u 0 1.8p\niin u 0 20p\nic gc 0 1n\nm1 gc gc vdd" + p + "m2 y gc vdd" + p +
           "m3 u sb y vdd pch w=6u l=0.5u m=2\nm4 mp u vdd" + p +
           "m5 s u mp vdd pch w=6u l=0.5u m=16\nm6 0 s mp vdd pch w=6u l=0.5u m=8\nm7 mn u 0" + n + "m=2 stack=4\nm8 s u mn" + n +
           "m=16\nm9 vdd s mn" + n + "m=8\nm10 sb s vdd vdd pch w=6u l=0.5u m=2\nm11 sb s 0" + n + "m=2\n.ic v(u)=0.6\n.tran 10u " +
           duration + "\n";
}

}  // namespace corpuscle::circuit
