#pragma once
// Summary of a sweep's results: yields, distributions and dependences, for each point of its grid and in total.

#include <map>
#include <optional>

#include "study/sweep/grid.hpp"
#include "study/sweep/mismatch_samples.hpp"
#include "study/sweep/sensitivity.hpp"
#include "study/sweep/sweep_table.hpp"

namespace corpuscle {

struct SweepSummaryOptions {
    std::vector<std::string> axes;  ///< axes that define the points; empty: all listed axes, if they have few points
    std::vector<double> quantiles = {0.05, 0.25, 0.5, 0.75, 0.95};
};

/// The rows of a table at one point of a grid.
struct SweepGroup {
    std::string label;  ///< "temp = 85 C, corner = ss"
    std::vector<std::size_t> rows;
};
/// Groups of a table's rows: by the values of an axis with few values, or by five bands of equal size for an axis with many.
struct SweepGroups {
    static constexpr std::size_t max_groups = 64, bands = 5;
    std::vector<std::size_t> axes;  ///< axes that define the groups
    std::vector<SweepGroup> groups;
    std::vector<std::size_t> group_of;  ///< for each row
};
/// Groups the rows by the axes of these names; without names, by all axes with points, if that gives few groups.
Result<SweepGroups> group_rows(const SweepTable&, const std::vector<std::string>& by);
/// Groups the rows by these axes. An axis without points is divided into bands.
SweepGroups group_rows_by_axes(const SweepTable&, const std::vector<std::size_t>& axes);

struct MeasureSummary {
    std::int64_t count = 0, missing = 0;  ///< items that have the measure, and that do not
    double min = Estimate::none, max = Estimate::none;
    Estimate mean, sigma;
    std::vector<Estimate> quantiles;
    double normality = Estimate::none, normality_floor = Estimate::none;
    std::optional<Estimate> yield;  ///< fraction of all items that meet the limits of this measure
};
struct PointSummary {
    std::string label;
    std::int64_t items = 0, done = 0, iteration_limit = 0, diverged = 0, passed = 0;
    Estimate yield;  ///< fraction of items that ended normally and meet all limits
    std::vector<MeasureSummary> measures;
};

/// A sampled factor that a measure depends on.
struct NamedInfluence {
    std::string name;                          ///< name of a device or an axis
    std::string quantity;                      ///< of a device: "V_T" or "I_S"; for the yield also "V_T squared"
    std::ptrdiff_t device = -1, subject = -1;  ///< indexes in the mismatch samples; -1 for an axis
    std::ptrdiff_t axis = -1;                  ///< index of the axis; -1 for a device
    Influence influence;
};
/// The contributions of both factors of a device, V_T and I_S, to the variance of a measure.
struct DeviceContribution {
    std::ptrdiff_t subject, device;
    double V_T = 0, I_S = 0;  ///< fractions of the variance
    double fraction() const { return V_T + I_S; }
};
struct Dependence {
    std::string measure;  ///< "yield": whether an item passes
    Sensitivity sensitivity;
    std::vector<NamedInfluence> influences;                   ///< the strongest first
    std::vector<DeviceContribution> devices;                  ///< those with a fraction of the variance, the largest first
    std::vector<std::pair<std::size_t, GroupEffect>> points;  ///< axes with points, and the effect of each
    std::vector<AxisEffect> effects;                          ///< of a full grid, which has no other dependences
};

struct SweepSummary {
    SweepSummaryOptions options;
    std::vector<std::size_t> axes;  ///< axes that define the points
    std::vector<PointSummary> points;
    PointSummary all;
    std::optional<MismatchSamples> mismatch;
    std::size_t searched_chips = 0;       ///< number of chips in which dependences were searched
    std::vector<Dependence> dependences;  ///< for each measure that varies, then for the yield, if there are limits
};

/// The search for dependences uses at most this many chips, the first ones; more would give the same result.
inline constexpr std::size_t max_searched_chips = 4000;

Result<SweepSummary> summary_of(const SweepTable&, const std::optional<MismatchSamples>&, const SweepSummaryOptions&);

}  // namespace corpuscle
