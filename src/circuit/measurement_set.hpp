#pragma once
// .meas: numbers measured on curves, point by point while an analysis runs.

#include <memory>

#include "circuit/measure/measurement.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// All .meas lines of a circuit. Each line names a kind of analysis, and measures the first plot of the first analysis of this kind.
class MeasurementSet {
    struct Entry {
        const Directive* command;
        std::unique_ptr<Measurement> measurement;  // null: its analysis has not begun, or the line is a param= expression
    };
    std::vector<Entry> entries_;
    std::vector<Measurement*> active_;

public:
    explicit MeasurementSet(const Circuit&);

    /// Begins a plot of the analysis of this name. An ill-formed line or an unknown curve is an error.
    Result<void> begin(std::string_view analysis, const Plot& head);
    /// Call this after begin() for every analysis. Reports the errors of finish() that depend on names only. `numbers` are the names of
    /// the numbers that the analyses may produce.
    Result<void> check(const std::vector<std::string>& numbers) const;
    void add_point(double x, const PlotRow& row) {
        for (auto* measurement : active_) measurement->add_point(x, row);
    }
    /// Measures a complete plot.
    Result<void> add_plot(std::string_view analysis, const Plot&);

    /// Call this after all analyses. Appends the results to `numbers`, in order of the lines. A measurement that found nothing is NaN and
    /// adds a warning.
    Result<void> finish(std::vector<std::pair<std::string, double>>& numbers, std::vector<Error>& warnings) const;
};

}  // namespace corpuscle::circuit
