#pragma once
// The .meas lines of a netlist for ngspice, which does not know all forms.

#include <set>

#include "circuit/export/element_text.hpp"

namespace corpuscle::circuit {

/// Writes the .meas lines one by one, in the order of the netlist.
class MeasureExporter {
    const Circuit& circuit_;
    const ExportNames& names_;
    std::set<std::string, std::less<>> left_out_;  // names of measures

public:
    MeasureExporter(const Circuit& circuit, const ExportNames& names) : circuit_(circuit), names_(names) {}

    /// The lines of a .meas; or, as an error, the reason why ngspice cannot measure it.
    Result<std::string> text(const Directive&);

private:
    Result<std::string> measured(const Directive& normalized) const;
    Result<std::string> slope(const Directive& normalized) const;
    /// From one position to another: "trig v(a)=0.5" becomes "trig v(a) val=0.5".
    Result<std::string> distance(Directive normalized) const;
    std::string line(const Directive&) const;
    /// The end of a sweep as a position just before it. To ngspice the end is outside, because of the rounding errors of its steps.
    Directive within_sweep(Directive) const;
};

}  // namespace corpuscle::circuit
