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
struct Findings {
    std::vector<Plot> plots;
    std::vector<std::pair<std::string, double>> numbers;  ///< printed as "name = value"
    std::vector<std::pair<std::string, double>> work;     ///< counters: steps, iterations ...
    std::string table;                                    ///< a printed table
    std::vector<Error> remarks;
    std::optional<std::vector<double>> spikes;  ///< s, if the netlist has .spike
};

/// A circuit with everything that its analyses need. With apply_variation() it is one chip after another.
class TestBench {
    std::optional<OperatingPoint> rest_;
    std::vector<double> designed_, begun_;  // nominal operating points, without and with .ic: the start of each chip's search
    std::optional<Draw> drawn_;

    TestBench(std::shared_ptr<const Circuit>, System, const Tolerances&);
    void prepare();

public:
    std::shared_ptr<const Circuit> circuit;
    System system;
    Tolerances tolerances;
    Newton newton;
    std::function<bool(double fraction)> stop{};  ///< called repeatedly with the completed fraction; returns true to stop the analysis
    PointSink* points = nullptr;                  ///< receives the points of a transient; null: they are kept in the result
    long most_iterations = 0;                     ///< limit for a transient; 0: no limit
    bool capped = false;                          ///< the last transient was stopped by this limit
    bool requests_checked = false;                ///< .print, .plot and .meas were checked against the circuit
    bool brief = false;                           ///< one of many analyses: no printed tables, no warnings

    static Result<std::unique_ptr<TestBench>> make(std::shared_ptr<const Circuit>);
    TestBench(const TestBench&) = delete;

    bool stopped(double fraction) const { return stop && stop(fraction); }
    /// The operating point; computed once.
    Result<OperatingPoint> rest();
    /// The operating point with the present source values and the nodes of .ic clamped; computed at each call.
    Result<OperatingPoint> rest_held();
    Springs held() const;  ///< clamps of .ic; empty if there is no .ic
    void draw(const Draw&);
    const std::optional<Draw>& drawn() const { return drawn_; }
};

Error interruption();

/// An error with the location of a word of a command.
Error error_at(const Directive&, std::size_t word, std::string message);

/// Reads a number, with SPICE suffixes, from a word of a command. Errors name the command, the word and its location.
Result<double> number_of(const Directive&, std::size_t word, std::string_view what);

/// Reads frequencies (Hz) as "dec 10 1 1k", "oct ..." or "lin ...", starting at the given word.
Result<std::vector<double>> frequencies_of(const Directive&, std::size_t word);

/// An output variable v(a), v(a,b) or i(x): the difference of two unknowns. -1: 0.
struct Wanted {
    int plus = -1, minus = -1;
    std::complex<double> of(std::span<const std::complex<double>> x) const;
    double of(std::span<const double> x) const;
};
Result<Wanted> wanted_of(const System&, const Directive&, std::size_t word);

/// Index of the system's unknowns by name. The system must outlive it.
class UnknownNames {
    const System& system_;
    std::unordered_map<std::string_view, int> at_;

public:
    explicit UnknownNames(const System&);
    int index_of(std::string_view name) const;  ///< -1: none
    const std::vector<std::string>& all() const { return system_.names(); }
};
Result<Wanted> wanted_of(const UnknownNames&, const Directive&, std::size_t word);

/// A plot with an empty curve for the swept quantity, then one for each unknown.
Plot plot_of(const System&, std::string name, std::string swept, std::string type);
void append(Plot&, std::complex<double> swept, std::span<const double> x);
void append(Plot&, std::complex<double> swept, std::span<const std::complex<double>> x);

/// G + j omega C, by entry of the sparsity pattern. omega: rad/s.
std::vector<std::complex<double>> admittances(const Sums&, std::size_t entries, double omega);

/// Evaluates all devices at an operating point.
Sums sums_at(const TestBench&, std::span<const double> x);

}  // namespace corpuscle::circuit
