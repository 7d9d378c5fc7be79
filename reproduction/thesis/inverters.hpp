#pragma once
// INVA, INVB and INVC with one bias generator (circuits/inverters.cir), as in appendix E. The curves' voltages are relative
// to half the supply.

#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {

constexpr const char* inverter_names[] = {"INVA", "INVB", "INVC"};
constexpr char inverter_letters[] = {'a', 'b', 'c'};

struct InverterSweep {
    NetlistResult netlist_result;
    double supply;  // V

    /// `run` sweeps the input from ground to the supply in steps of `step` (V). `run_with_directives` runs other directives at 0.7 V.
    static Result<InverterSweep> run(double step, double supply = 0.7);
    static Result<InverterSweep> run_with_directives(const std::string& directives, std::vector<std::string> settings = {});

    /// Output current (A) over V_IN (V) with the output held at half the supply. `letter`: one of inverter_letters.
    StudyCurve output_current(char letter) const;
    /// Transconductance: the negative slope of output_current, S over V_IN.
    StudyCurve transconductance(char letter) const;
    double transconductance_at_zero(char letter) const { return transconductance(letter).at(0); }  ///< S, at V_IN = 0
    /// Voltage of the open output, V over V_IN.
    StudyCurve transfer_curve(char letter) const;
    /// Gain of the open output at each output voltage: |dV_OUT/dV_IN| over V_OUT.
    StudyCurve voltage_gain(char letter) const;
    /// Supply current with the output held at half the supply, A over V_IN.
    StudyCurve supply_current(char letter) const;
};

}  // namespace corpuscle
