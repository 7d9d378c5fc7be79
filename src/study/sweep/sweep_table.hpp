#pragma once
// The numbers of a sweep's results, column by column: what statistics are made of. 8 bytes a unit and column, no more.

#include <string>
#include <vector>

#include "study/sweep/results.hpp"

namespace corpuscle {

struct SweepTable {
    std::int64_t units = 0;  ///< of the whole sweep; there are rows for those that are finished
    std::vector<std::int64_t> unit;
    std::vector<UnitEnd> end;
    std::vector<SweepColumn> axes, measures;
    std::vector<std::vector<double>> axis_values, measure_values;  ///< [column][row]

    /// Of each axis that takes few values, as one that is listed does, its values in rising order: they make points. Else empty.
    std::vector<std::vector<double>> points;
    static constexpr std::size_t most_points = 64, most_levels = 10'000;  ///< of a grid: every axis that takes no more makes points
    bool is_grid = false;                                                 ///< nothing is drawn: see grid.hpp

    std::size_t rows() const { return unit.size(); }
    /// Whether a row ended and keeps a measure's limits; one without the measure does not.
    bool keeps(std::size_t row, std::size_t measure) const;
    bool has_limits(std::size_t measure) const { return measures[measure].at_least || measures[measure].at_most; }
    bool has_limits() const;
    bool makes_points(std::size_t axis) const { return !points[axis].empty(); }
    /// Whether it ended and keeps all limits.
    bool passes(std::size_t row) const;
};

/// All axes and these measures (by name; none: all), and of circuits the iterations that a unit took as one more.
Result<SweepTable> read_table(const SweepResults&, const std::vector<std::string>& measures);

/// Why a unit did not end: for some of them, the first.
struct LostUnit {
    std::int64_t unit;
    std::string why;
};
Result<std::vector<LostUnit>> lost_units(const SweepResults&, std::size_t most);

}  // namespace corpuscle
