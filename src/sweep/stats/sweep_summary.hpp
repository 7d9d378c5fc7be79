#pragma once
// Summary of a sweep's results: yield and distribution of each measure, at each point and over all points, and what the measures depend on.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "sweep/spec/mismatch_samples.hpp"
#include "sweep/stats/sensitivity.hpp"
#include "sweep/stats/sweep_table.hpp"

namespace corpuscle {

struct SweepSummaryOptions {
    /// Names of the axes by whose values the rows are grouped, see group_rows().
    std::vector<std::string> axes;
    std::vector<double> quantiles = {0.05, 0.25, 0.5, 0.75, 0.95};  ///< probabilities of the quantiles to estimate
};

/// The rows of a table at one combination of values or bands of the axes.
struct SweepGroup {
    std::string label;              ///< "temp = 85 C, corner = ss"
    std::vector<std::size_t> rows;  ///< indexes
};
/// Groups of a table's rows, by the values of each axis that has few distinct values (SweepTable::points), and by bands of each other axis.
struct SweepGroups {
    static constexpr std::size_t max_groups = 64;  ///< that group_rows() makes if it chooses the axes
    static constexpr std::size_t bands = 5;        ///< of one axis, with about equal numbers of rows
    std::vector<std::size_t> axes;                 ///< indexes of the axes that define the groups
    std::vector<SweepGroup> groups;
    std::vector<std::size_t> group_of;  ///< for each row: index of its group
};
/// Groups the rows by the axes of these names. Without names: by all axes with two or more values in SweepTable::points; if that
/// gives more than max_groups groups, all rows are one group.
Result<SweepGroups> group_rows(const SweepTable&, const std::vector<std::string>& by);
/// Groups the rows by the axes with these indexes.
SweepGroups group_rows_by_axes(const SweepTable&, const std::vector<std::size_t>& axes);

/// The effect of one axis on a measure: the mean of the measure at each value of the axis, over all values of the other axes.
struct AxisEffect {
    std::size_t axis = 0;       ///< index in the table's axes
    double fraction = 0;        ///< fraction of the measure's variance over the grid that lies between these means
    std::vector<double> means;  ///< one for each value in SweepTable::points[axis]; NaN: no item with this value has the measure
};

/// Effects of all axes with at least two values, the largest fraction first; empty if the measure does not vary. `measure`: its value in
/// each row of the table.
std::vector<AxisEffect> axis_effects(const SweepTable&, const std::vector<double>& measure);

/// Means of the measure at each pair of values of the axes with indexes a and b: [index of a's value][index of b's value].
std::vector<std::vector<double>> means_over(const SweepTable&, const std::vector<double>& measure, std::size_t a, std::size_t b);

/// The values of all axes in one row of the table, such as "press.F_max = 2 N, sa1.f_B = 20 Hz".
std::string point_label(const SweepTable&, std::size_t row);

/// One measure over the items of a point.
struct MeasureSummary {
    std::int64_t count = 0, missing = 0;  ///< number of items with a value of the measure, and without
    double min = Estimate::none, max = Estimate::none;
    Estimate mean, sigma;
    std::vector<Estimate> quantiles;                                      ///< for each of SweepSummaryOptions::quantiles
    double normality = Estimate::none, normality_floor = Estimate::none;  ///< see SortedSample
    std::optional<Estimate> yield;  ///< fraction of the point's items that end normally and meet this measure's limits; no value: no limits
};
/// The items of one point, which is one SweepGroup, or of all points.
struct PointSummary {
    std::string label;
    std::int64_t items = 0, done = 0, iteration_limit = 0, diverged = 0;  ///< number of items: all, then by how they ended (ItemEnd)
    std::int64_t passed = 0;                                              ///< number of items that ended normally and meet all limits
    Estimate yield;                                                       ///< passed / items
    std::vector<MeasureSummary> measures;                                 ///< for each measure of the table
};

/// A random factor that a measure depends on: a sampled axis, or the mismatch of V_T or I_S (the threshold or the specific current) of a
/// device.
struct NamedInfluence {
    std::string name;             ///< name of a device or an axis
    std::string quantity;         ///< of a device: "V_T", "I_S", or for the yield also their squares, "V_T squared"; "" for an axis
    std::ptrdiff_t device = -1;   ///< index in the subject's devices; -1 for an axis
    std::ptrdiff_t subject = -1;  ///< index of the device's subject in MismatchSamples; -1 for an axis
    std::ptrdiff_t axis = -1;     ///< index of the axis; -1 for a device
    Influence influence;
};
/// The contributions of both factors of a device, V_T and I_S, to the variance of a measure.
struct DeviceContribution {
    std::ptrdiff_t subject, device;  ///< indexes as in NamedInfluence
    double V_T = 0, I_S = 0;         ///< fractions of the variance due to each
    double fraction() const { return V_T + I_S; }
};
/// The axes and random factors that one measure depends on.
struct Dependence {
    std::string measure;  ///< its name; or "yield": 1 if an item passes, 0 if it does not
    Sensitivity sensitivity;
    std::vector<NamedInfluence> influences;                   ///< those of `sensitivity`, with names; the strongest first
    std::vector<DeviceContribution> devices;                  ///< those with a fraction above 0, the largest first
    std::vector<std::pair<std::size_t, GroupEffect>> points;  ///< index of each axis whose value has a significant effect, and the effect
    std::vector<AxisEffect> effects;                          ///< only for a full grid, for which the other members are empty
};

struct SweepSummary {
    SweepSummaryOptions options;
    std::vector<std::size_t> axes;            ///< indexes of the axes that define the points
    std::vector<PointSummary> points;         ///< one for each group of rows
    PointSummary all;                         ///< over all rows
    std::optional<MismatchSamples> mismatch;  ///< no value: mismatch was not sampled
    std::size_t analysed_chips = 0;           ///< number of chips from which the dependences were computed; 0 for a grid
    std::vector<Dependence> dependences;      ///< for each measure, then for the yield, if any measure has limits
};

/// The dependences are computed from at most this many chips, the first ones; more would hardly change the result.
inline constexpr std::size_t max_analysed_chips = 4000;

/// `options.axes` must be names of axes; otherwise an error. Without `mismatch`, the only random factors are the sampled axes.
Result<SweepSummary> summary_of(const SweepTable&, const std::optional<MismatchSamples>&, const SweepSummaryOptions&);

/// The samples of mismatch that results have; no value if mismatch was not sampled.
Result<std::optional<MismatchSamples>> read_mismatch_samples(const SweepResults&);
/// The title of a sweep, or the name of its results file.
std::string title_of(const SweepResults&);

/// The JSON document of `corpuscle sweep show --json`. `title`: of the sweep.
nlohmann::ordered_json document_of(const SweepTable&, const SweepSummary&, const std::string& title);

}  // namespace corpuscle
