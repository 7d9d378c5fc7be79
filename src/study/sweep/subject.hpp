#pragma once
// Common parts of the subjects of sweeps: plan, columns, recorded outputs, and metadata.

#include "signal/afferent.hpp"
#include "study/sweep/afferent_measures.hpp"
#include "study/sweep/sweep_text.hpp"

namespace corpuscle::sweeps {

/// Version of the computation: results with another version come from a program that computes differently.
inline constexpr int results_format = 1;

/// An item is stopped after this many times the nominal item's iterations, unless the file sets a limit.
inline constexpr double iteration_limit_factor = 20;

class PlannedSweep : public Sweep {
protected:
    SweepPlan plan_;
    std::vector<SweepColumn> measures_;
    std::vector<std::string> train_names_, probe_names_;
    std::vector<double> probe_times_;
    std::vector<MetadataText> metadata_;

    /// Adds the last metadata entry if mismatch is sampled: the mismatch of each transistor.
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

/// The quantities of a subject that can vary.
struct VariableQuantities {
    std::function<Result<VariedQuantity>(const LocatedText& quantity)> find_quantity;
    std::function<void(const SweepAxis&, const std::string& quantity, std::size_t axis)> vary;
    bool can_sample_chips = false;  ///< process and mismatch can be sampled
    std::string subject_name;
};
Result<std::uint64_t> seed_of(const SweepText&);
/// `variants`: of the netlist's own .step and .mc lines; null: none.
Result<SweepPlan> plan_of(const SweepText&, const VariableQuantities&, const circuit::NetlistVariants* variants = nullptr);

/// Looks up measures by name, and computes a model's values of them.
struct MeasureLookup {
    std::function<Result<std::size_t>(const LocatedText& measure)> column;
    std::function<Result<double>(const LocatedText& model, std::size_t column)> model_value;
};
Result<void> set_limits(const SweepText&, const MeasureLookup&, std::vector<SweepColumn>&);

/// True if spike trains are kept, which is the default.
Result<bool> keeps_spikes(const SweepText&);
/// The sampling step of the kept probes, in samples.
Result<std::size_t> probe_stride(const SweepText&, double T);
/// The first metadata entries: title, results format and sweep file.
std::vector<Sweep::MetadataText> first_metadata(const SweepText&, const std::string& title);

/// Simulates a model afferent with a force and returns one measure of its response.
Result<double> model_measure(const LocatedText& model, const ForceFactory&, const LocatedText& measure);

/// The response of one afferent to a complete force.
struct SimulatedResponse {
    std::vector<double> spikes;                     ///< s
    std::vector<std::vector<float>> probe_samples;  ///< each requested probe at every `every`-th sample
};
Result<SimulatedResponse> simulate_afferent(const Afferent&, const SweepForce&, std::span<const std::size_t> probes = {},
                                            std::size_t every = 0, const std::function<bool()>& stop = {});

}  // namespace corpuscle::sweeps
