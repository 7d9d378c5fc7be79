#pragma once
// What analyses work on: a circuit's equations, its tolerances, and what they leave behind.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "circuit/points.hpp"
#include "circuit/solve/operating_point.hpp"

namespace corpuscle::circuit {

/// What an analysis found.
struct Findings {
    std::vector<Plot> plots;
    std::vector<std::pair<std::string, double>> numbers;  ///< printed as "name = value"
    std::vector<std::pair<std::string, double>> work;     ///< what it took: steps, iterations ...
    std::string table;                                    ///< for people
    std::vector<Error> remarks;
    std::optional<std::vector<double>> spikes;  ///< s, where the netlist has .spike
};

/// A circuit ready for its analyses; one chip of it after another, if it is drawn.
class TestBench {
    std::optional<OperatingPoint> rest_;
    std::vector<double> designed_, begun_;  // where the circuit rests as designed, and with .ic held: each chip's search begins there
    std::optional<Draw> drawn_;

    TestBench(std::shared_ptr<const Circuit>, System, const Tolerances&);
    void prepare();

public:
    std::shared_ptr<const Circuit> circuit;
    System system;
    Tolerances tolerances;
    Newton newton;
    std::function<bool(double share)> stop{};  ///< asked now and then, told how far the work is; true: stop
    PointSink* points = nullptr;               ///< takes what is too long to be kept; null: it is kept
    long most_iterations = 0;                  ///< of a transient: one that takes more is stopped; 0: as many as it takes
    bool capped = false;                       ///< the last one was
    bool requests_checked = false;             ///< .print, .plot and .meas were checked against the circuit
    bool brief = false;                        ///< one of many: tables for people and warnings are not wanted

    static Result<std::unique_ptr<TestBench>> make(std::shared_ptr<const Circuit>);
    TestBench(const TestBench&) = delete;

    bool stopped(double share) const { return stop && stop(share); }
    /// Where the circuit rests; searched for once.
    Result<OperatingPoint> rest();
    /// As its sources stand now, with the nodes of .ic held; not kept.
    Result<OperatingPoint> rest_held();
    Springs held() const;  ///< by .ic; none if there is no .ic
    void draw(const Draw&);
    const std::optional<Draw>& drawn() const { return drawn_; }
};

Error interruption();

/// An error at one of a command's words.
Error error_at(const Command&, std::size_t word, std::string sentence);

/// A number among a command's words, SPICE's suffixes and all; names the command, the word and its place if it is none.
Result<double> number_of(const Command&, std::size_t word, std::string_view what);

/// Frequencies of "dec 10 1 1k", "oct ...", "lin ...", from the given word on.
Result<std::vector<double>> frequencies_of(const Command&, std::size_t word);

/// v(a), v(a,b) or i(x) as unknowns: their difference is meant. -1: nothing.
struct Wanted {
    int plus = -1, minus = -1;
    std::complex<double> of(std::span<const std::complex<double>> x) const;
    double of(std::span<const double> x) const;
};
Result<Wanted> wanted_of(const System&, const Command&, std::size_t word);

/// The system's unknowns by name, for many look-ups. The system must outlive it.
class UnknownNames {
    const System& system_;
    std::unordered_map<std::string_view, int> at_;

public:
    explicit UnknownNames(const System&);
    int index_of(std::string_view name) const;  ///< -1: none
    const std::vector<std::string>& all() const { return system_.names(); }
};
Result<Wanted> wanted_of(const UnknownNames&, const Command&, std::size_t word);

/// Curves for all unknowns, empty, after the one that is swept.
Plot plot_of(const System&, std::string name, std::string swept, std::string type);
void append(Plot&, std::complex<double> swept, std::span<const double> x);
void append(Plot&, std::complex<double> swept, std::span<const std::complex<double>> x);

/// G + j w C of a system at its operating point, in the pattern's places.
std::vector<std::complex<double>> admittances(const Sums&, std::size_t entries, double omega);

/// All sums at an operating point.
Sums sums_at(const TestBench&, std::span<const double> x);

}  // namespace corpuscle::circuit
