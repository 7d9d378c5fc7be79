#pragma once
// Common parts of the sweeps of all subjects: plan, columns, recorded outputs, and metadata. The subject of a sweep is what it simulates: a
// model, a netlist afferent, or a netlist with its own analyses.

#include <mutex>

#include "core/afferent.hpp"
#include "sweep/spec/sweep_text.hpp"
#include "sweep/subject/afferent_measures.hpp"
#include "sweep/subject/netlist_factory.hpp"

namespace corpuscle::sweeps {

/// Version of the computation: results with another version come from a program that computes differently.
inline constexpr int results_format = 1;
/// Unless the sweep file sets a limit, an item is truncated after this many times the Newton iterations of the nominal circuit.
inline constexpr double iteration_limit_factor = 20;

/// The part of a Sweep that is the same for all subjects.
class PlannedSweep : public Sweep {
    class PlanReader;           // see plan_reader.cpp
    long iteration_limit_ = 0;  // in the sweep file; 0: the file has none
    double iteration_limit_factor_ = iteration_limit_factor;
    mutable std::mutex mutex_;                             // protects nominal_iteration_limit_
    mutable std::optional<long> nominal_iteration_limit_;  // see find_iteration_limit(); no value: not yet computed

    Result<SweepPlan> read_plan(const SweepText&);
    Result<void> set_limit(const ConfigNode& node, const LocatedText& measure);
    Result<void> set_limits(const ConfigNode& table, const std::string& prefix);

protected:
    SweepPlan plan_;
    NetlistFactory netlist_{};  // of a circuit
    ForceFactory force_;        // of an afferent

    // The steps of prepare(), in this order.
    /// Reads the subject and its force, with the fixed settings of the sweep file.
    virtual Result<void> open(const SweepText&, const std::string& folder) = 0;
    /// The nominal circuit, without varied values; null for a model.
    virtual const circuit::Circuit* circuit() const { return nullptr; }
    virtual const std::string& subject_name() const { return netlist_.name(); }
    virtual Result<VariedQuantity> find_quantity(const LocatedText& quantity) = 0;
    /// Selects the measures of the sweep file, before their limits are set.
    virtual Result<void> select_measures(const SweepText&) = 0;
    /// The index of a measure's column, which is added if necessary.
    virtual Result<std::size_t> measure_column(const LocatedText& measure) = 0;
    /// The value of a measure (index of its column) of a reference model.
    virtual Result<double> model_value(const LocatedText& model, std::size_t column) const = 0;
    /// Selects the spike trains, if they are kept, and the probes that are written to the results.
    virtual Result<void> select_outputs(const SweepText&, bool keeps_spikes) = 0;
    /// The title of a sweep whose file has none.
    virtual std::string title() const { return circuit()->title; }

    /// Newton iterations of the nominal circuit; 0: no limit follows from it. An error of code `interrupted` if `stop` returned true.
    virtual Result<std::int64_t> nominal_iterations(const std::function<bool()>& /*stop*/) const { return 0; }
    /// The iteration limit of an item: from the sweep file, otherwise iteration_limit_factor times the iterations of the nominal circuit.
    /// 0: no limit, because the nominal circuit fails or `stop` returned true.
    long find_iteration_limit(const std::function<bool()>& stop) const;
    /// The outcome of an item without results.
    ItemOutcome failed_outcome(std::int64_t item, std::string reason, ItemEnd end = ItemEnd::diverged) const;
    /// Gives all probes of the results the same number of samples.
    std::vector<std::vector<float>> padded_probes(std::vector<std::vector<float>> samples) const;

public:
    Result<void> prepare(const SweepText&, const std::string& folder);
    std::vector<double> values(std::int64_t item) const override { return plan_.values(item); }

    // For a search, which chooses the values of its items while it runs.
    /// Replaces the items by `count` others, which `point` gives; see SweepPlan::point. An item ends early after `limit_factor` times the
    /// iterations of the nominal circuit, unless the file has a limit.
    void set_points(std::function<SweepPoint(std::int64_t)> point, std::int64_t count, double limit_factor) {
        plan_.point = std::move(point), item_count = count, iteration_limit_factor_ = limit_factor;
    }
    const SweepPlan& plan() const { return plan_; }
    const NetlistFactory& netlist() const { return netlist_; }  ///< of a circuit
    /// The nominal circuit; null for a model.
    const circuit::Circuit* nominal_circuit() const { return circuit(); }
    /// The nominal force; null for a netlist with its own analyses.
    virtual const SweepForce* nominal_force() const { return nullptr; }
    /// The index of a measure's column, which is added if necessary. Call before the first item runs.
    Result<std::size_t> add_measure(const LocatedText& measure) { return measure_column(measure); }
};

/// The common part of the sweeps over an afferent, which responds to a force.
class AfferentSweep : public PlannedSweep {
public:
    const SweepForce* nominal_force() const final { return force_.nominal().get(); }

protected:
    std::unique_ptr<AfferentMeasures> afferent_measures_;
    std::size_t every_ = 0;  // sampling step of the probes, in samples of the force; 0: no probes

    /// Reads the force, and refuses keys that do not apply to afferents.
    Result<void> open_force(const SweepText&, const std::string& folder);
    Result<VariedQuantity> find_quantity(const LocatedText& quantity) final;
    /// The same for quantities of the afferent.
    virtual Result<VariedQuantity> find_afferent_quantity(const LocatedText& quantity) = 0;
    virtual std::vector<std::string> range_names() const { return {}; }  ///< of the operating ranges of a circuit
    Result<void> select_measures(const SweepText&) override;
    Result<std::size_t> measure_column(const LocatedText& measure) final;
    Result<double> model_value(const LocatedText& model, std::size_t column) const final;
    Result<void> select_outputs(const SweepText&, bool keeps_spikes) final;
    /// Finds the probe of this name, as one more of those that are written to the results.
    virtual Result<void> add_probe(const LocatedText& probe) = 0;
};

/// A sweep over a model afferent, a netlist afferent, or a netlist with its analyses, before prepare().
std::unique_ptr<PlannedSweep> new_model_sweep();
std::unique_ptr<PlannedSweep> new_chip_sweep();
std::unique_ptr<PlannedSweep> new_analysis_sweep();

/// The sweep of a sweep file. `folder`: the folder of the file.
Result<std::unique_ptr<Sweep>> make_sweep(const SweepText&, const std::string& folder);
Result<std::unique_ptr<PlannedSweep>> make_planned_sweep(const SweepText&, const std::string& folder);

/// The seed in the sweep file; 0 if it has none.
Result<std::uint64_t> seed_of(const SweepText&);

/// The response of one afferent to a complete force.
struct SimulatedResponse {
    std::vector<double> spikes;                     ///< times since the first sample of the force, s
    std::vector<std::vector<float>> probe_samples;  ///< [index in `probes`][sample]
};

/// `probes`: indexes of the probes to record, at samples 0, `every`, 2 * `every` ... of the force. If `stop` returns true: error
/// `interrupted`.
Result<SimulatedResponse> simulate_afferent(const Afferent&, const SweepForce&, std::span<const std::size_t> probes = {},
                                            std::size_t every = 0, const std::function<bool()>& stop = {});

}  // namespace corpuscle::sweeps
