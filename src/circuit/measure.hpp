#pragma once
// .meas: numbers taken from curves, point by point as they come.

#include <memory>

#include "circuit/measure/gauge.hpp"
#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// All .meas of a circuit. Each looks at the first plot of the first analysis of its word.
class Measures {
    struct One {
        const Command* command;
        std::unique_ptr<Gauge> gauge;  // null: its analysis has not come, or it is of no curve
    };
    std::vector<One> all_;
    std::vector<Gauge*> at_work_;

public:
    explicit Measures(const Circuit&);

    /// A plot of an analysis of this word begins. One that is ill-formed, or of a curve that is not there, is an error.
    Result<void> begin(std::string_view word, const Plot& head);
    /// Once every analysis has begun: refuses what finish() would, by names alone. `numbers`: those that analyses may give.
    Result<void> check(const std::vector<std::string>& numbers) const;
    void point(double x, const PlotRow& row) {
        for (auto* gauge : at_work_) gauge->point(x, row);
    }
    /// A plot that is whole.
    Result<void> see(std::string_view word, const Plot&);

    /// In order, once all analyses are done, behind the numbers that these gave. One that found nothing is NaN, with a remark.
    Result<void> finish(std::vector<std::pair<std::string, double>>& numbers, std::vector<Error>& remarks) const;
};

}  // namespace corpuscle::circuit
