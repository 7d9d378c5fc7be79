#pragma once
// One chip on its lane, with its own time, step, order and Newton state. Its unknowns are a column of the block. In each round, the kernels
// make one Newton iteration for all lanes. Times are in s since the first sample of the chip's force.

#include "circuit/afferent/streaming_transient.hpp"
#include "circuit/batch/chip_batch.hpp"
#include "circuit/batch/chip_memory.hpp"

namespace corpuscle::circuit {

class ChipLane {
public:
    /// The task of a lane in the next round.
    enum class NextTask {
        nothing,  ///< the lane is free, or begins a time step
        restart,  ///< evaluate the newest point, from which the integration restarts
        iterate   ///< a Newton iteration of the current time step
    };

private:
    ChipMemory& memory_;
    std::size_t lane_;                                      // column of the block
    std::optional<Chip> chip_;                              // nothing: the lane is free
    std::unique_ptr<StreamingTransient> simulation_;        // circuit, sources and initial condition; kept if the next chip has this design
    std::shared_ptr<const CircuitAfferentFactory> design_;  // design and sample time (s) of simulation_
    double T_ = 0;
    ChipResponse response_;
    const BatchOptions* options_ = nullptr;

    // the state of the integration; see the members of Transient with the same names
    TransientPlan plan_;
    StepControl control_;
    NewtonControl newton_;
    std::array<double, 8> times_{};            // of the history, newest first
    int points_ = 0, newest_slot_ = 0;         // length of the history; slot of the newest point in the ring buffer
    int smooth_count_ = 0, curve_points_ = 0;  // points on one smooth curve; points of the last interpolation
    double breakpoint_ = 0;                    // next breakpoint of the sources, or the end; the following one is found when it is reached
    bool restart_pending_ = false, may_jump_ = false;
    bool jumped_ = false;  // the current step was accepted although the solution may have jumped
    double end_time_ = 0;  // of the last sample of the force

    // the current step
    NextTask next_task_ = NextTask::nothing;
    bool is_new_step_ = false;  // the step begins in this round
    bool is_limited_ = false;   // some device was evaluated at limited voltages
    StepControl::Step step_{};
    NewtonControl::Status status_{};  // of the last iteration
    double a_ = 0;                    // dq/dt = a_ q + history
    double interpolation_error_ = 0;  // relative to the allowed error
    HistoryWeights predictor_weights_{};
    std::vector<std::size_t> sources_;  // indices of the time-dependent sources
    std::vector<double> v_;             // buffers of set_sources()
    StampBuffer stamp_;
    std::vector<double> x_;                  // unknowns at the newest point
    TransientNoise* noise_ = nullptr;        // of simulation_; null: none
    std::vector<NodeNoise> node_noise_;      // by unknown
    std::vector<double> last_noise_charge_;  // by equation, of the last step
    std::vector<double> floor_;              // as ChipBlock::floor, without noise
    std::vector<double> noise_charge_;       // in the current step, by equation
    bool charges_shifted_ = false;           // noise_charge_ is subtracted from the charges of the history
    EnergyCounter energy_;                   // up to the newest point
    std::int64_t next_sample_ = 0;           // next sample to record
    long rounds_ = 0;                        // since start()

    // Point k of the history, from 0 for the newest: its slot in the ring buffer, the value of unknown n there, the times of the newest
    // points.
    std::size_t history_slot(int k) const { return static_cast<std::size_t>((newest_slot_ + k) % static_cast<int>(memory_.block.points)); }
    double past(lanes::LaneRow* rows, int k, std::size_t n) const { return rows[history_slot(k) * memory_.unknowns() + n].value[lane_]; }
    std::span<const double> times(int count) const { return std::span(times_).first(static_cast<std::size_t>(count)); }
    bool is_compatible() const;
    void set_sources(double t);
    void start_step();
    void shift_charges();
    void undo_charge_shift();
    double interpolation_error();
    void advance();
    double interpolate(double t, int unknown) const;
    std::optional<double> spike() const;
    void record_samples();

public:
    ChipLane(ChipMemory& memory, std::size_t lane) : memory_(memory), lane_(lane) {}

    bool is_occupied() const { return chip_.has_value(); }
    const Chip& chip() const { return *chip_; }
    /// Loads a chip at its initial condition. Returns false if a lane cannot simulate it. Errors: a chip without an initial condition.
    Result<bool> start(const Chip&, const BatchOptions&);
    /// Returns the result and frees the lane.
    ChipResponse finish();

    /// Chooses the task of the next round and writes this lane's arguments of the kernels, with the weights of PredictCall.
    NextTask prepare(lanes::PredictCall&, std::span<lanes::LaneRow> value_weights, std::span<lanes::LaneRow> slope_weights,
                     lanes::SolveCall&, lanes::StepCall&);
    /// Call after the predict() kernel has set x.
    void relinearize_nonlinear_devices();
    bool is_restarting() const { return next_task_ == NextTask::restart; }
    enum class IterationStatus { iterating, needs_error, failed };
    /// Call after the apply_step() kernel, with its results for this lane. needs_error: decide_step() needs the error of the time step.
    IterationStatus finish_iteration(double size, bool is_clamped, bool is_finite);
    /// Writes this lane's weights of ErrorCall, for the error that the current step would have with this order.
    void set_error_weights(int order, lanes::ErrorCall&, std::span<lanes::LaneRow> past_weights) const;
    int order() const { return control_.order; }
    enum class StepStatus { iterating, rejected, accepted, failed };
    /// Decides about the time step after finish_iteration(). `error` is relative to the allowed error; infinite: the iterations diverged.
    StepStatus decide_step(double error);
    bool is_order_change_due() const { return control_.is_order_change_due(); }
    bool can_lower_order() const { return control_.can_lower_order(); }
    bool can_raise_order() const { return control_.can_raise_order(std::min(plan_.max_order, points_ - 1), points_); }
    /// True if measure_noise() is due in this accepted step.
    bool is_noise_measured() const { return noise_ != nullptr && response_.stats.steps % TransientNoise::steps_per_measure == 0; }
    /// Writes the noise of the step to `error` of the block. Call measure_noise() after solve_perturbation().
    void write_noise();
    void measure_noise();
    /// Chooses the length and order of the next step after an accepted one, from its error and those for the next lower and higher order.
    void choose_step(double error, double lower, double higher);
    /// Advances to the end of an accepted step, and records spikes, samples and energy. Returns false if the chip is done.
    bool accept_step();
};

}  // namespace corpuscle::circuit
