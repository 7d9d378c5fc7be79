#pragma once
// What a sweep's results say: yields, distributions and what they depend on, point by point of its grid and over all.

#include <map>
#include <optional>

#include "study/sweep/drawn.hpp"
#include "study/sweep/grid.hpp"
#include "study/sweep/sensitivity.hpp"
#include "study/sweep/sweep_table.hpp"

namespace corpuscle {

struct SweepQuestion {
    std::vector<std::string> by;  ///< axes; none: all that are listed rather than drawn, if that makes few points
    std::vector<double> quantiles = {0.05, 0.25, 0.5, 0.75, 0.95};
};

/// The rows of a table at one point of a grid.
struct SweepGroup {
    std::string label;  ///< "temp = 85 C, corner = ss"
    std::vector<std::size_t> rows;
};
/// How a table's rows fall into groups: by the values of an axis that takes few, by five bands as full as each other of one that takes
/// many.
struct SweepGroups {
    static constexpr std::size_t most = 64, bands = 5;
    std::vector<std::size_t> axes;  ///< by which
    std::vector<SweepGroup> groups;
    std::vector<std::size_t> group_of;  ///< each row
};
Result<SweepGroups> grouped(const SweepTable&, const std::vector<std::string>& by);
/// Of an axis that makes points or is cut into bands.
SweepGroups grouped_by(const SweepTable&, const std::vector<std::size_t>& axes);

struct MeasureSummary {
    std::int64_t count = 0, without = 0;  ///< units that have the measure, and that do not
    double least = Estimate::none, greatest = Estimate::none;
    Estimate mean, sigma;
    std::vector<Estimate> quantiles;
    double normality = Estimate::none, normality_floor = Estimate::none;
    std::optional<Estimate> yield;  ///< of its own limits, of all units
};
struct PointSummary {
    std::string label;
    std::int64_t units = 0, done = 0, capped = 0, lost = 0, passed = 0;
    Estimate yield;  ///< units that ended and keep all limits
    std::vector<MeasureSummary> measures;
};

/// Something drawn that a measure depends on.
struct NamedInfluence {
    std::string name;                          ///< of a device, or of an axis
    std::string part;                          ///< of a device: "V_T" or "I_S"; of the yield also "V_T squared"
    std::ptrdiff_t device = -1, subject = -1;  ///< in Drawn
    std::ptrdiff_t axis = -1;
    Influence found;
};
/// A device with both its parts.
struct DeviceShare {
    std::ptrdiff_t subject, device;
    double V_T = 0, I_S = 0;  ///< shares of the variance
    double share() const { return V_T + I_S; }
};
struct Dependence {
    std::string measure;  ///< "yield": whether a unit passes
    Sensitivity all;
    std::vector<NamedInfluence> influences;               ///< the strongest first
    std::vector<DeviceShare> devices;                     ///< of those that have a share, the largest first
    std::vector<std::pair<std::size_t, Between>> points;  ///< axes that make points, and what lies between them
    std::vector<AxisEffect> effects;                      ///< of a plain grid, in place of all the rest
};

struct SweepSummary {
    SweepQuestion question;
    std::vector<std::size_t> by;  ///< axes
    std::vector<PointSummary> points;
    PointSummary all;
    std::optional<Drawn> drawn;
    std::size_t chips = 0;                ///< that what depends on what was looked for in
    std::vector<Dependence> dependences;  ///< each measure that varies, then the yield, if there are limits
};

/// Chips that the search for what matters takes, the first; more would tell no more.
inline constexpr std::size_t most_chips_searched = 4000;

Result<SweepSummary> summary_of(const SweepTable&, const std::optional<Drawn>&, const SweepQuestion&);

}  // namespace corpuscle
