#pragma once
// What a sweep's page draws, brought to as many numbers as can be seen.

#include <nlohmann/json.hpp>

#include "study/sweep/results.hpp"
#include "study/sweep/sweep_summary.hpp"

namespace corpuscle {

using PlotJson = nlohmann::ordered_json;

/// How rows are told apart on the page: all together, or by one axis.
struct Grouping {
    std::string name;
    SweepGroups by;
};
inline constexpr std::size_t most_groups_drawn = 16;
std::vector<Grouping> groupings_of(const SweepTable&);

/// Evenly from all rows, the first and the last among them.
std::vector<std::size_t> thinned_rows(std::size_t rows, std::size_t most);

/// How often the measure is where, for each group in the same bins: whole numbers by themselves, else 60 bins; what lies far out is counted
/// at the ends.
PlotJson histograms(const std::vector<double>& values, const SweepGroups&);
/// Of each group at most 200 points: what a normal distribution has there, and the value.
PlotJson normal_plots(const std::vector<double>& values, const SweepGroups&);

/// Least, 5 %, median, 95 % and greatest of a trace at each time over these rows; and of each grouping's groups the median.
Result<PlotJson> envelopes(const SweepResults&, std::size_t trace, const SweepTable&, const std::vector<std::size_t>& rows,
                           const std::vector<Grouping>&);

/// The spikes of each of these rows on a train, until they are too many.
Result<PlotJson> rasters(const SweepResults&, std::size_t train, const SweepTable&, const std::vector<std::size_t>& rows);

/// As many digits as a picture shows.
PlotJson shown_numbers(const std::vector<double>&);

}  // namespace corpuscle
