#include "circuit/solve/transient.hpp"

#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_relative_gap = 1e-12;  // minimum distance of the first point after a breakpoint, relative to the breakpoint's time

constexpr double after_shortest = 1e-3;  // the step after one of the shortest length, relative to the longest of the recent ones

constexpr int max_shortest_steps = 3;  // successive steps of the shortest length that are accepted with any error

}  // namespace

Result<void> Transient::begin(std::vector<double> x, bool settled, std::span<const double> charge) {
    plan_.max_step = std::min(plan_.max_step, system_.max_step());
    const auto count = x.size();
    for (auto* v :
         {&scale_, &allowed_error_, &tolerance_, &rounding_, &charge_rounding_, &history_, &rate_, &error_, &rate_change_, &max_rate_})
        v->assign(count, 0);
    newton_.limiting_state = system_.initial_limiting_state();
    newton_.context.with_charges = true, newton_.context.time = 0;
    system_.eval(x, newton_.context, newton_.limiting_state, newton_.evaluation);
    stats_ = {}, order_limit_ = {}, equations_.iterations = 0, equations_.newton_control().quadratic_factor = 1;
    alternations_.assign(count, 0), damping_steps_ = 0, has_charge_.assign(count, 0), own_capacitance_.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
        own_capacitance_[n] = newton_.evaluation.C[system_.pattern().entry_index(static_cast<int>(n), static_cast<int>(n))];
        has_charge_[n] = own_capacitance_[n] != 0;
    }
    capacitance_.assign(count, 0);  // sum of the magnitudes in each row of C
    system_.pattern().for_each_entry(
        [&](std::size_t e, std::size_t row, std::size_t) { capacitance_[row] += std::abs(newton_.evaluation.C[e]); });
    find_source_nodes();
    history_points_.clear();
    auto& first = history_points_.next_point();
    first.t = 0, first.x = std::move(x), first.q.assign(count, 0);
    history_points_.accept();
    shifted_charge_.clear(), noise_charge_.resize(count), node_noise_.assign(count, {});
    last_noise_charge_.assign(count, 0);
    if (noise_) noise_->begin(history_points_[0].x, plan_.noise.stream);
    control_.h = plan_.max_step, control_.recent_max_step = 0, restart_pending_ = false;
    last_change_ = 0, changes_at_once_ = 0;
    curve_points_ = 0, start_phase_ = plan_.all_reported ? StartPhase::breakpoint : StartPhase::none;
    equations_.evaluate_static(0, history_points_[0].x, rate_, first.q);
    for (std::size_t n = 0; n < charge.size(); ++n) first.q[n] += charge[n];
    restart(true);
    update_tolerances();
    // The matrix is that of a step of a thousandth of the longest step.
    if (!std::exchange(pivot_order_fixed_, true)) equations_.fix_pivot_order(history_points_[0].x, 1e3 / plan_.max_step);
    if (settled) return {};
    auto ok = make_consistent();
    restart(true);
    return ok;
}

/// The unknowns at the newest point after a step of length h (s) with its charges. Nothing if the equations could not be solved.
std::optional<std::vector<double>> Transient::solve_with_charges_kept(double h) {
    auto x = history_points_[0].x;
    const auto& q = history_points_[0].q;
    for (std::size_t n = 0; n < q.size(); ++n) history_[n] = -q[n] / h;
    equations_.prepare(time(), 1 / h, history_);
    const std::vector<double> allowed(x.size(), plan_.vntol);
    auto status = StepEquations::Status::iterating;
    for (int k = 0; k < 100 && status != StepEquations::Status::converged; ++k) {
        if (k % 10 == 9) equations_.prepare(time(), 1 / h, history_);  // resets the iteration count
        status = equations_.iterate(x, allowed);
    }
    auto& next = history_points_.next_point();  // for the residual in a message
    next = history_points_[0], next.x = x;
    return status == StepEquations::Status::converged ? std::optional(std::move(x)) : std::nullopt;
}

/// True if the difference of two solutions is well below the allowed error.
bool Transient::are_close(std::span<const double> a, std::span<const double> b) const {
    constexpr double fraction = 0.1;
    double current = 0;  // A: the largest
    for (std::size_t n = 0; n < a.size(); ++n)
        if (!system_.is_voltage(static_cast<int>(n))) current = std::max(current, std::abs(a[n]));
    for (std::size_t n = 0; n < a.size(); ++n) {
        const bool voltage = system_.is_voltage(static_cast<int>(n));
        const double allowed = voltage ? plan_.reltol * std::abs(a[n]) + plan_.vntol : plan_.reltol * current + plan_.abstol;
        if (!(std::abs(a[n] - b[n]) <= fraction * allowed)) return false;
    }
    return true;
}

/// Computes the unknowns without charge at the newest point from the charges: the limit of a short step, extrapolated from two lengths. The
/// lengths fall until the limit no longer changes. The shortest ones have rounding errors, at nodes that are connected by capacitors only.
Result<void> Transient::make_consistent() {
    constexpr double longest = 1e-4, shortest = 1e-15, factor = 10;  // relative to the longest step; between two lengths
    std::optional<std::vector<double>> found, last, last_limit;
    double h = longest * plan_.max_step;
    for (; !found && h > shortest * plan_.max_step; h /= factor) {
        auto x = solve_with_charges_kept(h);
        auto limit = x && last ? x : std::nullopt;
        for (std::size_t n = 0; limit && n < limit->size(); ++n) (*limit)[n] += ((*x)[n] - (*last)[n]) / (factor - 1);
        if (limit && last_limit && are_close(*limit, *last_limit)) found = limit;
        last = std::move(x), last_limit = std::move(limit);
    }
    if (!found) found = std::move(last);
    if (!found) return step_too_short(h, 1 / h, "");
    auto point = history_points_[0];
    point.x = std::move(*found);
    history_points_.clear();
    history_points_.next_point() = std::move(point);
    history_points_.accept();
    update_tolerances();
    return {};
}

/// Integration continues from the newest point only; dq/dt there follows from the currents. With `exact`, the charge is computed from x
/// again. Without, it keeps the value of the last step, which differs by the residual of that step. In a very short first step this small
/// difference would be a large current.
void Transient::restart(bool forget, bool exact) {
    undo_charge_shift();
    TimePoint& point = history_points_[0];
    equations_.evaluate_static(point.t, point.x, rate_, error_);
    if (exact) point.q = error_;
    for (double& r : rate_) r = -r;
    history_points_.restart(forget);
    control_.restart();
}

/// Subtracts the noise charge from the newest point to t from the charges of all points, so that those of a step to t continue them.
void Transient::shift_charges(double t) {
    undo_charge_shift();
    const auto weights = history_points_.slope_weights(t, control_.order, leading_);
    noise_->charges(time(), t, noise_charge_);
    for (std::size_t n = 0; n < noise_charge_.size(); ++n)
        noise_charge_[n] =
            node_noise_[n].charge(noise_charge_[n], last_noise_charge_[n], t - time(), leading_, control_.order > 1 ? weights[1] : 0);
    history_points_.add_to_charges(noise_charge_, -1);
    shifted_charge_ = noise_charge_;
}

/// Measures the change of the unknowns that the noise of the last step has caused.
void Transient::measure_noise() {
    for (std::size_t n = 0; n < error_.size(); ++n) error_[n] = leading_ * noise_charge_[n];
    equations_.solve_perturbation(error_);
    for (std::size_t n = 0; n < error_.size(); ++n)
        node_noise_[n].measure(error_[n], leading_ * own_capacitance_[n], equations_.diagonal(n));
}

void Transient::undo_charge_shift() {
    if (!shifted_charge_.empty()) history_points_.add_to_charges(shifted_charge_, 1);
    shifted_charge_.clear();
}

/// Updates scale_, allowed_error_, tolerance_ and the scales of the rounding error from the newest point.
void Transient::update_tolerances() {
    constexpr double of_largest = 1e-9;  // part of the allowed error of a current, relative to the largest current in the circuit
    double largest = 0;                  // A
    for (std::size_t n = 0; n < allowed_error_.size(); ++n) {
        const bool voltage = system_.is_voltage(static_cast<int>(n));
        scale_[n] = std::max(scale_[n], std::abs(history_points_[0].x[n]));
        tolerance_[n] = plan_.reltol * scale_[n] + (voltage ? plan_.vntol : plan_.abstol);
        if (noise_) tolerance_[n] += node_noise_[n].allowed_error();
        if (has_charge_[n] || (plan_.all_reported && voltage)) allowed_error_[n] = tolerance_[n];
        if (!voltage) largest = std::max(largest, scale_[n]);
        if (!voltage && !plan_.all_reported) tolerance_[n] *= Interpolant::current_tolerance_factor;
    }
    if (!plan_.all_reported) return;
    voltage_scale_ = 1;  // V: at least this, since the charge of a junction is a difference of terms as large as at its built-in potential
    for (std::size_t n = 0; n < allowed_error_.size(); ++n) {
        if (system_.is_voltage(static_cast<int>(n))) voltage_scale_ = std::max(voltage_scale_, scale_[n]);
        if (!system_.is_voltage(static_cast<int>(n))) tolerance_[n] += of_largest * largest;
    }
}

/// Solves the step to t; the solution is history_points_.next_point(). `error` becomes its error, relative to the allowed error. Stops
/// before convergence if this error will be far too large. Returns false if the iterations diverged.
bool Transient::attempt(double t, double& error) {
    const double h = t - history_points_[0].t;
    if (noise_) shift_charges(t);
    auto& next = history_points_.next_point();
    const auto count = scale_.size();
    next.t = t, next.x.resize(count), next.q.resize(count);
    const int points = std::min(control_.order + 1, history_points_.count());
    history_points_.combine(history_points_.value_weights(t, points), points, &TimePoint::x, next.x);
    if (uses_trapezoidal() && history_points_.count() > 1) {
        leading_ = 2 / h;
        for (std::size_t n = 0; n < count; ++n) history_[n] = -leading_ * history_points_[0].q[n] - rate_[n];
    } else {
        const auto weights = history_points_.slope_weights(t, control_.order, leading_);
        history_points_.combine(weights, control_.order, &TimePoint::q, history_);
    }
    // The rounding error of a charge is a current that grows as the step gets shorter.
    for (std::size_t n = 0; n < count; ++n) rounding_[n] = charge_rounding_[n] * std::abs(leading_);
    equations_.prepare(t, leading_, history_);
    equations_.check_expressions(!may_jump_, {plan_.reltol, plan_.vntol, plan_.abstol});
    // The rounding error of a first step is measured for its error, which needs the converged solution.
    const bool must_converge = (plan_.all_reported && history_points_.count() == 1) || is_shortest(h);
    for (;;) {
        using Status = StepEquations::Status;
        const auto status = equations_.iterate(next.x, allowed_error_);
        if (status == Status::diverged) return false;
        if (must_converge ? status == Status::iterating : !equations_.newton_control().needs_error(status)) continue;
        equations_.read_charges(next.q);
        converged_ = status == Status::converged;
        error = error_of(control_.order);
        if (!NewtonControl::must_continue(status, error)) return true;
    }
}

/// Chooses the order and length of the next step after an accepted step of this length (s) and error.
void Transient::choose_step(double h, double error) {
    constexpr double least_reltol = 1e-7;  // order 2 would take too many steps
    const bool limits_order = plan_.all_reported && !uses_trapezoidal() && plan_.reltol >= least_reltol;
    const int max_order = limits_order ? order_limit_.highest(plan_.max_order) : plan_.max_order;
    const int points = history_points_.count(), highest = std::min(uses_trapezoidal() ? 2 : max_order, points - 1);
    if (limits_order) {
        order_limit_.add_step(h, control_.order);
        control_.order = std::min(control_.order, max_order);
    }
    if (!uses_trapezoidal()) return control_.choose(h, error, points, highest, [this](int order) { return error_of(order); });
    const double factor = StepControl::growth_factor(error, control_.order);
    control_.order = std::max(1, highest);
    control_.scale_step(h, factor, points);
}

/// Shortens the step after a rejection of one of length h (s). An `error` of 0 means that the equations of the step were not solved.
Result<void> Transient::reject_step(double h, double error) {
    constexpr int max_failures = 3;  // more rejections lead to a restart with order 1, whose first currents are inaccurate
    ++stats_.rejected;
    if (error == 0) ++stats_.diverged;
    if (control_.shorten(h, error, history_points_.count() > 1 ? history_points_[0].t - history_points_[1].t : 0,
                         plan_.all_reported ? max_failures : 1))
        restart(false, plan_.all_reported);
    const double shortest = StepControl::min_step(plan_.stop);
    if (control_.h >= shortest) return {};
    if (error > 0 && h > shortest && shortest_steps_ < max_shortest_steps) return control_.h = shortest, Result<void>();
    return step_too_short(control_.h, leading_, error > 0 ? describe_error() : "");
}

/// Names the unknown whose error in the step just solved is largest, relative to the allowed error.
std::string Transient::describe_error() {
    error_of(control_.order);
    std::size_t worst = 0;
    for (std::size_t n = 1; n < error_.size(); ++n)
        if (std::abs(error_[n]) * tolerance_[worst] > std::abs(error_[worst]) * tolerance_[n]) worst = n;
    return fmt::format("{} has the largest error: {}, {:.2g} times the allowed one", system_.names()[worst],
                       format_quantity(std::abs(error_[worst]), system_.is_voltage(static_cast<int>(worst)) ? "V" : "A"),
                       std::abs(error_[worst]) / tolerance_[worst]);
}

/// `h`: length of the step, s. The equations of the last step are those of dq/dt = a q + history_. `reason`: "" if they could not be
/// solved.
Error Transient::step_too_short(double h, double a, std::string reason) {
    if (reason.empty()) reason = newton_.describe_residual(history_points_.next_point().x, a, history_);
    return {ErrorCode::not_converged,
            fmt::format("transient stopped at {}: the step became too short ({}); {}", format_quantity(time(), "s"),
                        format_quantity(h, "s"), reason),
            SourceLocation{system_.circuit().file}};
}

/// Detects ringing of the trapezoidal rule: the change of some dq/dt alternates in sign from step to step.
void Transient::detect_ringing() {
    constexpr int min_alternations = 3;
    constexpr double visible = 1e-2;  // smallest change of dq/dt that counts, relative to the largest dq/dt so far
    bool rings = false;
    for (std::size_t n = 0; n < rate_.size(); ++n) {
        const double before = std::exchange(rate_change_[n], leading_ * history_points_.next_point().q[n] + history_[n] - rate_[n]);
        max_rate_[n] = std::max(max_rate_[n], std::abs(rate_[n]));
        const bool reversed = rate_change_[n] * before < 0 && std::abs(rate_change_[n]) > 0.5 * std::abs(before);
        alternations_[n] = reversed && std::abs(rate_change_[n]) > visible * max_rate_[n] ? alternations_[n] + 1 : 0;
        rings |= allowed_error_[n] > 0 && alternations_[n] >= min_alternations;
    }
    if (damping_steps_ > 0) --damping_steps_;
    if (!rings) return;
    damping_steps_ = 2, control_.order = std::min(2, history_points_.count());
    std::fill(alternations_.begin(), alternations_.end(), 0);
}

/// Makes the solved step the newest point.
void Transient::accept_step() {
    const auto& next = history_points_.next_point();
    if (plan_.method == Integration::trapezoidal) detect_ringing();
    for (std::size_t n = 0; n < rate_.size(); ++n) rate_[n] = leading_ * next.q[n] + history_[n];
    control_.record_step(next.t - history_points_[0].t);
    history_points_.accept();
    if (noise_) {
        last_noise_charge_ = std::exchange(shifted_charge_, {});
        noise_->update(x());
        if (stats_.steps % TransientNoise::steps_per_measure == 0) measure_noise();
    }
    update_tolerances();
    ++stats_.steps;
}

/// Called when the first step after a breakpoint or a change of state became too short. The voltages of a capacitor with a resistance in
/// series jump there although their nodes have charge, and the estimated error does not fall with the length of the step. True if the point
/// just after the breakpoint has not been tried with any error; it will be then. Its charges hardly differ from those before.
bool Transient::must_accept_breakpoint_step() {
    if (accepts_breakpoint_step_ || !plan_.all_reported || history_points_.count() > 1) return false;
    accepts_breakpoint_step_ = true, start_phase_ = StartPhase::breakpoint;
    control_.h = std::max(control_.recent_max_step, after_shortest * plan_.max_step);
    return true;
}

/// If t0 is a breakpoint and all unknowns are reported, takes a step so short that no charge changes. It gives the values of unknowns
/// without charge after their jump. Returns false if there is no such step at t0, or if it failed.
bool Transient::take_breakpoint_step(double t0, double next_breakpoint) {
    // Length relative to the next step, longer for a small reltol: a shorter step has more rounding error at nodes with only capacitors.
    double fraction = 1e-8 * std::clamp(1e-5 / plan_.reltol, 1.0, 10.0);
    // Where the rounding error is still visible, as at an inductor whose current a source gives, the step is made longer.
    constexpr double longer = 30, longest = 1e-3;
    if (start_phase_ != StartPhase::breakpoint) return false;
    start_phase_ = StartPhase::first_step;
    restart(true, true);
    may_jump_ = true;
    for (;; fraction *= longer) {
        const double h = std::min({control_.h, plan_.max_step, next_breakpoint - t0}), gap = min_relative_gap * t0;
        double error = 0;
        if (gap > (accepts_breakpoint_step_ ? longest : fraction) * h) return false;
        const bool solved = attempt(t0 + std::max(fraction * h, gap), error);  // with a very short step, the matrix can be singular
        if (solved) measure_rounding();
        if (fraction < longest && (solved ? is_rounding_visible() : system_.is_linear() || accepts_breakpoint_step_)) continue;
        if (!solved || !(error <= 1 || error_of(control_.order) <= 1 || accepts_breakpoint_step_)) return false;
        break;
    }
    accepts_breakpoint_step_ = false;
    curve_points_ = 2;
    accept_step();
    return restart_pending_ = true;
}

Result<bool> Transient::step(double until) {
    constexpr double first_part = 1.0 / 256;  // (first step after a breakpoint) / (planned step): short, since the curvature is not known
    // If the error does not fall as the first step is shortened, it comes from the rounding of the start point. After three such attempts
    // the step is accepted.
    constexpr double min_reduction = 0.9;
    constexpr int max_not_reduced = 3;
    if (state_change_.is_needed()) TRY(change_states());
    if (std::exchange(restart_pending_, false)) restart(true, plan_.all_reported);
    if (state_change_.is_needed()) state_change_.begin(time(), x());
    double rejected = 0;  // error of the last attempt, relative to the allowed error; 0: none, or not solved
    int not_reduced = 0;  // number of successive attempts that did not reduce the error
    for (;;) {
        const double t0 = time(), breakpoint = std::min(plan_.stop, system_.next_breakpoint(t0));
        double h = std::min(control_.h, plan_.max_step);
        if (until < plan_.stop && t0 + 2.1 * h > until) return false;  // a breakpoint within 2 h changes the length of the step
        if (take_breakpoint_step(t0, breakpoint)) return true;
        if (std::exchange(start_phase_, StartPhase::none) == StartPhase::first_step)
            h = std::max(first_part * std::min(h, breakpoint - t0), min_relative_gap * t0);
        const double limit = std::min(breakpoint, state_change_.trial().value_or(breakpoint));
        const auto next = StepControl::plan_step(t0, h, limit, noise_ ? noise_->next_sample(t0) : limit);
        double error = 0;
        may_jump_ = !interpolated_unknowns_.empty() && next.length() <= control_.jump_step_limit(plan_.reltol, plan_.max_step);
        const bool solved = attempt(next.end, error);
        stats_.iterations = equations_.iterations;
        double curve_error = solved ? interpolation_error() : 0;
        if (solved) measure_rounding(error, curve_error);
        const double worst = may_jump_ ? error : std::max(error, curve_error);
        const bool is_first_step = converged_ && plan_.all_reported && history_points_.count() == 1;
        not_reduced = solved && is_first_step && worst > min_reduction * rejected && rejected > 0 ? not_reduced + 1 : 0;
        rejected = solved ? worst : 0;
        // A jump changes the rate of a charge at once. No step is short enough for a tolerance far below the later values of its unknown.
        const bool shortest = solved && converged_ && is_shortest(next.length());
        shortest_steps_ = shortest ? shortest_steps_ + 1 : 0;
        const bool accepts_error = not_reduced >= max_not_reduced || (shortest && shortest_steps_ <= max_shortest_steps);
        if (!solved || (!(worst <= 1) && !accepts_error)) {
            if (const auto ok = reject_step(next.length(), solved ? worst : 0); !ok) {
                if (!must_accept_breakpoint_step()) return ok.error();
                rejected = 0, not_reduced = 0;
            }
            if (state_change_.is_needed()) state_change_.begin(t0, x());
            continue;
        }
        if (state_change_.is_needed() && must_locate_change()) {
            rejected = 0, not_reduced = 0;
            continue;
        }
        const bool jumped = (may_jump_ && (uncharged_error_ > 1 || curve_error > 1)) || (shortest && worst > 1);
        const double planned = control_.h;
        choose_step(next.length(), error);
        control_.limit_next_step(next, planned, plan_.max_step, may_jump_, curve_error, curve_points_);
        if (shortest && worst > 1) control_.h = std::max(control_.h, after_shortest * control_.recent_max_step);
        if (jumped) curve_points_ = 2;
        accept_step();
        restart_pending_ = next.ends_at_breakpoint || jumped;
        if (next.ends_at_breakpoint && plan_.all_reported) start_phase_ = StartPhase::breakpoint;
        return true;
    }
}

void Transient::shift_origin(double t) {
    history_points_.shift_origin(t);
    if (noise_) noise_->shift_origin(t);
}

void Transient::archive(StateArchive& a) {
    constexpr double max_count = 1e9;
    int points = history_points_.smooth_count(), count = history_points_.count();
    a.integer(points, 1, History::max_points);
    a.integer(control_.order, 1, plan_.max_order), a.integer(control_.steps_since_order_change, 0, max_count);
    a.integer(control_.failures, 0, max_count), a.integer(damping_steps_, 0, 2), a.integer(control_.starting, 0, 1);
    a.integer(restart_pending_, 0, 1), a.integer(count, 1, points), a.integer(curve_points_, 0, points), a.integer(start_phase_, 0, 2);
    auto& quadratic_factor = equations_.newton_control().quadratic_factor;
    a.number(control_.h), a.number(quadratic_factor), a.number(control_.recent_max_step);
    for (long* n : {&stats_.steps, &stats_.rejected, &stats_.diverged, &stats_.iterations}) a.integer(*n, 0, max_exact_integer);
    equations_.iterations = stats_.iterations;
    history_points_.set_counts(count, points);
    const auto size = scale_.size();
    for (int k = 0; k < points; ++k) {
        auto& point = history_points_[k];
        a.number(point.t), a.numbers(point.x, size), a.numbers(point.q, size);
        a.is_valid &= std::abs(point.t) <= plan_.stop && (k == 0 || point.t < history_points_[k - 1].t);
    }
    for (auto* values : {&scale_, &rate_, &rate_change_, &max_rate_}) a.numbers(*values, size);
    a.numbers(newton_.limiting_state, newton_.limiting_state.size());
    for (int& n : alternations_) a.integer(n, 0, max_count);
    auto states = system_.states();
    for (char& state : states) a.integer(state, 0, 1);
    system_.set_states(states);
    if (noise_) {
        noise_->archive(a);
        a.numbers(last_noise_charge_, size);
        for (auto& node : node_noise_) node.archive(a);
    }
    a.is_valid &= control_.h > 0 && quadratic_factor > 0 && control_.recent_max_step >= 0;
    if (a.is_valid) update_tolerances();
}

Result<void> Transient::run(std::vector<double> x, bool settled, const PointCallback& each, std::span<const double> charge) {
    auto done = begin(std::move(x), settled, charge);
    bool more = done && each(time(), this->x());
    while (more && time() < plan_.stop) {
        const auto stepped = step(plan_.stop);
        if (!stepped) done = stepped.error();
        more = stepped && emit_points(each);
    }
    newton_.context.with_charges = false;
    return done;
}

}  // namespace corpuscle::circuit
