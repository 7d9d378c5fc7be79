#pragma once
// What is measured of an afferent's unit, by name: every measure of spikes over the whole and over each phase, and what a chip costs.

#include <span>

#include "study/sweep/force.hpp"

namespace corpuscle::sweeps {

/// What is known of a unit that has answered.
struct UnitAnswer {
    std::span<const double> spikes;                   ///< s
    double power = 0, sensor_power = 0, outside = 0;  ///< of a circuit: W, W, s
    std::vector<double> outside_of = {};              ///< of each of its ranges, s
    double iterations = 0;
};

class AfferentMeasures {
    enum class Of { whole, phase, first, last, power, sensor_power, outside, one_range, iterations };
    struct One {
        Of of;
        std::size_t number = 0;  ///< of the measure, or of the range
        std::string phase = {};
        SweepColumn column;
        bool usual = false;  ///< told if nobody says what is wanted
    };
    std::vector<One> all_, known_;
    std::vector<SweepColumn> columns_;

public:
    /// All that this force and this afferent have; `ranges` are what a circuit keeps within, none of equations.
    AfferentMeasures(const FeltForce& nominal, bool circuit, std::span<const std::string> ranges);

    /// Those that are asked for; nothing asked: each over the whole.
    Result<void> choose(const std::optional<std::vector<Said>>& names);
    /// The place among the columns of one, which is taken on if nobody asked for it.
    Result<std::size_t> column_of(const Said& name);
    std::vector<SweepColumn>& columns() { return columns_; }
    const std::vector<SweepColumn>& columns() const { return columns_; }

    std::vector<double> values(const FeltForce&, const UnitAnswer&) const;
};

}  // namespace corpuscle::sweeps
