#pragma once
// A sweep's results as columns of numbers, the input of the statistics. Uses 8 bytes for each item and column.

#include <string>
#include <vector>

#include "study/sweep/sweep_results.hpp"

namespace corpuscle {

struct SweepTable {
    std::int64_t item_count = 0;  ///< of the complete sweep; only finished items have rows
    std::vector<std::int64_t> items;
    std::vector<ItemEnd> ends;
    std::vector<SweepColumn> axes, measures;
    std::vector<std::vector<double>> axis_values, measure_values;  ///< [column][row]

    /// For each axis with few values, such as a listed one, its values in ascending order, which are its points. Otherwise empty.
    std::vector<std::vector<double>> points;
    /// largest number of values of an axis with points: in a sampled sweep, and in a grid
    static constexpr std::size_t max_points = 64, max_grid_points = 10'000;
    bool is_grid = false;  ///< nothing is sampled, see grid.hpp

    std::size_t rows() const { return items.size(); }
    /// True if a row ended normally and meets a measure's limits; false if there are limits and the item has no value.
    bool meets_limits(std::size_t row, std::size_t measure) const;
    bool has_limits(std::size_t measure) const { return measures[measure].min || measures[measure].max; }
    bool has_limits() const;
    bool has_points(std::size_t axis) const { return !points[axis].empty(); }
    /// True if a row ended normally and meets all limits.
    bool passes(std::size_t row) const;
};

/// All axes and the measures of these names, or all measures if there are no names; for circuits also the iterations of each item.
Result<SweepTable> read_table(const SweepResults&, const std::vector<std::string>& measure_names);

/// Why an item failed; only the first items are listed.
struct FailedItem {
    std::int64_t item;
    std::string reason;
};
Result<std::vector<FailedItem>> failed_items(const SweepResults&, std::size_t limit);

}  // namespace corpuscle
