#pragma once
// One chip on its lane, with its own time, step, order and Newton state. Its unknowns are a column of the block.

#include <array>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/batch/chip_memory.hpp"
#include "circuit/streaming_transient.hpp"

namespace corpuscle::circuit {

class ChipLane {
public:
    /// The task of a lane in the next round.
    enum class NextTask { nothing, restart, iterate };

private:
    ChipMemory& memory_;
    std::size_t lane_;
    std::optional<Chip> chip_;
    std::unique_ptr<StreamingTransient> simulation_;  // reused for the next chip if only the sample differs
    std::shared_ptr<const CircuitAfferentFactory> design_;
    double T_ = 0;
    ChipResponse response_;
    const BatchOptions* options_ = nullptr;

    // the state of the integration, as in Transient
    TransientPlan plan_;
    StepControl control_;
    NewtonControl newton_;
    std::array<double, 8> times_{};            // of the history, newest first
    int points_ = 0, newest_slot_ = 0;         // length of the history; slot of the newest point in the ring buffer
    int smooth_count_ = 0, curve_points_ = 0;  // points on one smooth curve; points of the last interpolation
    double breakpoint_ = 0;                    // s: next breakpoint of the sources; a new one is searched for once it has been reached
    bool restart_pending_ = false, ends_at_breakpoint_ = false, may_jump_ = false, jumped_ = false;
    double end_time_ = 0;  // s: end of the force

    // the current step
    NextTask next_task_ = NextTask::nothing;
    bool is_new_step_ = false, is_limited_ = false,
         is_iterating_ = false;                       // is_iterating_: not converged yet, but the error is estimated early
    double t_ = 0, a_ = 0, interpolation_error_ = 0;  // end of the step, s; dq/dt = a q + history; relative to the allowed error
    HistoryWeights predictor_weights_{};
    std::vector<std::size_t> sources_;  // time-dependent sources
    std::vector<double> v_, stamp_, x_;
    PowerMeter::DeliveredPower power_;
    std::int64_t next_sample_ = 0;  // next sample to record
    long rounds_ = 0;

    std::size_t history_slot(int k) const { return static_cast<std::size_t>((newest_slot_ + k) % static_cast<int>(memory_.block.points)); }
    double past(lanes::LaneRow* rows, int k, std::size_t n) const { return rows[history_slot(k) * memory_.unknowns() + n].value[lane_]; }
    std::span<const double> times(int count) const { return std::span(times_).first(static_cast<std::size_t>(count)); }
    bool is_compatible() const;
    void set_sources(double t);
    void start_step();
    double interpolation_error();
    void advance();
    double interpolate(double t, int unknown) const;
    std::optional<double> spike() const;
    void record_samples();
    void add_energy(double step_start);

public:
    ChipLane(ChipMemory& memory, std::size_t lane) : memory_(memory), lane_(lane) {}

    bool is_occupied() const { return chip_.has_value(); }
    const Chip& chip() const { return *chip_; }
    /// Loads a chip at its initial condition. Returns false if a lane cannot simulate it. Errors: no initial condition.
    Result<bool> start(const Chip&, const BatchOptions&);
    /// Returns the result and frees the lane.
    ChipResponse finish();

    /// Chooses the task of the next round and writes its arguments and weights.
    NextTask prepare(lanes::PredictCall&, std::span<lanes::LaneRow> value, std::span<lanes::LaneRow> slope, lanes::SolveCall&,
                     lanes::StepCall&);
    /// Call after x has been set.
    void relinearize_nonlinear_devices();
    bool is_restarting() const { return next_task_ == NextTask::restart; }
    /// Call after the equations of a round are solved.
    enum class IterationStatus { iterating, needs_error, failed };
    IterationStatus finish_iteration(double size, bool clamped, bool finite);
    /// Writes the weights that give the error of the current step for this order.
    void set_error_weights(int order, lanes::ErrorCall&, std::span<lanes::LaneRow> past_weights) const;
    int order() const { return control_.order; }
    enum class StepStatus { iterating, rejected, accepted, failed };
    StepStatus decide_step(double error);
    bool is_order_change_due() const { return control_.is_order_change_due(); }
    bool can_lower_order() const { return control_.can_lower_order(); }
    bool can_raise_order() const { return control_.can_raise_order(std::min(plan_.max_order, points_ - 1), points_); }
    /// Chooses the next step after an accepted one, from its error and those for the next lower and higher order.
    void choose_step(double error, double lower, double higher);
    /// Advances to the end of an accepted step. Returns false if the chip is done.
    bool accept_step();
    double a() const { return a_; }
};

}  // namespace corpuscle::circuit
