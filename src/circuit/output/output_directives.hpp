#pragma once
// .print: tables of numbers as text.

#include "circuit/analysis/transient_setup.hpp"
#include "circuit/output/curve_view.hpp"

namespace corpuscle::circuit {

/// One table of a .print line.
struct PrintedTable {
    std::vector<CurveView> views;  ///< one for each column
    std::string text;
};

/// Makes the tables of the .print lines that apply to a plot of one analysis, while its points arrive. For a .tran, rows are at START and
/// every STEP after it, linearly interpolated between time points. No row is before the first time point. (ngspice's batch mode prints
/// every time point, and these rows only with `.options interp`.)
class TablePrinter final : public PointSink {
    const Circuit& circuit_;
    const Directive& analysis_;
    TransientTimes times_;              // step 0: a row for each point, for all analyses but .tran
    std::vector<PrintedTable> tables_;  // one for each .print line
    std::vector<double> previous_;      // the point of the last call of add_point(), of a .tran
    double rows_ = 0;                   // number of rows printed or skipped so far

    double next_time() const { return times_.start + rows_ * times_.step; }
    void print_at_next_time(std::span<const double> row);

public:
    TablePrinter(const Circuit& circuit, const Directive& analysis) : circuit_(circuit), analysis_(analysis) {
        if (analysis_.name != "tran") return;
        if (const auto times = read_transient_times(analysis)) times_ = *times;
    }
    Result<void> begin(const Plot& head) override;
    Result<void> add_point(const PlotRow& row) override;
    Result<void> end() override;
    std::string text() const;  ///< the tables
};

/// Returns an error if a directive names a curve or number that no analysis has, or if a .meas is ill-formed. Appends a warning for each
/// line or word that has no effect here.
Result<void> check_output_directives(const System&, DeviceCurrents, std::vector<Error>& warnings);

}  // namespace corpuscle::circuit
