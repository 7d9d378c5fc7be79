#pragma once
// What the subjects of sweeps have in common: a plan, columns, what is kept, and the facts.

#include "signal/afferent.hpp"
#include "study/sweep/measured.hpp"
#include "study/sweep/text.hpp"

namespace corpuscle::sweeps {

/// Results of another number are of a program that answers otherwise.
inline constexpr int results_format = 1;

/// A unit that takes this many times the nominal one's iterations is stopped, unless the file says when.
inline constexpr double many_times_nominal = 20;

class PlannedSweep : public Sweep {
protected:
    SweepPlan plan_;
    std::vector<SweepColumn> measures_;
    std::vector<std::string> trains_, traces_;
    std::vector<double> trace_times_;
    std::vector<Fact> facts_;

    /// The last fact, where mismatch is drawn: what each transistor of the chips draws.
    void tell_draws(const std::string& subject, const circuit::Circuit&);

public:
    std::int64_t units() const override { return plan_.units(); }
    const std::vector<SweepColumn>& axes() const override { return plan_.columns(); }
    const std::vector<SweepColumn>& measures() const override { return measures_; }
    const std::vector<std::string>& trains() const override { return trains_; }
    const std::vector<std::string>& traces() const override { return traces_; }
    const std::vector<double>& trace_times() const override { return trace_times_; }
    std::vector<double> values(std::int64_t unit) const override { return plan_.values(unit); }
    const std::vector<Fact>& facts() const override { return facts_; }
};

/// An afferent of equations, one that is a netlist, a netlist with its analyses. `folder`: where the sweep file lies.
Result<std::unique_ptr<Sweep>> equations_sweep(const SweepText&, const std::string& folder);
Result<std::unique_ptr<Sweep>> chips_sweep(const SweepText&, const std::string& folder);
Result<std::unique_ptr<Sweep>> analyses_sweep(const SweepText&, const std::string& folder);

/// Who knows what can vary.
struct Varying {
    std::function<Result<Target>(const Said& what)> target;
    std::function<void(const SweepAxis&, const std::string& what, std::size_t axis)> vary;
    bool chips = false;  ///< whether process and mismatch can be drawn
    std::string named;   ///< the subject
};
Result<std::uint64_t> seed_of(const SweepText&);
/// `written`: what a netlist's own .step and .mc say.
Result<SweepPlan> plan_of(const SweepText&, const Varying&, const circuit::Variants* written = nullptr);

/// Who knows measures by name, and what a model has of them.
struct Limiting {
    std::function<Result<std::size_t>(const Said& measure)> column;
    std::function<Result<double>(const Said& model, std::size_t column)> like;
};
Result<void> set_limits(const SweepText&, const Limiting&, std::vector<SweepColumn>&);

/// Whether trains of spikes are kept: they are if nobody says what is.
Result<bool> keeps_spikes(const SweepText&);
/// Of what is shown every so often: the step in samples.
Result<std::size_t> samples_between(const SweepText&, double T);
/// Title and format, then the sweep file.
std::vector<Sweep::Fact> first_facts(const SweepText&, const std::string& title);

/// What a model that is one afferent says under a force, by the names of measures.
Result<double> model_says(const Said& model, const ForceMaker&, const Said& measure);

/// One afferent by itself through a whole force.
struct AloneAnswer {
    std::vector<double> spikes;             ///< s
    std::vector<std::vector<float>> shown;  ///< each probe asked for at each `every`th sample
};
Result<AloneAnswer> answer_alone(const Afferent&, const FeltForce&, std::span<const std::size_t> probes = {}, std::size_t every = 0,
                                 const std::function<bool()>& stop = {});

}  // namespace corpuscle::sweeps
