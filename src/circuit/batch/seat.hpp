#pragma once
// One chip on its lane: its own time, step, order and Newton's state. The numbers of its unknowns stand in the block's column.

#include <array>

#include "circuit/batch/block.hpp"
#include "circuit/batch/chips.hpp"
#include "circuit/rig.hpp"

namespace corpuscle::circuit {

class Seat {
public:
    /// What a lane does in the next round.
    enum class Work { nothing, restart, iterate };

private:
    ChipMemory& memory_;
    std::size_t lane_;
    std::optional<Chip> chip_;
    std::unique_ptr<Rig> rig_;  // also of the last chip: the next one's, if only the draw differs
    std::shared_ptr<const CircuitDesign> design_;
    double T_ = 0;
    ChipAnswer answer_;
    const BatchOptions* options_ = nullptr;

    // time: as in Transient
    TransientPlan plan_;
    StepControl pace_;
    NewtonControl newton_;
    std::array<double, 8> times_{};  // of the past, newest first
    int points_ = 0, newest_ = 0;    // how many; the ring's place of the newest
    int seen_ = 0, curve_ = 0;       // points on one smooth curve; of the curve in the last step
    double corner_ = 0;              // the next of the sources, once time_ is before it
    bool bent_ = false, last_ = false, jump_ = false, jumped_ = false;
    double end_ = 0;  // s: of its force

    // the step at work
    Work work_ = Work::nothing;
    bool begins_ = false, limited_ = false, far_ = false;  // far: Newton is not there yet, but its error may tell enough
    double t_ = 0, a_ = 0, off_ = 0;
    PastWeights value_{};
    std::vector<std::size_t> sources_;  // that go their course
    std::vector<double> v_, stamp_, x_;
    PowerMeter::Delivered power_;
    std::int64_t sample_ = 0;  // the next to be looked at
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
    /// At its beginning. False: a lane cannot hold it. Error: it does not get so far.
    Result<bool> take(const Chip&, const BatchOptions&);
    /// Its answer, and the lane is free.
    ChipAnswer leave();

    /// What it wants of the next round, with its weights.
    Work prepare(lanes::PredictCall&, std::span<lanes::Row> value, std::span<lanes::Row> slope, lanes::SolveCall&, lanes::StepCall&);
    /// Once its unknowns stand at x.
    void look_at_others();
    bool restarts() const { return work_ == Work::restart; }
    /// The round's equations are solved.
    enum class Verdict { goes_on, wants_error, fails };
    Verdict iterated(double size, bool clamped, bool finite);
    /// Weights of the error of the step at work, had it been of this order.
    void weigh(int order, lanes::ErrorCall&, std::span<lanes::Row> of_past) const;
    int order() const { return pace_.order; }
    enum class Judged { goes_on, rejected, accepted, fails };
    Judged judge(double error);
    bool looks_around() const { return pace_.looks_around(); }
    bool can_fall() const { return pace_.can_fall(); }
    bool can_rise() const { return pace_.can_rise(std::min(plan_.order, points_ - 1), points_); }
    /// An accepted step: whether the chip goes on.
    void choose(double error, double lower, double higher);
    bool accepted();
    double a() const { return a_; }
};

}  // namespace corpuscle::circuit
