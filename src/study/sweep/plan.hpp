#pragma once
// What each unit of a sweep is given. The points are all combinations of what is listed, the first axis slowest; at each point as many
// units as there are draws: unit = point * draws + draw. The same draw is the same chip at every point.

#include <optional>

#include "circuit/variants.hpp"
#include "study/sweep/sampling.hpp"
#include "study/sweep/sweep.hpp"

namespace corpuscle::sweeps {

/// One thing that varies and has a value.
struct SweepAxis {
    SweepColumn column;
    std::vector<double> values = {};          ///< one after another; of words their numbers; empty: it is drawn
    std::optional<UnitNumbers> numbers = {};  ///< of one that is drawn
    bool normal = false, by_powers = false;
    double first = 0, second = 0;            ///< normal: mean and deviation; else from and to
    double least_share = 0, most_share = 1;  ///< of a normal one: what is left of it

    double drawn(std::uint64_t draw) const;
};

class SweepPlan {
    std::vector<SweepAxis> axes_;
    std::vector<SweepColumn> columns_;
    circuit::Chips chips_;
    std::int64_t draws_ = 1, points_ = 1;

public:
    static constexpr double most_units = 1e12;

    SweepPlan() = default;
    /// `chips`: whether process and mismatch are drawn, and their seed.
    SweepPlan(std::vector<SweepAxis> axes, const circuit::Chips& chips, std::int64_t draws);

    const std::vector<SweepAxis>& axes() const { return axes_; }
    /// Of each axis; then, if the process is drawn, its four deviates.
    const std::vector<SweepColumn>& columns() const { return columns_; }
    const circuit::Chips& chips() const { return chips_; }
    std::int64_t draws() const { return draws_; }
    std::int64_t units() const { return points_ * draws_; }
    bool draws_chips() const { return chips_.process || chips_.mismatch; }

    /// In the order of the columns.
    std::vector<double> values(std::int64_t unit) const;
    std::optional<circuit::Draw> draw(std::int64_t unit) const;
};

}  // namespace corpuscle::sweeps
