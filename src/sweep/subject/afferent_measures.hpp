#pragma once
// The measures of an item of a sweep, by name: every spike measure over the complete force and over each phase of the force; for a circuit
// also power, time outside operating ranges, and Newton iterations.

#include <map>
#include <span>

#include "circuit/batch/chip_batch.hpp"
#include "sweep/spec/sweep_force.hpp"

namespace corpuscle::sweeps {

/// The measures that are available for the items of a sweep, and those that are selected.
class AfferentMeasures {
    /// The values from which the measures of an item follow.
    struct Values {
        const SweepForce& force;
        std::span<const double> spikes;                        ///< times since the first sample of the force, s
        const circuit::ChipResponse* response;                 ///< of a circuit
        double area;                                           ///< of a circuit, m^2
        std::vector<double> total;                             ///< of each of `measures`, over the complete force
        std::map<std::string, std::vector<double>> of_phases;  ///< the same for each phase, by its name; empty if they are not needed

        /// Total time outside an operating range (.assert) of a circuit, s.
        double time_outside(std::size_t range) const {
            const auto& all = response->range_violations;
            return range < all.size() ? static_cast<double>(all[range].samples) * force.clock.T() : 0;
        }
    };
    struct Entry {
        SweepColumn column;
        double (*value)(const Values&, const Entry&);
        std::size_t index = 0;    ///< in `measures` of measure/measures.hpp, or of the operating range
        std::string phase = {};   ///< its name; "": the measure is not of a phase
        bool is_default = false;  ///< selected if the sweep file selects no measures
    };
    std::vector<Entry> selected_, available_;
    std::vector<SweepColumn> columns_;  // of selected_

public:
    /// Makes all measures available for this force and this afferent. `ranges`: names of the operating ranges of a circuit; empty for a
    /// model.
    AfferentMeasures(const SweepForce& nominal, bool is_circuit, std::span<const std::string> ranges);

    /// Selects measures by a list of names. Null: the measures over the complete force, except `iterations`, the time outside each single
    /// range, and, for a force without cycle, the measures that need one.
    Result<void> select(const ConfigNode* names);
    /// The index of a measure's column; selects the measure if it was not selected.
    Result<std::size_t> require_column(const LocatedText& name);
    const std::vector<SweepColumn>& columns() const { return columns_; }

    /// The values of the selected measures, in the order of columns(); NaN: no value. `spikes`: times since the first sample of the force,
    /// s. `response`, `area` (m^2): of a circuit.
    std::vector<double> values(const SweepForce&, std::span<const double> spikes, const circuit::ChipResponse* response = nullptr,
                               double area = 0) const;
    bool has_area() const;  ///< true if the measure `area` is selected
};

}  // namespace corpuscle::sweeps
