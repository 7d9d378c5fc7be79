#pragma once
// .print: tables of numbers as text.

#include <string>
#include <vector>

#include "circuit/netlist/netlist.hpp"
#include "circuit/output/curve_view.hpp"

namespace corpuscle::circuit {

/// The tables of all .print lines that apply to the analysis of this name, with a row for each point of its plot; "" if no line applies.
std::string print_tables(const Circuit&, std::string_view analysis, const Plot&);

/// The tables of the .print lines for a .tran. Rows are at START and every STEP after it, linearly interpolated between time points. No row
/// is before the first time point. (ngspice's batch mode prints every time point, and these rows only with `.options interp`.)
class TransientPrinter {
    struct Table {
        std::vector<CurveView> views;  // one for each column
        std::string text;
    };
    const Circuit& circuit_;
    double start_, step_, stop_;    // START, STEP and STOP of .tran, s
    std::vector<Table> tables_;     // one for each .print line
    std::vector<double> previous_;  // the point of the last call of add_point()
    double rows_ = 0;               // number of rows printed or skipped so far

    void print(std::span<const double> row, double t);
    /// True if time t (s) has reached the time of the next row.
    bool is_row_due(double t) const { return start_ + rows_ * step_ <= t; }

public:
    TransientPrinter(const Circuit& circuit, double start, double step, double stop)
        : circuit_(circuit), start_(start), step_(step), stop_(stop) {}
    Result<void> begin(const Plot& head);
    void add_point(std::span<const double> row);
    std::string end();  ///< returns the tables
};

}  // namespace corpuscle::circuit
