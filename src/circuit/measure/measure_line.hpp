#pragma once
// The line of a .meas in one form for all simulators.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// True for .meas and .measure.
inline bool is_measure(const Directive& c) { return c.name == "meas" || c.name == "measure"; }

/// Writes the words of a .meas line as ANALYSIS NAME MEASUREMENT ..., with the first spelling of each:
///
///  - A line without ANALYSIS (LTspice) gets that of the first analysis of the circuit.
///  - "at 1m" becomes "at=1m", and "2 * v(a)" becomes "2*v(a)".
///  - param, eqn and equation become one word, "param=EXPRESSION".
///  - derivative becomes deriv; int and integral become integ.
///  - Words without effect here (goal=, weight=, precision=, print=, default_val=) are removed.
///
/// Words keep their columns. It is an error if a word is missing.
Result<Directive> normalized_measure(const Directive&, const Circuit&);

/// The kind of analysis of another simulator (tran_cont, fft ...) that ANALYSIS names; "" if it is none of these.
std::string_view foreign_measured_analysis(std::string_view word);

/// The words with which a measurement may begin, as in "min, max ...".
std::string known_measurements();
bool is_measurement(std::string_view word);
/// True for a measurement of another simulator that is not computed here: error, four, thd ...
bool is_foreign_measurement(std::string_view word);
/// True for the name before '=' of a qualifier that other simulators have and that has no equivalent here.
bool is_foreign_qualifier(std::string_view name);

}  // namespace corpuscle::circuit
