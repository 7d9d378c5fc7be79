#include "circuit/batch/chip_batch.hpp"

#include "circuit/batch/chip_lane.hpp"

namespace corpuscle::circuit {
namespace {

using lanes::LaneRow;

/// Simulates chips on the lanes of one block. Each round makes one Newton iteration for every chip in the block. Sets of lanes are bits of
/// a std::uint8_t.
class Batch {
    const lanes::ChipKernels& kernels_;
    const std::function<std::optional<Chip>()>& next_;
    const std::function<void(const Chip&, ChipResponse&&)>& on_done_;
    const BatchOptions& options_;
    ChipMemory memory_;
    std::vector<ChipLane> lanes_;
    std::vector<LaneRow> value_weights_, slope_weights_;  // of PredictCall
    std::vector<LaneRow> error_weights_;                  // of ErrorCall
    bool has_more_chips_ = true;
    double gmin_;  // S
    // Errors of the last step of each lane for its order and the next lower and higher order, relative to the allowed error.
    std::array<double, lanes::chips_per_block> error_{}, lower_{}, higher_{};

    void fill(std::size_t lane);
    void run_scalar(const Chip&, long iterations);
    void finish(std::size_t lane);
    void fail(std::size_t lane);
    std::uint8_t prepare(lanes::SolveCall&, lanes::StepCall&);
    std::uint8_t inaccurate_lanes(std::uint8_t working, const lanes::SolveCall&);
    void iterate(std::uint8_t working, lanes::SolveCall&, lanes::StepCall&);
    void measure_noise(std::uint8_t accepted);
    void decide_steps(std::uint8_t needs_error, std::uint8_t diverged, const LaneRow& a);
    template <class Needs, class OrderOf>
    void estimate_errors(std::uint8_t selected, const Needs& needs, const OrderOf& order_of,
                         std::array<double, lanes::chips_per_block>& out);

public:
    Batch(const lanes::ChipKernels& kernels, const System& system, const Elimination& list, double radius, std::size_t points, double gmin,
          const std::function<std::optional<Chip>()>& next, const std::function<void(const Chip&, ChipResponse&&)>& on_done,
          const BatchOptions& options)
        : kernels_(kernels), next_(next), on_done_(on_done), options_(options), memory_(system, list, points), value_weights_(points),
          slope_weights_(points), error_weights_(points), gmin_(gmin) {
        memory_.linearization_radius = radius;
        for (std::size_t l = 0; l < options.lanes; ++l) lanes_.emplace_back(memory_, l);
    }
    Result<void> run();
};

constexpr double doubtful_lane_growth = 1e6;     // largest multiplier of an elimination at and above which its solution is checked
constexpr double doubtful_lane_residual = 1e-9;  // relative residual at and above which a solution is not accurate enough

bool contains(std::uint8_t set, std::size_t lane) { return (set >> lane & 1) != 0; }
std::uint8_t bit(std::size_t lane) { return static_cast<std::uint8_t>(1u << lane); }

/// Calls use(lane) for each lane of a set.
template <class Use>
void for_each_lane(std::uint8_t set, const Use& use) {
    for (std::size_t l = 0; l < lanes::chips_per_block; ++l)
        if (contains(set, l)) use(l);
}

/// Loads the next chip that has an initial condition into a free lane.
void Batch::fill(std::size_t lane) {
    while (has_more_chips_ && !lanes_[lane].is_occupied()) {
        auto chip = next_();
        has_more_chips_ = chip.has_value();
        if (!chip) return;
        const auto started = lanes_[lane].start(*chip, options_);
        if (!started) {
            ChipResponse response;
            response.error = started.error();
            on_done_(*chip, std::move(response));
        } else if (!*started) {
            run_scalar(*chip, 0);
        }
    }
}

/// Simulates a chip by the scalar code. `iterations`: Newton iterations that it has already taken on its lane.
void Batch::run_scalar(const Chip& chip, long iterations) {
    auto response = run_chip_scalar(chip, options_);
    response.is_scalar = true, response.stats.iterations += iterations;
    on_done_(chip, std::move(response));
}

/// Passes on the result of a lane, and loads the next chip.
void Batch::finish(std::size_t lane) {
    const Chip chip = lanes_[lane].chip();
    on_done_(chip, lanes_[lane].finish());
    fill(lane);
}

/// Simulates the chip of a lane by the scalar code, because its elimination or its convergence failed.
void Batch::fail(std::size_t lane) {
    const Chip chip = lanes_[lane].chip();
    run_scalar(chip, lanes_[lane].finish().stats.iterations);
    fill(lane);
}

/// Prepares a round and predicts x. Returns the lanes that have a task.
std::uint8_t Batch::prepare(lanes::SolveCall& solve, lanes::StepCall& step) {
    lanes::PredictCall predict{{}, value_weights_.data(), slope_weights_.data()};
    std::uint8_t working = 0;
    for (std::size_t l = 0; l < lanes_.size(); ++l)
        if (lanes_[l].prepare(predict, value_weights_, slope_weights_, solve, step) != ChipLane::NextTask::nothing) working |= bit(l);
    kernels_.predict(memory_.block, predict);
    return working;
}

/// For each selected lane with needs(lane), estimates the error that its step would have with the order order_of(lane).
template <class Needs, class OrderOf>
void Batch::estimate_errors(std::uint8_t selected, const Needs& needs, const OrderOf& order_of,
                            std::array<double, lanes::chips_per_block>& out) {
    lanes::ErrorCall call{};
    call.past_weights = error_weights_.data();
    std::fill(error_weights_.begin(), error_weights_.end(), LaneRow{});
    bool any = false;
    for_each_lane(selected, [&](std::size_t l) {
        if (needs(lanes_[l])) lanes_[l].set_error_weights(order_of(lanes_[l]), call, error_weights_), any = true;
    });
    if (!any) return;
    kernels_.estimate_error(memory_.block, call);
    for (std::size_t l = 0; l < lanes_.size(); ++l) out[l] = call.worst.value[l];
}

/// The lanes whose solution is not accurate enough.
std::uint8_t Batch::inaccurate_lanes(std::uint8_t working, const lanes::SolveCall& solve) {
    std::uint8_t doubtful = 0;
    for_each_lane(working, [&](std::size_t l) {
        if (!lanes_[l].is_restarting() && !(solve.growth.value[l] < doubtful_lane_growth)) doubtful |= bit(l);
    });
    if (doubtful == 0) return 0;
    LaneRow residual;
    kernels_.residual(memory_.block, solve, residual);
    std::uint8_t out = 0;
    for_each_lane(doubtful, [&](std::size_t l) {
        if (!(residual.value[l] < doubtful_lane_residual)) out |= bit(l);
    });
    return out;
}

/// Applies the Newton steps of the working lanes, and decides about their time steps.
void Batch::iterate(std::uint8_t working, lanes::SolveCall& solve, lanes::StepCall& step) {
    const auto failed = inaccurate_lanes(working, solve);
    kernels_.apply_step(memory_.block, step);
    std::uint8_t needs_error = 0, diverged = 0;
    for_each_lane(working, [&](std::size_t l) {
        if (contains(failed, l)) return fail(l);
        const auto status = lanes_[l].finish_iteration(step.size.value[l], step.clamped.value[l] > 0, step.non_finite.value[l] == 0);
        if (status == ChipLane::IterationStatus::needs_error) needs_error |= bit(l);
        if (status == ChipLane::IterationStatus::failed) diverged |= bit(l);
    });
    decide_steps(needs_error, diverged, solve.a);
}

/// Measures the effect of the noise in the lanes in which that is due.
void Batch::measure_noise(std::uint8_t accepted) {
    std::uint8_t due = 0;
    for_each_lane(accepted, [&](std::size_t l) {
        if (lanes_[l].is_noise_measured()) lanes_[l].write_noise(), due |= bit(l);
    });
    if (due == 0) return;
    kernels_.solve_perturbation(memory_.block);
    for_each_lane(due, [&](std::size_t l) { lanes_[l].measure_noise(); });
}

/// Decides about the time steps of the lanes that need the error or whose iterations diverged, and accepts those with an allowed error.
/// `a`: see SolveCall.
void Batch::decide_steps(std::uint8_t needs_error, std::uint8_t diverged, const LaneRow& a) {
    if ((needs_error | diverged) == 0) return;
    kernels_.evaluate_charges(memory_.block);
    estimate_errors(needs_error, [](const ChipLane&) { return true; }, [](const ChipLane& s) { return s.order(); }, error_);
    lanes::AcceptCall accept{{}, a};
    std::uint8_t accepted = 0, change_order = 0;
    for_each_lane(static_cast<std::uint8_t>(needs_error | diverged), [&](std::size_t l) {
        const auto status = lanes_[l].decide_step(contains(diverged, l) ? std::numeric_limits<double>::infinity() : error_[l]);
        if (status == ChipLane::StepStatus::failed) return fail(l);
        if (status != ChipLane::StepStatus::accepted) return;
        accepted |= bit(l), accept.is_accepted.value[l] = 1;
        if (lanes_[l].is_order_change_due()) change_order |= bit(l);
    });
    if (accepted == 0) return;
    estimate_errors(
        change_order, [](const ChipLane& s) { return s.can_lower_order(); }, [](const ChipLane& s) { return s.order() - 1; }, lower_);
    estimate_errors(
        change_order, [](const ChipLane& s) { return s.can_raise_order(); }, [](const ChipLane& s) { return s.order() + 1; }, higher_);
    measure_noise(accepted);
    kernels_.accept(memory_.block, accept);
    for_each_lane(accepted, [&](std::size_t l) {
        lanes_[l].choose_step(error_[l], lower_[l], higher_[l]);
        if (!lanes_[l].accept_step()) finish(l);
    });
}

Result<void> Batch::run() {
    for (std::size_t l = 0; l < lanes_.size(); ++l) fill(l);
    for (;;) {
        if (options_.should_stop && options_.should_stop()) return interrupted_error();
        lanes::SolveCall solve{};
        lanes::StepCall step{};
        const auto working = prepare(solve, step);
        if (working == 0) return {};
        memory_.relinearize(kernels_, working, gmin_);
        for_each_lane(working, [&](std::size_t l) { lanes_[l].relinearize_nonlinear_devices(); });
        kernels_.solve(memory_.block, solve);
        iterate(working, solve, step);
    }
}

/// The change of a terminal voltage, V, at which a transistor is linearized again. The relative error of the linearized current is then at
/// most (radius / (n phi_t))^2 / 2, as for an error of radius^2 / (2 n phi_t) of the gate voltage. With n = 1, this is a sixteenth of the
/// allowed error of a voltage of 0.5 V.
double linearization_radius(const TransientPlan& plan) {
    constexpr double phi_t = 0.026, fraction = 1.0 / 16;
    return std::sqrt(2 * phi_t * fraction * (plan.reltol * 0.5 + plan.vntol));
}

/// Simulates all chips by the scalar code, for circuits that lanes cannot simulate.
Result<void> run_all_scalar(const std::function<std::optional<Chip>()>& next,
                            const std::function<void(const Chip&, ChipResponse&&)>& on_done, const BatchOptions& options) {
    while (const auto chip = next()) {
        auto response = run_chip_scalar(*chip, options);
        if (response.error && response.error->code == ErrorCode::interrupted) return *response.error;
        response.is_scalar = true;
        on_done(*chip, std::move(response));
    }
    return {};
}

}  // namespace

Result<void> run_chips(const std::shared_ptr<const CircuitAfferentFactory>& nominal, const std::function<std::optional<Chip>()>& next_chip,
                       const std::function<void(const Chip&, ChipResponse&&)>& on_done, const BatchOptions& options) {
    const auto next = [&]() -> std::optional<Chip> {
        for (;;) {
            auto chip = next_chip();
            if (!chip || !chip->force.empty()) return chip;
            ChipResponse response;
            response.error = bad_input("the force has no samples");
            on_done(*chip, std::move(response));
        }
    };
    const auto kernels = TRY(chip_kernels());
    auto simulation = TRY(StreamingTransient::make(*nominal, 1e-4, {}));  // its sample time does not matter here
    const auto& system = simulation->context().system;
    const auto* list = simulation->transient().elimination();
    if (list == nullptr || system.groups().empty() || !system.devices_with_states().empty() || nominal->plan.method != Integration::bdf)
        return run_all_scalar(next, on_done, options);
    return Batch(*kernels, system, *list, linearization_radius(nominal->plan),
                 static_cast<std::size_t>(std::max(nominal->plan.max_order + 1, StepControl::max_curve_points)),
                 simulation->context().tolerances.gmin, next, on_done, options)
        .run();
}

}  // namespace corpuscle::circuit
