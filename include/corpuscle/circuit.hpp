#pragma once
// Circuits: the analyses of a SPICE netlist, and their curves.

#include <complex>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// How a circuit differs from its netlist. Each text is as for `corpuscle run`.
struct CircuitSettings {
    /// "C_u=4pF", "summer.N3B=8x4", "N3B.w=1.2um", "temp=85", "corner=ff", "supply=0.65V", "mismatch=7/41"
    std::vector<std::string> settings = {};
    std::vector<std::string> probes = {};  ///< curves to record in addition to those of the netlist: "v(a,b)", "i(N3B)"
};

/// A curve: a named column of numbers.
struct CircuitColumn {
    std::string name;                                       ///< "v(out)", "i(v1)", "time"
    std::string unit;                                       ///< "V", "A", "s", "Hz", "C" (degrees Celsius); "" if unknown
    std::vector<double> values = {};                        ///< of a real curve
    std::vector<std::complex<double>> complex_values = {};  ///< of a complex curve (.ac), for which `values` is empty

    std::size_t size() const { return values.empty() ? complex_values.size() : values.size(); }
};

/// The curves of one analysis at the same points.
struct CircuitPlot {
    std::string name, analysis;  ///< "Transient Analysis", "tran"
    bool has_sweep = false;      ///< the first column is the swept quantity
    bool is_complex = false;
    std::size_t inner_points = 0;  ///< points of each inner sweep of a .dc with two sources; 0: one sweep
    std::vector<CircuitColumn> columns = {};

    std::size_t points() const { return columns.empty() ? 0 : columns[0].size(); }
    /// The column of this name, ignoring case; null if it is not among `columns`.
    CORPUSCLE_API const CircuitColumn* find(const std::string& name) const;
    /// A column, or a curve that is computed from columns: "v(a,b)", "vdb(out)", "vp(out)" (radians), "v(a)*i(v1)". Throws InputError.
    CORPUSCLE_API CircuitColumn column(const std::string& name) const;
};

/// One analysis that was run.
struct CircuitAnalysis {
    std::string name;                                      ///< "op"
    std::string report;                                    ///< what `corpuscle run` prints: operating points of devices, noise by device
    std::vector<std::pair<std::string, double>> counters;  ///< steps, rejected, iterations
    std::optional<std::vector<double>> spikes;             ///< spike times, s, of a .tran with .spike
};

/// An .expect of the netlist.
struct CircuitExpectation {
    std::string name;
    double actual = 0, expected = 0, tolerance = 0;
    bool is_met = false;
};

/// The results of a run.
struct CircuitResult {
    std::string title;
    std::string step;  ///< of one of several variants (.step, .mc): "r=1000 temp=85"
    std::vector<CircuitPlot> plots = {};
    /// Numbers of analyses ("spikes", "onoise_total"), of .four and of .meas. NaN: nothing was found.
    std::vector<std::pair<std::string, double>> measures = {};
    std::vector<CircuitAnalysis> analyses = {};
    std::vector<CircuitExpectation> expectations = {};
    std::vector<std::string> warnings = {};
    std::string error = {};                 ///< of a step that did not converge: when, where, which device
    std::vector<CircuitResult> steps = {};  ///< all variants of a netlist with .step or .mc; plots, measures and analyses are then empty

    /// A curve of the first plot that has it, see CircuitPlot::column(). Throws InputError.
    CORPUSCLE_API CircuitColumn column(const std::string& name) const;
    /// A measure. Throws InputError if there is none of this name.
    CORPUSCLE_API double measure(const std::string& name) const;
};

/// An analysis of the catalogue.
struct CircuitAnalysisDescription {
    std::string name, usage, description;  ///< "tran", ".tran STEP STOP ...", a sentence
};
CORPUSCLE_API std::vector<CircuitAnalysisDescription> circuit_analyses();

/// A netlist that was read. Analyses may run on several threads at the same time.
class Circuit {
    struct Impl;
    std::shared_ptr<const Impl> impl_;
    explicit Circuit(std::shared_ptr<const Impl>);

public:
    /// Called often with the completed fraction, 0 to 1. If it returns false, the run stops with InterruptedError.
    using Progress = std::function<bool(double)>;

    /// Reads a file, or a netlist of the catalogue ("sa1-circuit"). Throws InputError, with file, line and column.
    CORPUSCLE_API explicit Circuit(const std::string& name_or_path, const CircuitSettings& = {});
    /// Reads the text of a netlist, whose first line is the title. `name`: for messages; included files are relative to its folder.
    CORPUSCLE_API static Circuit from_text(const std::string& text, const CircuitSettings& = {}, const std::string& name = "netlist");

    /// All analyses of the netlist, in order, then its .meas and .expect. Throws InputError, NotConvergedError.
    CORPUSCLE_API CircuitResult run(const Progress& = {}) const;
    /// One analysis: with these words of its directive, or without words as in the netlist. Throws InputError, NotConvergedError.
    CORPUSCLE_API CircuitResult analyse(const std::string& analysis, const std::vector<std::string>& words, const Progress& = {}) const;

    // op(), dc("v1", "0", "1", "10m"), ac("dec", "10", "1", "1meg"), noise("v(out)", "v1", "dec", "10", "1", "1k"), tran("1m", "1"): the
    // words are those of the directive.
    template <std::convertible_to<std::string>... Words>
    CircuitResult op(const Words&... words) const {
        return analyse("op", {words...});
    }
    template <std::convertible_to<std::string>... Words>
    CircuitResult dc(const Words&... words) const {
        return analyse("dc", {words...});
    }
    template <std::convertible_to<std::string>... Words>
    CircuitResult ac(const Words&... words) const {
        return analyse("ac", {words...});
    }
    template <std::convertible_to<std::string>... Words>
    CircuitResult noise(const Words&... words) const {
        return analyse("noise", {words...});
    }
    template <std::convertible_to<std::string>... Words>
    CircuitResult tran(const Words&... words) const {
        return analyse("tran", {words...});
    }

    CORPUSCLE_API const std::string& name() const;            ///< the path or name with which it was made
    CORPUSCLE_API const std::string& title() const;           ///< first line of the netlist
    CORPUSCLE_API std::vector<std::string> nodes() const;     ///< names, without ground
    CORPUSCLE_API std::vector<std::string> elements() const;  ///< names with the path of their subcircuit: "x1.m1"
};

}  // namespace corpuscle
