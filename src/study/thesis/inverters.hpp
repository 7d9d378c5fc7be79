#pragma once
// INVA, INVB and INVC with one bias generator (circuits/inverters.cir), as in appendix E: voltages are relative to half the supply.

#include "study/deck.hpp"

namespace corpuscle {

constexpr const char* inverter_names[] = {"INVA", "INVB", "INVC"};
constexpr char inverter_letters[] = {'a', 'b', 'c'};

struct Inverters {
    Found found;
    double supply;  // V

    /// `run` sweeps V_IN over the supply in steps of `step` (V); `run_with_directives` takes other directives.
    static Result<Inverters> swept(double step, double supply = 0.7);
    static Result<Inverters> ordered(const std::string& directives, std::vector<std::string> settings = {});

    /// Output current (A) over V_IN (V) with the output held at half the supply.
    Line current(char which) const;
    /// Transconductance: the negative slope of that current, S over V.
    Line transconductance(char which) const;
    double at_rest(char which) const { return transconductance(which).at(0); }  ///< S, at V_IN = 0
    /// Voltage of the open output, V over V.
    Line characteristic(char which) const;
    /// Gain of the open output at each output voltage: |dV_OUT/dV_IN| over V_OUT.
    Line gain(char which) const;
    /// Supply current with the output held, A over V.
    Line taken(char which) const;
};

}  // namespace corpuscle
