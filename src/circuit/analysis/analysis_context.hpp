#pragma once
// The input of the analyses (equations, tolerances) and their results.

#include "circuit/output/point_sink.hpp"
#include "circuit/solve/operating_point.hpp"

namespace corpuscle::circuit {

/// The result of an analysis.
struct AnalysisResult {
    std::vector<Plot> plots = {};
    std::vector<std::pair<std::string, double>> numbers = {};  ///< names and values, printed as "name = value"
    std::vector<std::pair<std::string, double>> stats = {};    ///< counters: steps, iterations ...
    std::string table = {};                                    ///< text to print, such as the table of .op
    std::vector<Error> warnings = {};
    /// By point of the first plot, the states of the devices with states; empty: those at the end hold for all points.
    std::vector<std::vector<char>> states = {};
    /// Results of .pz, rad/s; nothing if they were not requested.
    std::optional<std::vector<std::complex<double>>> poles = {}, zeros = {};
    std::optional<std::vector<double>> spikes = {};  ///< spike times of .tran, s; nothing if the netlist has no .spike
};

/// A circuit with everything that its analyses need. apply_variation() turns it into another chip.
class AnalysisContext {
    std::optional<OperatingPoint> operating_point_;
    // Operating points of the nominal circuit, without and with .ic, from which the operating points of chips are searched. Empty: not
    // known.
    std::vector<double> nominal_x_, nominal_initial_x_;
    std::optional<ChipSample> chip_sample_;

    AnalysisContext(std::shared_ptr<const Circuit>, System, const Tolerances&);
    void solve_nominal();

public:
    std::shared_ptr<const Circuit> circuit;
    System system;
    Tolerances tolerances;
    NewtonSolver newton;
    /// Called repeatedly with the completed fraction of the analysis. Must return true to stop it.
    std::function<bool(double fraction)> should_stop{};
    PointSink* points = nullptr;             ///< receives the points of a transient; null: they are kept in the result
    long max_iterations = 0;                 ///< maximum number of Newton iterations of a transient; 0: no limit
    bool hit_iteration_limit = false;        ///< true if max_iterations has stopped the last transient
    bool output_directives_checked = false;  ///< true if .print, .plot and .meas were checked against the circuit
    bool is_brief = false;                   ///< true for one of many analyses: no printed tables, no warnings

    static Result<std::unique_ptr<AnalysisContext>> make(std::shared_ptr<const Circuit>);
    AnalysisContext(const AnalysisContext&) = delete;

    bool is_stopped(double fraction) const { return should_stop && should_stop(fraction); }
    /// The operating point without .ic. It is computed once for each chip.
    Result<OperatingPoint> operating_point();
    /// The operating point with the nodes of .ic clamped. It is computed at each call, with the source values of that time.
    Result<OperatingPoint> initial_operating_point();
    NodeClamps initial_clamps() const;  ///< clamps of .ic; empty if there is no .ic
    void apply_variation(const ChipSample&);
    /// Nothing for the nominal circuit.
    const std::optional<ChipSample>& chip_sample() const { return chip_sample_; }
};

/// The quality factor of a root s = -w0 / (2 Q) +- j ...: |s| / (2 |real part|); infinite on the imaginary axis.
inline double quality_of(std::complex<double> s) { return std::abs(s) / (2 * std::abs(s.real())); }

/// Reads a number, with SPICE suffixes, from a word of a directive. Words are counted from 0, without the directive's name. Errors contain
/// the directive, `what` (the meaning of the number) and the word's location.
Result<double> read_number(const Directive&, std::size_t word, std::string_view what);

/// Reads frequencies (Hz) as "dec 10 1 1k", "oct ..." or "lin ...", starting at the given word.
Result<std::vector<double>> read_frequencies(const Directive&, std::size_t word);

/// An output variable v(a), v(a,b) or i(x): the difference of the unknowns `plus` and `minus`. The index -1 stands for the value 0.
struct OutputVariable {
    int plus = -1, minus = -1;
    double value(std::span<const double> x) const { return value_of(x, plus) - value_of(x, minus); }
};
Result<OutputVariable> read_output_variable(const System&, const Directive&, std::size_t word);

/// A plot with an empty curve for the swept quantity of this name and type, then one for each unknown. If `swept` is empty, there is no
/// first curve.
Plot make_plot(const System&, std::string name, std::string swept, std::string type);
/// Appends a point to such a plot with a swept quantity.
template <class Values>
void append(Plot& plot, double swept, const Values& x) {
    plot.curves[0].values.emplace_back(swept);
    for (std::size_t n = 0; n + 1 < plot.curves.size(); ++n) plot.curves[n + 1].values.emplace_back(x[n]);
}

/// Evaluates all devices at an operating point.
SystemEvaluation evaluate_operating_point(const AnalysisContext&, std::span<const double> x);

/// Calls use(f, solver) for each frequency f, Hz. The solver has factored G + 2 pi j f C of the evaluation. Errors: a singular matrix, an
/// interruption.
using FrequencyCallback = std::function<void(double f, const LinearSolver<std::complex<double>>&)>;
Result<void> for_each_frequency(const AnalysisContext&, const Directive&, const SystemEvaluation&, std::span<const double> frequencies,
                                const FrequencyCallback& use);

/// The independent source that a word of a directive names.
Result<const Device*> read_independent_source(const System&, const Directive&, std::size_t word);

struct Analysis {
    std::string_view name, usage, description;  ///< name of its directive, without the dot; its syntax; a sentence for help texts
    Result<AnalysisResult> (*run)(AnalysisContext&, const Directive&);
    /// The curves that it will produce, without values. The directive may have errors.
    Plot (*expected_plot)(const System&, const Directive&);
    std::span<const std::string_view> numbers = {};  ///< the names of numbers that it may produce
    bool has_number_for_each_curve = false;          ///< true: each curve without a sweep is such a number, too
    std::size_t plot_count = 1;                      ///< number of plots that it produces
    /// The position, from 1, at which ngspice runs it among all analyses of a netlist. 0: ngspice has no such directive.
    int ngspice_order = 0;
};

}  // namespace corpuscle::circuit
