#pragma once
// A transient simulation that is driven by a force given block by block.

#include "circuit/afferent/circuit_afferent.hpp"
#include "circuit/afferent/force_waveform.hpp"
#include "circuit/cost/power.hpp"

namespace corpuscle::circuit {

/// Bound to one netlist and one sample time T, s. The elimination order of the matrix is chosen at 0 N, so that the results depend on the
/// force alone and not on earlier simulations. Sample 0 is the first sample given to begin().
class StreamingTransient {
    const CircuitAfferentFactory& factory_;
    std::unique_ptr<AnalysisContext> context_;
    ForceWaveform force_;  // its time is that of the transient
    std::optional<Transient> transient_;
    std::optional<PowerMeter> meter_;
    EnergyCounter energy_;
    bool is_time_dependent_ = false;      // a source that is not a FORCE source depends on time
    std::vector<double> rest_;            // operating point at 0 N, by unknown
    std::vector<double> start_;           // operating point at the first force, by unknown
    std::int64_t origin_sample_ = 0;      // the sample at which the time of the transient is 0; grows with shift_origin()
    std::optional<Spike> pending_spike_;  // the spike in the last step, until the caller takes it

    StreamingTransient(const CircuitAfferentFactory& factory, double T) : factory_(factory), force_(T) {}
    void shift_origin();
    void solve_rest();
    Result<InitialCondition> solve_start(std::span<const double> force, std::vector<double> from);
    std::vector<double> raise_force_from_rest(double force);

public:
    /// `copy`: number of a copy of the nominal circuit, which has noise of its own. `should_stop`: see set_stop().
    static Result<std::unique_ptr<StreamingTransient>> make(const CircuitAfferentFactory&, double T, const std::optional<ChipSample>& chip,
                                                            std::uint64_t copy = 0, const std::function<bool()>& should_stop = {});
    StreamingTransient(const StreamingTransient&) = delete;
    /// Switches to another chip of the same netlist. The elimination order of the matrix does not change.
    void set_chip(const ChipSample& chip);

    /// Restarts from the operating point under the first of these samples (N), which begin the force.
    Result<void> begin(std::span<const double> force);
    /// Sets a function that is called in each time step and in each iteration of an operating point. If it returns true, begin() and step()
    /// fail, and is_stopped() is true. Empty: nothing stops them.
    void set_stop(const std::function<bool()>& should_stop) { context_->newton.should_stop = should_stop; }
    bool is_stopped() const { return context_->newton.is_stopped(); }
    void append_force(std::span<const double> force) { force_.append(force); }
    /// Takes one time step. A spike within the step becomes the pending spike.
    Result<void> step();
    std::optional<Spike>& pending_spike() { return pending_spike_; }

    /// True if the transient has reached this sample.
    bool has_reached(std::int64_t sample) const { return transient_->time() >= time_of(sample); }
    /// The value of a saved quantity at a sample within the last step. For sample 0 and before, the value at the start.
    double probe_value(const SavedQuantity&, std::int64_t sample) const;
    /// Counts of the steps and iterations since begin().
    const TransientStats& work() const { return transient_->stats(); }
    /// The energy used since the last call of this function or of restore().
    EnergyUse take_energy_use() { return std::exchange(energy_.sum, {}); }

    /// Voltages and power at the end of the last step.
    OperatingState operating_state() const;

    AnalysisContext& context() { return *context_; }
    const ForceWaveform& force() const { return force_; }
    const Transient& transient() const { return *transient_; }
    TransientNoise* noise() { return transient_->noise(); }
    const PowerMeter& meter() const { return *meter_; }

    void save(std::vector<double>& out);  ///< appends the state, as numbers
    /// Restores the state that save() wrote after `samples` samples of force were given. Returns false if `in` cannot be such a state.
    bool restore(std::span<const double> in, std::int64_t samples);

private:
    /// The time of a sample on the transient's clock, s.
    double time_of(std::int64_t sample) const { return static_cast<double>(sample - origin_sample_) * force_.T(); }
    void add_nodes(std::vector<OperatingState::Block>&) const;
    void archive(StateArchive&);
};

}  // namespace corpuscle::circuit
