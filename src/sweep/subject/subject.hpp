#pragma once
// Common parts of the sweeps of all subjects: plan, columns, recorded outputs, and metadata. The subject of a sweep is what it simulates: a
// model, a netlist afferent, or a netlist with its own analyses.

#include "core/afferent.hpp"
#include "sweep/spec/sweep_text.hpp"
#include "sweep/subject/afferent_measures.hpp"

namespace corpuscle::sweeps {

/// Version of the computation: results with another version come from a program that computes differently.
inline constexpr int results_format = 1;

/// Unless the sweep file sets a limit, an item is truncated after this many times the Newton iterations of the nominal circuit.
inline constexpr double iteration_limit_factor = 20;

/// The part of a Sweep that is the same for all subjects.
class PlannedSweep : public Sweep {
protected:
    SweepPlan plan_;
    std::vector<SweepColumn> measures_;
    std::vector<std::string> train_names_, probe_names_;
    std::vector<double> probe_times_;
    std::vector<MetadataText> metadata_;

    /// If mismatch is sampled, adds a metadata entry from which the mismatch of each transistor of each chip can be computed again.
    void add_mismatch_metadata(const std::string& subject, const circuit::Circuit&);

public:
    std::int64_t item_count() const override { return plan_.item_count(); }
    const std::vector<SweepColumn>& axes() const override { return plan_.columns(); }
    const std::vector<SweepColumn>& measures() const override { return measures_; }
    const std::vector<std::string>& train_names() const override { return train_names_; }
    const std::vector<std::string>& probe_names() const override { return probe_names_; }
    const std::vector<double>& probe_times() const override { return probe_times_; }
    std::vector<double> values(std::int64_t item) const override { return plan_.values(item); }
    const std::vector<MetadataText>& metadata() const override { return metadata_; }
};

/// Make the sweep of a model afferent, of a netlist afferent, and of a netlist with its analyses. `folder`: the folder of the sweep file.
Result<std::unique_ptr<Sweep>> make_model_sweep(const SweepText&, const std::string& folder);
Result<std::unique_ptr<Sweep>> make_chip_sweep(const SweepText&, const std::string& folder);
Result<std::unique_ptr<Sweep>> make_analysis_sweep(const SweepText&, const std::string& folder);

/// Access to the quantities of a subject that can vary.
struct VariableQuantities {
    std::function<Result<VariedQuantity>(const LocatedText& quantity)> find_quantity;
    /// Tells the subject that this quantity takes its values from the axis with index `axis` in the plan.
    std::function<void(const SweepAxis&, const std::string& quantity, std::size_t axis)> vary;
    bool can_sample_chips = false;  ///< true if process and mismatch can be sampled
    std::string subject_name;       ///< for messages
};
/// The seed in the sweep file; 0 if it has none.
Result<std::uint64_t> seed_of(const SweepText&);
/// Reads the plan of a sweep file. `variants`: axes and chips of the .step and .mc lines in the netlist itself; null for a subject without
/// such lines.
Result<SweepPlan> plan_of(const SweepText&, const VariableQuantities&, const circuit::NetlistVariants* variants = nullptr);

/// Looks up the measures of a sweep by name, and computes a reference model's value of a measure.
struct MeasureLookup {
    std::function<Result<std::size_t>(const LocatedText& measure)> column;  ///< index of its column, which is added if necessary
    std::function<Result<double>(const LocatedText& model, std::size_t column)> model_value;
};
/// Sets min and max of the columns from [limits] in the sweep file.
Result<void> set_limits(const SweepText&, const MeasureLookup&, std::vector<SweepColumn>&);

/// True if spike trains are written to the results (key keep), which is the default.
Result<bool> keeps_spikes(const SweepText&);
/// The sampling step of the probes in the results (key every), in samples of the force. T: step of the force, s.
Result<std::size_t> probe_stride(const SweepText&, double T);
/// The first metadata entries: title, results format and sweep file. `title` is used if the sweep file has none.
std::vector<Sweep::MetadataText> first_metadata(const SweepText&, const std::string& title);

/// Simulates a model with the nominal force and returns one measure of its response. An error if the force varies between items.
Result<double> model_measure(const LocatedText& model, const ForceFactory&, const LocatedText& measure);

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
