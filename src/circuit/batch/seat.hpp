#pragma once
// One chip on its lane, with its own time, step, order and Newton state. Its unknowns are a column of the block.

#include <array>

#include "circuit/batch/block.hpp"
#include "circuit/batch/chips.hpp"
#include "circuit/streaming_transient.hpp"

namespace corpuscle::circuit {

class Seat {
public:
    /// The task of a lane in the next round.
    enum class Work { nothing, restart, iterate };

private:
    ChipMemory& memory_;
    std::size_t lane_;
    std::optional<Chip> chip_;
    std::unique_ptr<StreamingTransient> rig_;  // reused for the next chip if only the sample differs
    std::shared_ptr<const CircuitAfferentFactory> design_;
    double T_ = 0;
    ChipAnswer answer_;
    const BatchOptions* options_ = nullptr;

    // the state of the integration, as in Transient
    TransientPlan plan_;
    StepControl pace_;
    NewtonControl newton_;
    std::array<double, 8> times_{};  // of the history, newest first
    int points_ = 0, newest_ = 0;    // length of the history; slot of the newest point in the ring buffer
    int seen_ = 0, curve_ = 0;       // points on one smooth curve; points of the last interpolation
    double corner_ = 0;              // next breakpoint of the sources; outdated if not after the last time
    bool bent_ = false, last_ = false, jump_ = false, jumped_ = false;
    double end_ = 0;  // s: end of the force

    // the current step
    Work work_ = Work::nothing;
    bool begins_ = false, limited_ = false, far_ = false;  // is_iterating_: not converged yet, but the error is estimated early
    double t_ = 0, a_ = 0, off_ = 0;
    PastWeights value_{};
    std::vector<std::size_t> sources_;  // time-dependent sources
    std::vector<double> v_, stamp_, x_;
    PowerMeter::DeliveredPower power_;
    std::int64_t sample_ = 0;  // next sample to record
    long looks_ = 0;

    std::size_t ring(int k) const { return static_cast<std::size_t>((newest_ + k) % static_cast<int>(memory_.block.points)); }
    double past(lanes::Row* rows, int k, std::size_t n) const { return rows[ring(k) * memory_.unknowns() + n].of[lane_]; }
    std::span<const double> times(int count) const { return std::span(times_).first(static_cast<std::size_t>(count)); }
    bool can_be_held() const;
    void set_sources(double t);
    void attempt();
    double bend();
    void advance();
    double between(double t, int unknown) const;
    std::optional<double> spike() const;
    void look_at_samples();
    void spend(double from);

public:
    Seat(ChipMemory& memory, std::size_t lane) : memory_(memory), lane_(lane) {}

    bool taken() const { return chip_.has_value(); }
    const Chip& chip() const { return *chip_; }
    /// Loads a chip at its initial condition. Returns false if a lane cannot simulate it. Errors: no initial condition.
    Result<bool> take(const Chip&, const BatchOptions&);
    /// Returns the result and frees the lane.
    ChipAnswer leave();

    /// Chooses the task of the next round and writes its arguments and weights.
    Work prepare(lanes::PredictCall&, std::span<lanes::Row> value, std::span<lanes::Row> slope, lanes::SolveCall&, lanes::StepCall&);
    /// Call after x has been set.
    void look_at_others();
    bool restarts() const { return work_ == Work::restart; }
    /// Call after the equations of a round are solved.
    enum class Verdict { goes_on, wants_error, fails };
    Verdict iterated(double size, bool clamped, bool finite);
    /// Writes the weights that give the error of the current step for this order.
    void weigh(int order, lanes::ErrorCall&, std::span<lanes::Row> of_past) const;
    int order() const { return pace_.order; }
    enum class Judged { goes_on, rejected, accepted, fails };
    Judged judge(double error);
    bool looks_around() const { return pace_.looks_around(); }
    bool can_fall() const { return pace_.can_fall(); }
    bool can_rise() const { return pace_.can_rise(std::min(plan_.order, points_ - 1), points_); }
    /// Chooses the next step after an accepted one, from its error and those for the next lower and higher order.
    void choose(double error, double lower, double higher);
    /// Advances to the end of an accepted step. Returns false if the chip is done.
    bool accepted();
    double a() const { return a_; }
};

}  // namespace corpuscle::circuit
