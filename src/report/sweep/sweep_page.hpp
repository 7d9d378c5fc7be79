#pragma once
// The report page of a sweep, and its plots, reduced to as many numbers as a screen can show. Plots and tables show a limited number of
// items, so the size of the page does not grow with the number of work items.

#include <nlohmann/json.hpp>

#include "sweep/stats/sweep_summary.hpp"

namespace corpuscle {

using PlotJson = nlohmann::ordered_json;

/// A way to divide the rows of the sweep's table into groups, which the plots colour: all together, or by the values of one axis.
struct Grouping {
    std::string name;
    SweepGroups row_groups;
};
inline constexpr std::size_t max_groups = 16;  ///< groups in a grouping; axes with more values are not used
/// All together, then the groupings by axes with 2 to max_groups values; at most 12 groupings.
std::vector<Grouping> groupings_of(const SweepTable&);

/// At most `max_rows` evenly spaced indices below `rows`, including the first and the last.
std::vector<std::size_t> thinned_rows(std::size_t rows, std::size_t max_rows);

/// Histograms of a measure for each group, in common bins; null if no value is finite. `values`: one for each row. Integers have bins of
/// integer width; otherwise there are 60 bins. Outliers are counted in the outer bins; "below" and "above" are their numbers.
PlotJson histograms(const std::vector<double>& values, const SweepGroups&);
/// A normal probability plot for each group, with at most 200 points: values in ascending order, the standard normal scores of their ranks,
/// and the correlation of both. `values`: one for each row.
PlotJson normal_plots(const std::vector<double>& values, const SweepGroups&);

/// Minimum, 5 % quantile, median, 95 % quantile and maximum of probe number `probe` (from 0) over these rows at each time, and the median
/// of each group of each grouping. "every": true if only some of the probe's times are shown.
Result<PlotJson> envelopes(const SweepResults&, std::size_t probe, const SweepTable&, const std::vector<std::size_t>& rows,
                           const std::vector<Grouping>&);

/// The spike times (s) of spike train number `train` (from 0) in these rows. Omits the last rows if there are too many spikes.
Result<PlotJson> rasters(const SweepResults&, std::size_t train, const SweepTable&, const std::vector<std::size_t>& rows);

/// The values in single precision, enough for a plot.
PlotJson plot_numbers(const std::vector<double>&);

/// The page as self-contained HTML.
Result<std::string> sweep_page(const SweepResults&, const SweepTable&, const SweepSummary&, const std::string& title,
                               const std::string& command);

}  // namespace corpuscle
