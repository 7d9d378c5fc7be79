#pragma once
// The input of the analyses (equations, tolerances) and their results.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "circuit/point_sink.hpp"
#include "circuit/solve/operating_point.hpp"

namespace corpuscle::circuit {

/// The result of an analysis.
struct AnalysisResult {
    std::vector<Plot> plots;
    std::vector<std::pair<std::string, double>> numbers;  ///< printed as "name = value"
    std::vector<std::pair<std::string, double>> stats;    ///< counters: steps, iterations ...
    std::string table;                                    ///< a printed table
    std::vector<Error> warnings;
    std::optional<std::vector<double>> spikes;  ///< s, if the netlist has .spike
};

/// A circuit with everything that its analyses need. apply_variation() turns it into another chip.
class AnalysisContext {
    std::optional<OperatingPoint> operating_point_;
    std::vector<double> nominal_x_, nominal_initial_x_;  // nominal operating points, without and with .ic: the start of each chip's search
    std::optional<ChipSample> chip_sample_;

    AnalysisContext(std::shared_ptr<const Circuit>, System, const Tolerances&);
    void solve_nominal();

public:
    std::shared_ptr<const Circuit> circuit;
    System system;
    Tolerances tolerances;
    NewtonSolver newton;
    std::function<bool(double fraction)>
        should_stop{};                 ///< called repeatedly with the completed fraction; returns true to stop the analysis
    PointSink* points = nullptr;       ///< receives the points of a transient; null: they are kept in the result
    long max_iterations = 0;           ///< limit for a transient; 0: no limit
    bool hit_iteration_limit = false;  ///< the last transient was stopped by this limit
    bool output_directives_checked = false;     ///< .print, .plot and .meas were checked against the circuit
    bool is_brief = false;             ///< one of many analyses: no printed tables, no warnings

    static Result<std::unique_ptr<AnalysisContext>> make(std::shared_ptr<const Circuit>);
    AnalysisContext(const AnalysisContext&) = delete;

    bool is_stopped(double fraction) const { return should_stop && should_stop(fraction); }
    /// The operating point; computed once for each chip.
    Result<OperatingPoint> operating_point();
    /// The operating point with the present source values and the nodes of .ic clamped; computed at each call.
    Result<OperatingPoint> initial_operating_point();
    NodeClamps initial_clamps() const;  ///< clamps of .ic; empty if there is no .ic
    void apply_variation(const ChipSample&);
    const std::optional<ChipSample>& chip_sample() const { return chip_sample_; }
};

Error interrupted_error();

/// An error with the location of a word of a command.
Error error_at(const Directive&, std::size_t word, std::string message);

/// Reads a number, with SPICE suffixes, from a word of a command. Errors contain the command, `what` (the meaning of the number) and the
/// word's location.
Result<double> read_number(const Directive&, std::size_t word, std::string_view what);

/// Reads frequencies (Hz) as "dec 10 1 1k", "oct ..." or "lin ...", starting at the given word.
Result<std::vector<double>> read_frequencies(const Directive&, std::size_t word);

/// An output variable v(a), v(a,b) or i(x): the difference of two unknowns. The index -1 stands for the value 0.
struct OutputVariable {
    int plus = -1, minus = -1;
    std::complex<double> value(std::span<const std::complex<double>> x) const;
    double value(std::span<const double> x) const;
};
Result<OutputVariable> read_output_variable(const System&, const Directive&, std::size_t word);

/// Index of the system's unknowns by name. The system must outlive it.
class UnknownNames {
    const System& system_;
    std::unordered_map<std::string_view, int> at_;

public:
    explicit UnknownNames(const System&);
    int index_of(std::string_view name) const;  ///< -1: none
    const std::vector<std::string>& all() const { return system_.names(); }
};
Result<OutputVariable> read_output_variable(const UnknownNames&, const Directive&, std::size_t word);

/// A plot with an empty curve for the swept quantity, then one for each unknown.
Plot make_plot(const System&, std::string name, std::string swept, std::string type);
/// Appends a point to such a plot.
void append(Plot&, std::complex<double> swept, std::span<const double> x);
void append(Plot&, std::complex<double> swept, std::span<const std::complex<double>> x);

/// G + j omega C, by entry of the sparsity pattern. omega: rad/s.
std::vector<std::complex<double>> admittances(const SystemEvaluation&, std::size_t entries, double omega);

/// Evaluates all devices at an operating point.
SystemEvaluation evaluate_operating_point(const AnalysisContext&, std::span<const double> x);

}  // namespace corpuscle::circuit
