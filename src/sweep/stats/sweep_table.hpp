#pragma once
// The results of a sweep in memory, as columns of numbers: the input of the statistics. Takes 8 bytes for each row and column.

#include <string>
#include <vector>

#include "sweep/store/sweep_results.hpp"

namespace corpuscle {

/// One row for each finished item, in ascending order of items.
struct SweepTable {
    std::int64_t item_count = 0;      ///< of the complete sweep, with unfinished items
    std::vector<std::int64_t> items;  ///< for each row: index of the item in the sweep
    std::vector<ItemEnd> ends;        ///< for each row
    std::vector<SweepColumn> axes, measures;
    std::vector<std::vector<double>> axis_values, measure_values;  ///< [column][row]; NaN: no value
    std::vector<bool> is_listed;                                   ///< for each axis: its values are listed, not drawn at random

    /// For each axis: its points, which are its distinct values in ascending order, if it has few, as a listed axis does. Otherwise empty.
    std::vector<std::vector<double>> points;
    /// Largest number of points of an axis: in a sampled sweep, and in a grid.
    static constexpr std::size_t max_points = 64, max_grid_points = 10'000;
    bool is_grid = false;  ///< true if the sweep samples nothing: every combination of the listed values once, so that effects need no test

    std::size_t rows() const { return items.size(); }
    /// True if the item of this row ended normally and meets the limits of this measure, if it has limits. NaN does not meet a limit.
    bool meets_limits(std::size_t row, std::size_t measure) const;
    bool has_limits(std::size_t measure) const { return measures[measure].min || measures[measure].max; }
    bool has_limits() const;  ///< of any measure
    bool has_points(std::size_t axis) const { return !points[axis].empty(); }
    /// True if an axis has several listed values, so that all items together are not a random sample.
    bool varies_by_list() const;
    /// True if the item of this row ended normally and meets the limits of all measures.
    bool passes(std::size_t row) const;
};

/// True if the sweep samples neither chips nor values of an axis.
bool is_deterministic(const SweepResults&);

/// Reads all axes and the measures of these names. Without names: all measures, and for circuits also the Newton iterations as a last
/// measure.
Result<SweepTable> read_table(const SweepResults&, const std::vector<std::string>& measure_names);

/// An item that did not end normally.
struct FailedItem {
    std::int64_t item;
    std::string reason;  ///< or "truncated" or "diverged" if the results have no reason
};
/// The first `limit` failed items.
Result<std::vector<FailedItem>> failed_items(const SweepResults&, std::size_t limit);

}  // namespace corpuscle
