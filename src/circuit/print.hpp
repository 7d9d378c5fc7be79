#pragma once
// .print: columns for people.

#include <string>
#include <vector>

#include "circuit/curves.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// The .print lines of an analysis of this word, over a plot that is whole; "" if there are none.
std::string printed(const Circuit&, std::string_view word, const Plot&);

/// The .print lines of a .tran: at START and every STEP from there on, on straight lines between its points; nothing before the first of
/// them. (ngspice's batch mode prints every point, and these with `.options interp`.)
class PrintedSteps {
    struct Table {
        const Command* command;
        std::vector<CurveView> views;
        std::string text;
    };
    const Circuit& circuit_;
    double start_, step_, stop_;
    std::vector<Table> tables_;
    std::vector<double> before_;  // the point before
    double rows_ = 0;             // so far

    void print(std::span<const double> row, double at);
    bool due(double t) const { return start_ + rows_ * step_ <= t; }

public:
    PrintedSteps(const Circuit& circuit, double start, double step, double stop)
        : circuit_(circuit), start_(start), step_(step), stop_(stop) {}
    Result<void> begin(const Plot& head);
    void point(std::span<const double> row);
    std::string end();
};

}  // namespace corpuscle::circuit
