#pragma once
// The measures of one afferent by name: every spike measure over the complete force and over each phase, and a chip's power and solver
// work.

#include <span>

#include "study/sweep/sweep_force.hpp"

namespace corpuscle::sweeps {

/// The result of one simulated item.
struct ItemResponse {
    std::span<const double> spikes;                        ///< s
    double power = 0, sensor_power = 0, time_outside = 0;  ///< of a circuit: W, W, s; time_outside: largest of time_outside_ranges
    std::vector<double> time_outside_ranges = {};          ///< total time outside each of its ranges, s
    double iterations = 0;                                 ///< of a circuit: Newton iterations
};

class AfferentMeasures {
    enum class Kind { total, phase, first, last, power, sensor_power, outside, one_range, iterations };
    struct Entry {
        Kind kind;
        std::size_t index = 0;  ///< index of the measure or of the range
        std::string phase = {};
        SweepColumn column;
        bool is_default = false;  ///< included by default
    };
    std::vector<Entry> selected_, available_;
    std::vector<SweepColumn> columns_;

public:
    /// All measures for this force and this afferent. `ranges`: the operating ranges of a circuit; empty for a model.
    AfferentMeasures(const SweepForce& nominal, bool is_circuit, std::span<const std::string> ranges);

    /// Selects measures by name. Default: each measure over the complete force.
    Result<void> select(const std::optional<std::vector<LocatedText>>& names);
    /// The index of a measure's column; the column is added if it was not selected.
    Result<std::size_t> require_column(const LocatedText& name);
    std::vector<SweepColumn>& columns() { return columns_; }
    const std::vector<SweepColumn>& columns() const { return columns_; }

    std::vector<double> values(const SweepForce&, const ItemResponse&) const;
};

}  // namespace corpuscle::sweeps
