#pragma once
// All .meas lines of a circuit.

#include "circuit/measure/measurement_parser.hpp"

namespace corpuscle::circuit {

/// Measures, for each .meas line, the first plot of the first analysis of its kind. A line of a script belongs to the last such analysis
/// before it.
class MeasurementSet {
    /// The points of the curves that a line names. A line that depends on earlier results is measured when these are known.
    struct Recording {
        Plot head;
        std::vector<std::size_t> columns;  // of the plot
        std::vector<double> real;
        std::vector<std::complex<double>> complex;
        bool is_too_long = false;
        void add(const PlotRow&);
        void send_to(Measurement&) const;
    };
    struct Entry {
        const Directive* directive;                // the .meas line
        Directive line;                            // in its normal form
        std::optional<Error> error;                // of that form
        std::unique_ptr<Measurement> measurement;  // null: not begun, left out, or an expression of results
        std::optional<Recording> recording;
        std::optional<Error> left_out;
        bool has_begun = false;
    };
    const Circuit& circuit_;
    std::vector<Entry> entries_;
    std::vector<Entry*> active_;    // those of the plot that was begun last
    bool has_sweep_ = true;         // of that plot
    std::size_t inner_points_ = 0;  // of that plot
    std::size_t points_ = 0;        // number of points of that plot so far

    MeasureScope scope_before(const Entry&, const std::vector<std::pair<std::string, double>>& numbers) const;
    Result<double> result_of(Entry&, const std::vector<std::pair<std::string, double>>& numbers);

public:
    explicit MeasurementSet(const Circuit&);

    /// Begins the first plot of an analysis; `head` has its curves without values. An ill-formed .meas line or an unknown
    /// curve is an error.
    Result<void> begin(const Directive& analysis, const Plot& head);
    /// Call this after begin() for every analysis. Reports the errors of finish() that depend on names only. `number_names` are the names
    /// of the numbers that the analyses may produce.
    Result<void> check(const std::vector<std::string>& number_names);
    /// Adds a point of the plot.
    void add_point(const PlotRow& row) {
        const bool begins_sweep = inner_points_ > 0 && points_++ % inner_points_ == 0;
        for (auto* entry : active_) {
            if (begins_sweep && entry->measurement) entry->measurement->begin_sweep();
            entry->recording ? entry->recording->add(row) : entry->measurement->add_point(has_sweep_ ? row[0].real() : 0, row);
        }
    }

    /// Call this after all analyses. `numbers` contains the numbers of the analyses, which param= expressions may use. Appends the results
    /// in the order of the .meas lines. A measurement that found nothing is NaN and adds a warning. One that is left out is NaN, too, and
    /// adds its reason to `left_out`.
    Result<void> finish(std::vector<std::pair<std::string, double>>& numbers, std::vector<Error>& warnings, std::vector<Error>& left_out);
};

}  // namespace corpuscle::circuit
