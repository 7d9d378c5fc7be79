#pragma once
// Reads a .meas line.

#include "circuit/measure/measurement.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// The names that a .meas line may use.
struct MeasureScope {
    const Circuit* circuit = nullptr;  ///< its nodes, elements and parameters; null: none
    /// Results of earlier .meas lines. While these are not complete, any value stands for a result.
    std::vector<std::pair<std::string, double>> results{};
};

/// A .meas line that was read.
struct ParsedMeasurement {
    std::unique_ptr<Measurement> measurement;  ///< null if it is left out
    std::optional<Error> left_out{};           ///< a form of another simulator, or a quantity, that is not available here
    bool uses_results = false;                 ///< true if it depends on results of the scope
};

/// Parses the words of a .meas line that follow NAME, for a plot with the curves of `head`, which needs no values. The line must be
/// normalized (see normalized_measure()):
///
///     find CURVE at=X | find CURVE when EDGE | deriv CURVE at=X | deriv CURVE when EDGE | when EDGE | count EDGE [rise|fall|cross]
///
///     min|max|pp|min_at|max_at|avg|rms|integ CURVE [from=A] [to=B] [td=T] [output=...]
///
///     trig POSITION targ POSITION
///
///     duty|freq|on_time|off_time CURVE [on=A] [off=B] [from=A] [to=B]
///
///     err|err1|err2 CURVE CURVE [from=A] [to=B] [minval=M] [ymin=A] [ymax=B]
///
///     param=EXPRESSION [from=A] [to=B]     (of curves)
///
/// EDGE is CURVE=VALUE or CURVE=CURVE, then SELECTION: [rise=N|last] [fall=N|last] [cross=N|last] [td=T] [from=A] [to=B]. POSITION is at=X,
/// CURVE val=V SELECTION, or EDGE. For an operating point, only `find CURVE` and `param=EXPRESSION` are possible.
///
/// A misspelt word, and a name that the circuit does not have, is an error.
Result<ParsedMeasurement> parse_measurement(const Directive&, const Plot& head, const MeasureScope& = {});

/// True if the line is param=EXPRESSION and the expression has no curves, so that it needs no plot.
bool is_expression_of_results(const Directive&);

/// The value of such a line. `numbers` are the numbers of the analyses and results of earlier lines.
Result<double> evaluate_expression_of_results(const Directive&, const Circuit&, const std::vector<std::pair<std::string, double>>& numbers);

}  // namespace corpuscle::circuit
