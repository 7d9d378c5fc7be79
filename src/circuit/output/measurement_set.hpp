#pragma once
// .meas: numbers measured on curves, point by point while an analysis runs.

#include <memory>

#include "circuit/measure/measurement.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// All .meas lines of a circuit. Each line names a kind of analysis (tran, ac ...) and measures the first plot of the first such analysis.
class MeasurementSet {
    struct Entry {
        const Directive* directive;                // the .meas line
        std::unique_ptr<Measurement> measurement;  // null: its analysis has not begun, or the line is a param= expression
    };
    std::vector<Entry> entries_;
    std::vector<Measurement*> active_;  // measurements of the plot that was begun last
    bool has_sweep_ = true;             // of that plot

public:
    explicit MeasurementSet(const Circuit&);

    /// Begins the first plot of an analysis of this kind; `head` has its curves without values. An ill-formed .meas line or an unknown
    /// curve is an error.
    Result<void> begin(std::string_view analysis, const Plot& head);
    /// Call this after begin() for every analysis. Reports the errors of finish() that depend on names only. `number_names` are the names
    /// of the numbers that the analyses may produce.
    Result<void> check(const std::vector<std::string>& number_names) const;
    /// Adds a point of the plot.
    void add_point(const PlotRow& row) {
        for (auto* measurement : active_) measurement->add_point(has_sweep_ ? row[0].real() : 0, row);
    }

    /// Call this after all analyses. `numbers` contains the numbers of the analyses, which param= expressions may use. Appends the results
    /// in the order of the .meas lines. A measurement that found nothing is NaN and adds a warning.
    Result<void> finish(std::vector<std::pair<std::string, double>>& numbers, std::vector<Error>& warnings) const;
};

}  // namespace corpuscle::circuit
