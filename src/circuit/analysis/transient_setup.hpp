#pragma once
// The input of a transient: .tran and .options, its initial condition, and .spike and .assert.

#include "circuit/output/saved_quantities.hpp"
#include "circuit/solve/transient.hpp"
#include "core/afferent.hpp"

namespace corpuscle::circuit {

/// The plan from .options: accuracy=rough|normal|fine|finest, reltol, vntol, abstol, method=gear|trap, maxord,
/// noisefmax, noisefmin, noiseseed, noisescale. stop and max_step are not set. Errors: an invalid value.
Result<TransientPlan> read_transient_plan(const Circuit&);

/// The words of .tran STEP STOP [START [LONGEST]] [uic].
struct TransientTimes {
    double step = 0, stop = 0, start = 0;  ///< s
    std::optional<double> max_step;        ///< s: LONGEST, if given
    bool uic = false;                      ///< true if given
};
Result<TransientTimes> read_transient_times(const Directive&);

struct InitialCondition {
    std::vector<double> x;
    bool is_consistent = true;       ///< true: x solves the equations; false (uic): only the charges at x are valid
    std::vector<double> charge{};    ///< C, by equation: charge that ic= of elements adds to the charges at x; empty: none
    std::vector<char> states{};      ///< of the devices with states
    std::optional<Error> warning{};  ///< says that the operating point is unstable, so that the transient starts beside it
};

/// Without uic: the operating point with the nodes of .ic clamped, searched from the unknowns `guess` if these are given. With uic: the
/// voltages of .ic, all other nodes at 0 V, capacitors with ic= charged to that voltage, inductors with ic= carrying that current. Without
/// .ic and uic, a circuit whose operating point is unstable starts 10 mV from it, in the direction of the fastest growing disturbance.
Result<InitialCondition> find_initial_condition(AnalysisContext&, bool uic, std::vector<double> guess = {});

/// .spike v(NODE[,NODE]) LEVEL [rise|fall]: a spike occurs where the voltage, or the current i(V), crosses the level upwards (default)
/// or downwards.
struct SpikeOutput {
    SavedQuantity quantity;
    double level = 0;       ///< V or A
    bool is_rising = true;  ///< true if upward crossings are spikes, false if downward ones are
    SourceLocation location;

    /// The time of the first spike within the last step of the transient, s; nothing if the step has no spike.
    std::optional<double> find_spike(const Transient& t) const {
        return t.crossing(quantity.unknowns.plus, quantity.unknowns.minus, level, is_rising);
    }
};

/// Reads the .spike directive; nothing if the circuit has none. A second .spike is an error.
Result<std::optional<SpikeOutput>> read_spike_output(const System&);

/// .assert v(NODE[,NODE]) LOW HIGH ["MESSAGE"]: the range of a voltage, or of a current i(V), in which the circuit works as designed.
/// Violations are reported; the simulation continues.
struct OperatingRange {
    SavedQuantity quantity;
    double low, high;     ///< V or A; both are within the range
    std::string message;  ///< explains a violation; may be ""
    SourceLocation location;

    ValidRange range() const { return {quantity.name, quantity.is_voltage() ? "V" : "A", low, high, message}; }
    /// True if a value of the quantity is within the range.
    bool contains(double x) const { return x >= low && x <= high; }
};
/// Counts a sample in the violations of each range that does not contain value(quantity).
template <class Value>
void check_ranges(std::span<const OperatingRange> ranges, std::span<RangeViolation> violations, std::int64_t sample, const Value& value) {
    for (std::size_t k = 0; k < violations.size(); ++k)
        if (auto& v = violations[k]; !ranges[k].contains(value(ranges[k].quantity)))
            v = {v.samples + 1, v.first_sample < 0 ? sample : v.first_sample};
}
/// Reads all .assert lines of the system's circuit.
Result<std::vector<OperatingRange>> read_operating_ranges(const System&);

}  // namespace corpuscle::circuit
