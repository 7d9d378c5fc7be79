#pragma once
// The plots of a sweep page, reduced to as many numbers as a screen can show.

#include <nlohmann/json.hpp>

#include "study/sweep/sweep_results.hpp"
#include "study/sweep/sweep_summary.hpp"

namespace corpuscle {

using PlotJson = nlohmann::ordered_json;

/// A grouping of rows on the page: all together, or by the values of one axis.
struct Grouping {
    std::string name;
    SweepGroups row_groups;
};
inline constexpr std::size_t max_groups = 16;
std::vector<Grouping> groupings_of(const SweepTable&);

/// At most `max_rows` evenly spaced rows, including the first and the last.
std::vector<std::size_t> thinned_rows(std::size_t rows, std::size_t max_rows);

/// Histograms of a measure for each group, in common bins. Integers have bins of integer width; otherwise there are 60 bins, and outliers
/// are counted in the outer bins.
PlotJson histograms(const std::vector<double>& values, const SweepGroups&);
/// Normal probability plots, at most 200 points per group: the score of a normal distribution, and the value.
PlotJson normal_plots(const std::vector<double>& values, const SweepGroups&);

/// Minimum, 5 %, median, 95 % and maximum of a trace over these rows at each time, and the median of each group of each grouping.
Result<PlotJson> envelopes(const SweepResults&, std::size_t trace, const SweepTable&, const std::vector<std::size_t>& rows,
                           const std::vector<Grouping>&);

/// The spikes of a train in these rows. Stops when there are too many spikes.
Result<PlotJson> rasters(const SweepResults&, std::size_t train, const SweepTable&, const std::vector<std::size_t>& rows);

/// Numbers with five digits, enough for a plot.
PlotJson rounded_numbers(const std::vector<double>&);

}  // namespace corpuscle
