#pragma once
// .print: tables of numbers as text.

#include <string>
#include <vector>

#include "circuit/curve_view.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// The tables of all .print lines for the analysis of this name, over a complete plot; "" if there are none.
std::string print_tables(const Circuit&, std::string_view analysis, const Plot&);

/// The .print lines of a .tran. Rows are at START and every STEP after it, linearly interpolated between time points; none is before the
/// first time point. (ngspice's batch mode prints every time point, and these rows with `.options interp`.)
class TransientPrinter {
    struct Table {
        const Directive* command;
        std::vector<CurveView> views;
        std::string text;
    };
    const Circuit& circuit_;
    double start_, step_, stop_;
    std::vector<Table> tables_;
    std::vector<double> previous_;  // the point before this one
    double rows_ = 0;               // printed or skipped so far

    void print(std::span<const double> row, double t);
    bool is_row_due(double t) const { return start_ + rows_ * step_ <= t; }

public:
    TransientPrinter(const Circuit& circuit, double start, double step, double stop)
        : circuit_(circuit), start_(start), step_(step), stop_(stop) {}
    Result<void> begin(const Plot& head);
    void add_point(std::span<const double> row);
    std::string end();
};

}  // namespace corpuscle::circuit
