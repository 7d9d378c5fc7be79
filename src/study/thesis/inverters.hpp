#pragma once
// INVA, INVB and INVC under one bias generator, circuits/inverters.cir, as appendix E looks at them: voltages count from half the supply.

#include "study/deck.hpp"

namespace corpuscle {

constexpr const char* inverter_names[] = {"INVA", "INVB", "INVC"};
constexpr char inverter_letters[] = {'a', 'b', 'c'};

struct Inverters {
    Found found;
    double supply;  // V

    /// Under these orders; V_IN in steps of so many volts is the usual one.
    static Result<Inverters> swept(double step, double supply = 0.7);
    static Result<Inverters> ordered(const std::string& orders, std::vector<std::string> settings = {});

    /// What it drives out of an output held at half the supply, A over V.
    Line current(char which) const;
    /// By how much that falls with V_IN, S over V.
    Line transconductance(char which) const;
    double at_rest(char which) const { return transconductance(which).at(0); }  ///< S, at V_IN = 0
    /// The open output, V over V.
    Line characteristic(char which) const;
    /// The rise of the open output at each output voltage: |dV_OUT/dV_IN| over V_OUT.
    Line gain(char which) const;
    /// What it takes from the supply, its output held, A over V.
    Line taken(char which) const;
};

}  // namespace corpuscle
