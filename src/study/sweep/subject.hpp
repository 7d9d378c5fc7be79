#pragma once
// Common parts of the subjects of sweeps: plan, columns, recorded outputs, and metadata.

#include "signal/afferent.hpp"
#include "study/sweep/measured.hpp"
#include "study/sweep/text.hpp"

namespace corpuscle::sweeps {

/// Results of another number come from a program that computes differently.
inline constexpr int results_format = 1;

/// An item is stopped after this many times the nominal item's iterations, unless the file sets a limit.
inline constexpr double many_times_nominal = 20;

class PlannedSweep : public Sweep {
protected:
    SweepPlan plan_;
    std::vector<SweepColumn> measures_;
    std::vector<std::string> trains_, traces_;
    std::vector<double> trace_times_;
    std::vector<Fact> facts_;

    /// Adds the last metadata entry if mismatch is sampled: the mismatch of each transistor.
    void tell_draws(const std::string& subject, const circuit::Circuit&);

public:
    std::int64_t units() const override { return plan_.units(); }
    const std::vector<SweepColumn>& axes() const override { return plan_.columns(); }
    const std::vector<SweepColumn>& measures() const override { return measures_; }
    const std::vector<std::string>& trains() const override { return trains_; }
    const std::vector<std::string>& traces() const override { return traces_; }
    const std::vector<double>& trace_times() const override { return trace_times_; }
    std::vector<double> values(std::int64_t item) const override { return plan_.values(item); }
    const std::vector<Fact>& facts() const override { return facts_; }
};

/// A model afferent, a netlist afferent, and a netlist with its analyses. `folder`: the folder of the sweep file.
Result<std::unique_ptr<Sweep>> equations_sweep(const SweepText&, const std::string& folder);
Result<std::unique_ptr<Sweep>> chips_sweep(const SweepText&, const std::string& folder);
Result<std::unique_ptr<Sweep>> analyses_sweep(const SweepText&, const std::string& folder);

/// The quantities of a subject that can vary.
struct Varying {
    std::function<Result<Target>(const LocatedText& quantity)> target;
    std::function<void(const SweepAxis&, const std::string& quantity, std::size_t axis)> vary;
    bool chips = false;  ///< process and mismatch can be sampled
    std::string named;   ///< name of the subject
};
Result<std::uint64_t> seed_of(const SweepText&);
/// `written`: the .step and .mc lines of the netlist itself.
Result<SweepPlan> plan_of(const SweepText&, const Varying&, const circuit::NetlistVariants* written = nullptr);

/// Looks up measures by name, and computes a model's values of them.
struct Limiting {
    std::function<Result<std::size_t>(const LocatedText& measure)> column;
    std::function<Result<double>(const LocatedText& model, std::size_t column)> like;
};
Result<void> set_limits(const SweepText&, const Limiting&, std::vector<SweepColumn>&);

/// True if spike trains are kept, which is the default.
Result<bool> keeps_spikes(const SweepText&);
/// The sampling step of the kept probes, in samples.
Result<std::size_t> samples_between(const SweepText&, double T);
/// Title and format, then the sweep file.
std::vector<Sweep::Fact> first_facts(const SweepText&, const std::string& title);

/// The measure of a model afferent's response to a force.
Result<double> model_says(const LocatedText& model, const ForceMaker&, const LocatedText& measure);

/// The response of one afferent to a complete force.
struct AloneAnswer {
    std::vector<double> spikes;             ///< s
    std::vector<std::vector<float>> shown;  ///< each requested probe at each `every`th sample
};
Result<AloneAnswer> answer_alone(const Afferent&, const FeltForce&, std::span<const std::size_t> probes = {}, std::size_t every = 0,
                                 const std::function<bool()>& stop = {});

}  // namespace corpuscle::sweeps
