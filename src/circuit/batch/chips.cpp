#include "circuit/batch/chips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "circuit/batch/seat.hpp"
#include "circuit/device/transistor.hpp"

namespace corpuscle::circuit {
namespace {

using lanes::Row;

/// A block of lanes at work: round by round, one of Newton's steps for every chip that stands in it.
class Batch {
    const lanes::ChipLanes& kernels_;
    const std::function<std::optional<Chip>()>& next_;
    const std::function<void(const Chip&, ChipAnswer&&)>& told_;
    const BatchOptions& options_;
    ChipMemory memory_;
    std::vector<Seat> seats_;
    std::vector<Row> value_, slope_, weights_;
    bool more_ = true;
    double gmin_;
    std::array<double, lanes::chips> error_{}, lower_{}, higher_{};

    void fill(std::size_t lane);
    void alone(const Chip&, long tried);
    void leave(std::size_t lane);
    void fail(std::size_t lane);
    std::uint8_t prepare(lanes::SolveCall&, lanes::StepCall&);
    std::uint8_t strayed(std::uint8_t working, const lanes::SolveCall&);
    void iterate(std::uint8_t working, lanes::SolveCall&, lanes::StepCall&);
    void judge(std::uint8_t arrived, std::uint8_t lost, const Row& a);
    template <class Wants, class OrderOf>
    void errors(std::uint8_t of, const Wants& wants, const OrderOf& order_of, std::array<double, lanes::chips>& out);

public:
    Batch(const lanes::ChipLanes& kernels, const System& system, const Elimination& list, double far, std::size_t points, double gmin,
          const std::function<std::optional<Chip>()>& next, const std::function<void(const Chip&, ChipAnswer&&)>& told,
          const BatchOptions& options)
        : kernels_(kernels), next_(next), told_(told), options_(options), memory_(system, list, points), value_(points), slope_(points),
          weights_(points), gmin_(gmin) {
        memory_.far = far;
        for (std::size_t l = 0; l < options.lanes; ++l) seats_.emplace_back(memory_, l);
    }
    Result<void> run();
};

constexpr double doubtful_growth = 1e6, doubtful_rest = 1e-9;  // of an elimination: when its answer is looked at, what it may leave over

bool has(std::uint8_t set, std::size_t lane) { return (set >> lane & 1) != 0; }
std::uint8_t only(std::size_t lane) { return static_cast<std::uint8_t>(1u << lane); }

/// The next chip that gets as far as its beginning takes the lane.
void Batch::fill(std::size_t lane) {
    while (more_ && !seats_[lane].taken()) {
        auto chip = next_();
        more_ = chip.has_value();
        if (!chip) return;
        const auto seated = seats_[lane].take(*chip, options_);
        if (!seated) {
            ChipAnswer answer;
            answer.error = seated.error();
            told_(*chip, std::move(answer));
        } else if (!*seated) {
            alone(*chip, 0);
        }
    }
}

void Batch::alone(const Chip& chip, long tried) {
    auto answer = run_chip_alone(chip, options_);
    answer.alone = true, answer.work.iterations += tried;
    told_(chip, std::move(answer));
}

void Batch::leave(std::size_t lane) {
    const Chip chip = seats_[lane].chip();
    told_(chip, seats_[lane].leave());
    fill(lane);
}

void Batch::fail(std::size_t lane) {
    const Chip chip = seats_[lane].chip();
    alone(chip, seats_[lane].leave().work.iterations);
    fill(lane);
}

std::uint8_t Batch::prepare(lanes::SolveCall& solve, lanes::StepCall& step) {
    lanes::PredictCall predict{{}, value_.data(), slope_.data()};
    std::uint8_t working = 0;
    for (std::size_t l = 0; l < seats_.size(); ++l)
        if (seats_[l].prepare(predict, value_, slope_, solve, step) != Seat::Work::nothing) working |= only(l);
    kernels_.predict(memory_.block, predict);
    return working;
}

template <class Wants, class OrderOf>
void Batch::errors(std::uint8_t of, const Wants& wants, const OrderOf& order_of, std::array<double, lanes::chips>& out) {
    lanes::ErrorCall call{};
    call.of_past = weights_.data();
    std::fill(weights_.begin(), weights_.end(), Row{});
    bool any = false;
    for (std::size_t l = 0; l < seats_.size(); ++l)
        if (has(of, l) && wants(seats_[l])) seats_[l].weigh(order_of(seats_[l]), call, weights_), any = true;
    if (!any) return;
    kernels_.error(memory_.block, call);
    for (std::size_t l = 0; l < seats_.size(); ++l) out[l] = call.worst.of[l];
}

/// Of those at work, whose elimination cannot be trusted.
std::uint8_t Batch::strayed(std::uint8_t working, const lanes::SolveCall& solve) {
    std::uint8_t doubtful = 0;
    for (std::size_t l = 0; l < seats_.size(); ++l)
        if (has(working, l) && !seats_[l].restarts() && !(solve.growth.of[l] < doubtful_growth)) doubtful |= only(l);
    if (doubtful == 0) return 0;
    Row left;
    kernels_.left_over(memory_.block, solve, left);
    std::uint8_t out = 0;
    for (std::size_t l = 0; l < seats_.size(); ++l)
        if (has(doubtful, l) && !(left.of[l] < doubtful_rest)) out |= only(l);
    return out;
}

void Batch::iterate(std::uint8_t working, lanes::SolveCall& solve, lanes::StepCall& step) {
    const auto astray = strayed(working, solve);
    kernels_.go(memory_.block, step);
    std::uint8_t arrived = 0, lost = 0;
    for (std::size_t l = 0; l < seats_.size(); ++l) {
        if (!has(working, l)) continue;
        if (has(astray, l)) {
            fail(l);
            continue;
        }
        const auto verdict = seats_[l].iterated(step.size.of[l], step.clamped.of[l] > 0, step.bad.of[l] == 0);
        if (verdict == Seat::Verdict::wants_error) arrived |= only(l);
        if (verdict == Seat::Verdict::fails) lost |= only(l);
    }
    judge(arrived, lost, solve.a);
}

void Batch::judge(std::uint8_t arrived, std::uint8_t lost, const Row& a) {
    if ((arrived | lost) == 0) return;
    kernels_.charges(memory_.block);
    errors(arrived, [](const Seat&) { return true; }, [](const Seat& s) { return s.order(); }, error_);
    lanes::AcceptCall accept{{}, a};
    std::uint8_t accepted = 0, around = 0;
    for (std::size_t l = 0; l < seats_.size(); ++l) {
        if (!has(arrived | lost, l)) continue;
        switch (seats_[l].judge(has(lost, l) ? std::numeric_limits<double>::infinity() : error_[l])) {
            case Seat::Judged::accepted:
                accepted |= only(l), accept.taken.of[l] = 1;
                if (seats_[l].looks_around()) around |= only(l);
                break;
            case Seat::Judged::fails:
                fail(l);
                break;
            default:
                break;
        }
    }
    if (accepted == 0) return;
    errors(around, [](const Seat& s) { return s.can_fall(); }, [](const Seat& s) { return s.order() - 1; }, lower_);
    errors(around, [](const Seat& s) { return s.can_rise(); }, [](const Seat& s) { return s.order() + 1; }, higher_);
    kernels_.accept(memory_.block, accept);
    for (std::size_t l = 0; l < seats_.size(); ++l) {
        if (!has(accepted, l)) continue;
        seats_[l].choose(error_[l], lower_[l], higher_[l]);
        if (!seats_[l].accepted()) leave(l);
    }
}

Result<void> Batch::run() {
    for (std::size_t l = 0; l < seats_.size(); ++l) fill(l);
    for (long round = 0;; ++round) {
        if (round % 64 == 0 && options_.stop && options_.stop()) return Error{Code::interrupted, "interrupted"};
        lanes::SolveCall solve{};
        lanes::StepCall step{};
        const auto working = prepare(solve, step);
        if (working == 0) return {};
        memory_.look(kernels_, working, gmin_);
        for (std::size_t l = 0; l < seats_.size(); ++l)
            if (has(working, l)) seats_[l].look_at_others();
        kernels_.solve(memory_.block, solve);
        iterate(working, solve, step);
    }
}

/// V: how far a transistor may go along its straight line. What it is off there is a part of its current, (far / n phi_t)^2 / 2 or less,
/// as if its gate stood that much of n phi_t elsewhere: a sixteenth of what a step may err.
double far_of(const TransientPlan& plan) {
    constexpr double phi_t = 0.026, part = 1.0 / 16;
    return std::sqrt(2 * phi_t * part * (plan.reltol * 0.5 + plan.vntol));
}

Result<void> one_by_one(const std::function<std::optional<Chip>()>& next, const std::function<void(const Chip&, ChipAnswer&&)>& told,
                        const BatchOptions& options) {
    while (const auto chip = next()) {
        auto answer = run_chip_alone(*chip, options);
        if (answer.error && answer.error->code == Code::interrupted) return *answer.error;
        answer.alone = true;
        told(*chip, std::move(answer));
    }
    return {};
}

}  // namespace

Result<void> run_chips(const std::shared_ptr<const CircuitDesign>& nominal, const std::function<std::optional<Chip>()>& next,
                       const std::function<void(const Chip&, ChipAnswer&&)>& told, const BatchOptions& options) {
    const auto kernels = chip_kernels();
    if (!kernels) return kernels.error();
    auto rig = Rig::make(*nominal, 1e-4, {});
    if (!rig) return rig.error();
    const auto& system = (*rig)->bench().system;
    const auto* list = (*rig)->transient().elimination();
    if (list == nullptr || system.groups().empty() || nominal->plan.method != Integration::bdf) return one_by_one(next, told, options);
    return Batch(**kernels, system, *list, far_of(nominal->plan),
                 static_cast<std::size_t>(std::max(nominal->plan.order + 1, StepControl::curve_points)), (*rig)->bench().tolerances.gmin,
                 next, told, options)
        .run();
}

}  // namespace corpuscle::circuit
