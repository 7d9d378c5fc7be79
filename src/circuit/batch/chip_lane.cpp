#include "circuit/batch/chip_lane.hpp"

namespace corpuscle::circuit {
namespace {

constexpr long rounds_between_sums = 256;  // see ChipMemory::sum_again()

}  // namespace

Result<bool> ChipLane::start(const Chip& chip, const BatchOptions& options) {
    options_ = &options, response_ = {};
    if (simulation_ && design_ == chip.design && T_ == chip.T && chip.sample) {
        simulation_->set_chip(*chip.sample);
    } else {
        auto simulation = TRY(StreamingTransient::make(*chip.design, chip.T, chip.sample));
        simulation_ = std::move(simulation), design_ = chip.design, T_ = chip.T;
    }
    if (!is_compatible()) return false;
    std::vector<double> force(chip.force.begin(), chip.force.end());
    // The force stays constant after its last sample, so that all breakpoints before it are known.
    force.insert(force.end(), static_cast<std::size_t>(2 * ForceWaveform::lookahead + 2), force.back());
    TRY(simulation_->begin(force));
    chip_ = chip;

    auto& context = simulation_->context();
    const auto& start = simulation_->transient();  // at the initial condition
    plan_ = start.plan();
    control_ = {}, newton_ = {}, restart_pending_ = false, next_task_ = NextTask::nothing, rounds_ = 0;
    control_.min_order = start.control().min_order;
    noise_ = simulation_->noise(), charges_shifted_ = false;
    noise_charge_.resize(memory_.unknowns()), node_noise_.assign(memory_.unknowns(), {}), last_noise_charge_.assign(memory_.unknowns(), 0),
        floor_.resize(memory_.unknowns());
    control_.h = start.control().h, times_ = {}, points_ = smooth_count_ = 1, newest_slot_ = curve_points_ = 0, breakpoint_ = -1,
    jumped_ = false;
    end_time_ = static_cast<double>(chip_->force.size() - 1) * chip_->T;
    const EvalContext eval_context{0, 1, context.tolerances.gmin, true};
    memory_.load_chip(lane_, context.system, eval_context);
    auto& b = memory_.block;
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        for (std::size_t s = 0; s < b.points; ++s)
            b.past_x[s * b.unknowns + n].value[lane_] = b.past_q[s * b.unknowns + n].value[lane_] = 0;
        b.past_x[n].value[lane_] = b.x[n].value[lane_] = start.x()[n], b.past_q[n].value[lane_] = start.history()[0].q[n];
        b.rate[n].value[lane_] = start.rate()[n], b.scale[n].value[lane_] = start.scale()[n];
        const bool charged = start.has_charge(n), voltage = b.is_voltage[n] != 0;
        const double relative = charged ? plan_.reltol : 0, floor = !charged ? 0 : voltage ? plan_.vntol : plan_.abstol;
        const double allowed = relative * start.scale()[n] + floor;
        b.relative[n].value[lane_] = relative, b.floor[n].value[lane_] = floor_[n] = floor;
        b.inverse_allowed[n].value[lane_] = allowed > 0 ? 1 / allowed : 0;
    }
    sources_.clear();
    for (const auto k : context.system.scalar_devices())
        if (const auto& d = *context.system.devices()[k]; d.is_linear() && d.is_time_dependent()) sources_.push_back(k);
    x_ = start.history()[0].x;
    energy_ = {simulation_->meter().delivered_at(x_, 0)};
    response_.range_violations.resize(chip_->design->operating_ranges.size());
    if (options.probe_every > 0) response_.probes.resize(chip_->design->probes.size());
    next_sample_ = 0;
    record_samples();
    return true;
}

bool ChipLane::is_compatible() const {
    const auto& plan = simulation_->transient().plan();
    return memory_.is_compatible(simulation_->context().system) && plan.method == Integration::bdf &&
           static_cast<std::size_t>(plan.max_order) < memory_.block.points;
}

ChipResponse ChipLane::finish() {
    chip_.reset();
    next_task_ = NextTask::nothing;
    response_.energy_use = energy_.sum;
    return std::move(response_);
}

/// Writes f of the time-dependent sources at time t and x = 0 to the block's source_currents.
void ChipLane::set_sources(double t) {
    const auto& system = simulation_->context().system;
    EvalContext eval_context{t, 1, simulation_->context().tolerances.gmin, true};
    for (const auto k : sources_)
        for (const int u : system.devices()[k]->unknowns)
            if (u >= 0) memory_.block.source_currents[u].value[lane_] = 0;
    for (const auto k : sources_) {
        const Device& d = *system.devices()[k];
        v_.assign(d.unknowns.size(), 0);
        const auto f = stamp_.eval(d, v_, eval_context).f;
        for (std::size_t row = 0; row < f.size(); ++row)
            if (d.unknowns[row] >= 0) memory_.block.source_currents[d.unknowns[row]].value[lane_] += f[row];
    }
}

/// Chooses the end of the next step and its predictor, as Transient::step() and attempt() do.
void ChipLane::start_step() {
    const double now = times_[0];
    if (!(now < breakpoint_)) breakpoint_ = std::min(plan_.stop, simulation_->context().system.next_breakpoint(now));
    step_ = StepControl::plan_step(now, std::min(control_.h, plan_.max_step), breakpoint_,
                                   noise_ != nullptr ? noise_->next_sample(now) : breakpoint_);
    may_jump_ = !simulation_->transient().interpolated_unknowns().empty() &&
                step_.length() <= control_.jump_step_limit(plan_.reltol, plan_.max_step);
    if (noise_ != nullptr) shift_charges();
    predictor_weights_ = weights_of_value(times(std::min(control_.order + 1, points_)), step_.end);
    newton_.begin();
    is_new_step_ = true;
}

/// As Transient::shift_charges().
void ChipLane::shift_charges() {
    double a = 0;
    const auto weights = weights_of_slope(times(control_.order), step_.end, a);
    noise_->charges(step_.from, step_.end, noise_charge_);
    for (std::size_t n = 0; n < noise_charge_.size(); ++n)
        noise_charge_[n] =
            node_noise_[n].charge(noise_charge_[n], last_noise_charge_[n], step_.length(), a, control_.order > 1 ? weights[1] : 0);
    for (int k = 0; k < points_; ++k)
        for (std::size_t n = 0; n < noise_charge_.size(); ++n)
            memory_.block.past_q[history_slot(k) * memory_.unknowns() + n].value[lane_] -= noise_charge_[n];
    charges_shifted_ = true;
}

void ChipLane::undo_charge_shift() {
    if (!std::exchange(charges_shifted_, false)) return;
    for (int k = 0; k < points_; ++k)
        for (std::size_t n = 0; n < noise_charge_.size(); ++n)
            memory_.block.past_q[history_slot(k) * memory_.unknowns() + n].value[lane_] += noise_charge_[n];
}

ChipLane::NextTask ChipLane::prepare(lanes::PredictCall& call, std::span<lanes::LaneRow> value_weights,
                                     std::span<lanes::LaneRow> slope_weights, lanes::SolveCall& solve, lanes::StepCall& step) {
    is_new_step_ = false;
    if (!is_occupied()) return next_task_ = NextTask::nothing;
    if (next_task_ == NextTask::restart) {  // evaluate at the newest point, without dq/dt
        a_ = 0;
        set_sources(times_[0]);
        for (std::size_t n = 0; n < memory_.unknowns(); ++n)
            memory_.block.x[n].value[lane_] = past(memory_.block.past_x, 0, n), memory_.block.history[n].value[lane_] = 0;
    } else if (next_task_ == NextTask::nothing) {
        start_step();
        set_sources(step_.end);
        const auto weights = weights_of_slope(times(control_.order), step_.end, a_);
        for (int k = 0; k < points_; ++k)
            value_weights[history_slot(k)].value[lane_] = predictor_weights_[static_cast<std::size_t>(k)],
            slope_weights[history_slot(k)].value[lane_] = weights[static_cast<std::size_t>(k)];
        for (int k = points_; k < static_cast<int>(memory_.block.points); ++k)
            value_weights[history_slot(k)].value[lane_] = slope_weights[history_slot(k)].value[lane_] = 0;
        next_task_ = NextTask::iterate;
    }
    call.is_new_step.value[lane_] = is_new_step_;
    solve.a.value[lane_] = a_;
    step.updates_x.value[lane_] = next_task_ == NextTask::iterate;
    return next_task_;
}

void ChipLane::relinearize_nonlinear_devices() {
    if (++rounds_ % rounds_between_sums == 0) memory_.sum_again(lane_);
    auto& context = simulation_->context();
    is_limited_ = memory_.relinearize_nonlinear_devices(
        lane_, context.system, {next_task_ == NextTask::restart ? times_[0] : step_.end, 1, context.tolerances.gmin, true},
        context.newton.limiting_state);
}

ChipLane::IterationStatus ChipLane::finish_iteration(double size, bool is_clamped, bool is_finite) {
    if (next_task_ == NextTask::restart) {  // with a = 0 and no history, the residual is f(x) = -dq/dt
        for (std::size_t n = 0; n < memory_.unknowns(); ++n) memory_.block.rate[n].value[lane_] = -memory_.block.r[n].value[lane_];
        points_ = 1;
        if (restart_pending_) smooth_count_ = 1;
        control_.restart();
        next_task_ = NextTask::nothing;
        return IterationStatus::iterating;
    }
    ++response_.stats.iterations;
    status_ = NewtonControl::Status::diverged;
    if (!is_finite || !std::isfinite(size)) return IterationStatus::failed;
    status_ = newton_.update(size, is_limited_ || is_clamped);
    if (status_ == NewtonControl::Status::converged && !may_jump_) {
        auto& context = simulation_->context();
        if (!memory_.expressions_match(lane_, context.system, {step_.end, 1, context.tolerances.gmin, true},
                                       {plan_.reltol, plan_.vntol, plan_.abstol}))
            status_ = newton_.continue_iterating();
    }
    if (status_ == NewtonControl::Status::diverged) return IterationStatus::failed;
    return newton_.needs_error(status_) ? IterationStatus::needs_error : IterationStatus::iterating;
}

void ChipLane::set_error_weights(int order, lanes::ErrorCall& call, std::span<lanes::LaneRow> past_weights) const {
    for (auto& row : past_weights) row.value[lane_] = 0;
    if (points_ == 1) {
        const double per_step = 1 / (step_.end - times_[0]);  // 1/s
        call.charge_weight.value[lane_] = per_step, past_weights[history_slot(0)].value[lane_] = -per_step;
        call.rate_weight.value[lane_] = -1;
        return;
    }
    const int points = std::min(order + 1, points_);
    const auto weights = order == control_.order ? predictor_weights_ : weights_of_value(times(points), step_.end);
    const double per_history = 1 / (step_.end - times_[static_cast<std::size_t>(points) - 1]);  // 1/s
    call.charge_weight.value[lane_] = per_history, call.rate_weight.value[lane_] = 0;
    for (int k = 0; k < points; ++k) past_weights[history_slot(k)].value[lane_] = -per_history * weights[static_cast<std::size_t>(k)];
}

/// The same estimate as Transient::interpolation_error().
double ChipLane::interpolation_error() {
    const auto interpolated_unknowns = simulation_->transient().interpolated_unknowns();
    curve_points_ = noise_ != nullptr ? 2 : 0;
    if (noise_ != nullptr || interpolated_unknowns.empty()) return 0;
    auto& b = memory_.block;
    std::array<double, 9> times{step_.end};
    std::copy(times_.begin(), times_.end(), times.begin() + 1);
    std::array<const lanes::LaneRow*, StepControl::max_curve_points + 1> rows{b.x};
    for (int k = 0; k < StepControl::max_curve_points; ++k) rows[static_cast<std::size_t>(k) + 1] = b.past_x + history_slot(k) * b.unknowns;
    const auto curve = best_interpolant(times, smooth_count_, [&](const HistoryWeights& w, int points) {
        double worst = 0;
        for (const int n : interpolated_unknowns) {
            double sum = 0;
            for (std::size_t k = 0; k <= static_cast<std::size_t>(points); ++k) sum += w[k] * rows[k][n].value[lane_];
            const double tolerance = plan_.reltol * b.scale[n].value[lane_] + (b.is_voltage[n] ? plan_.vntol : plan_.abstol);
            worst = std::max(worst, std::abs(sum) / (b.is_voltage[n] ? tolerance : Interpolant::current_tolerance_factor * tolerance));
        }
        return worst;
    });
    curve_points_ = curve.points;
    return curve.error;
}

ChipLane::StepStatus ChipLane::decide_step(double error) {
    const bool diverged = std::isinf(error);
    if (!diverged && NewtonControl::must_continue(status_, error)) return StepStatus::iterating;
    interpolation_error_ = diverged ? 0 : interpolation_error();
    const double worst = may_jump_ ? error : std::max(error, interpolation_error_);
    jumped_ = !diverged && worst <= 1 && interpolation_error_ > 1;
    if (!diverged && worst <= 1) return StepStatus::accepted;
    ++response_.stats.rejected;
    if (diverged) ++response_.stats.diverged;
    next_task_ = NextTask::nothing, restart_pending_ = false;
    undo_charge_shift();
    if (control_.shorten(step_.length(), diverged ? 0 : worst, points_ > 1 ? times_[0] - times_[1] : 0)) next_task_ = NextTask::restart;
    return control_.h >= StepControl::min_step(plan_.stop) ? StepStatus::rejected : StepStatus::failed;
}

void ChipLane::write_noise() {
    for (std::size_t n = 0; n < noise_charge_.size(); ++n) memory_.block.error[n].value[lane_] = a_ * noise_charge_[n];
}

/// As Transient::measure_noise().
void ChipLane::measure_noise() {
    auto& b = memory_.block;
    for (std::size_t n = 0; n < noise_charge_.size(); ++n) {
        const auto entry = memory_.diagonal(n);
        const double capacitive = a_ * b.C[entry].value[lane_];
        node_noise_[n].measure(b.error[n].value[lane_], capacitive, b.G[entry].value[lane_] + capacitive);
        if (floor_[n] > 0) b.floor[n].value[lane_] = floor_[n] + node_noise_[n].allowed_error();
    }
}

void ChipLane::choose_step(double error, double lower, double higher) {
    const double planned = control_.h;
    const int order = control_.order;
    control_.choose(step_.length(), error, points_, std::min(plan_.max_order, points_ - 1),
                    [&](int other) { return other < order ? lower : higher; });
    control_.limit_next_step(step_, planned, plan_.max_step, may_jump_, interpolation_error_, curve_points_);
    if (jumped_) curve_points_ = 2;
}

/// Makes the end of the step the newest point.
void ChipLane::advance() {
    auto& b = memory_.block;
    const int capacity = static_cast<int>(b.points);
    control_.record_step(step_.length());
    newest_slot_ = (newest_slot_ + capacity - 1) % capacity, points_ = std::min(points_ + 1, capacity),
    smooth_count_ = std::min(smooth_count_ + 1, capacity);
    std::copy_backward(times_.begin(), times_.end() - 1, times_.end());
    times_[0] = step_.end;
    const auto first = static_cast<std::size_t>(newest_slot_) * b.unknowns;
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        x_[n] = b.past_x[first + n].value[lane_] = b.x[n].value[lane_];
        b.past_q[first + n].value[lane_] = b.q[n].value[lane_];
    }
    charges_shifted_ = false;
    if (noise_ != nullptr) last_noise_charge_ = noise_charge_, noise_->update(x_);
    restart_pending_ = step_.ends_at_breakpoint || jumped_;
    ++response_.stats.steps;
    next_task_ = restart_pending_ ? NextTask::restart : NextTask::nothing;
}

bool ChipLane::accept_step() {
    const double step_start = times_[0];
    advance();
    energy_.add(simulation_->meter(), x_, step_start, times_[0]);
    // A spike after the last sample is dropped.
    if (const auto at = spike(); at && std::ceil(*at / chip_->T) < static_cast<double>(chip_->force.size()))
        response_.spikes.push_back(*at);
    record_samples();
    response_.hit_iteration_limit = options_->max_iterations > 0 && response_.stats.iterations > options_->max_iterations;
    return !response_.hit_iteration_limit && times_[0] < end_time_;
}

/// As Transient::interpolate().
double ChipLane::interpolate(double t, int unknown) const {
    if (unknown < 0) return 0;
    if (const auto source = simulation_->transient().source_voltage(t, unknown)) return *source;
    const int points = control_.interpolation_points(curve_points_, points_);
    const auto w = weights_of_value(times(points), t);
    double sum = 0;
    for (int k = 0; k < points; ++k)
        sum += w[static_cast<std::size_t>(k)] * past(memory_.block.past_x, k, static_cast<std::size_t>(unknown));
    return sum;
}

/// The time of a spike within the last step; nothing if there is none.
std::optional<double> ChipLane::spike() const {
    const auto& o = chip_->design->spike_output;
    const auto [plus, minus] = o.quantity.unknowns;
    const auto u = [&](int k, int unknown) { return unknown < 0 ? 0 : past(memory_.block.past_x, k, static_cast<std::size_t>(unknown)); };
    const double sign = o.is_rising ? 1 : -1;
    const auto beyond = [&, plus = plus, minus = minus](int k) { return sign * (u(k, plus) - u(k, minus) - o.level); };
    const auto at = [&, plus = plus, minus = minus](double t) { return sign * (interpolate(t, plus) - interpolate(t, minus) - o.level); };
    return find_crossing(times_[1], times_[0], beyond(1), beyond(0), at);
}

/// For all samples in the last step: records the probes and checks the operating ranges.
void ChipLane::record_samples() {
    const auto& design = *chip_->design;
    const auto every = static_cast<std::int64_t>(options_->probe_every), count = static_cast<std::int64_t>(chip_->force.size());
    if (design.operating_ranges.empty() && every == 0) return;
    const auto& system = simulation_->context().system;
    for (; next_sample_ < count && static_cast<double>(next_sample_) * chip_->T <= times_[0]; ++next_sample_) {
        const double t = static_cast<double>(next_sample_) * chip_->T;
        const auto value = [&](int u) {
            return next_sample_ > 0 ? interpolate(t, u) : u < 0 ? 0 : past(memory_.block.past_x, 0, static_cast<std::size_t>(u));
        };
        check_ranges(design.operating_ranges, response_.range_violations, next_sample_,
                     [&](const SavedQuantity& quantity) { return quantity.value(system, value); });
        for (std::size_t p = 0; every > 0 && next_sample_ % every == 0 && p < design.probes.size(); ++p)
            response_.probes[p].push_back(static_cast<float>(design.probes[p].value(system, value)));
    }
}

}  // namespace corpuscle::circuit
