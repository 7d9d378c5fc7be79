#include "circuit/solve/transient.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "circuit/solve/bend.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_relative_gap = 1e-12;   // minimum distance of the first point after a breakpoint, relative to the time
constexpr double min_relative_step = 1e-15;  // minimum step, relative to the end time
// Relative to the allowed error: if a Newton step is larger than the first value, the error is estimated early; above the second value the
// step is rejected without further iterations.
constexpr double large_newton_step = 20, hopeless_error = 2;

}  // namespace

Result<void> Transient::begin(std::vector<double> x, bool settled, std::span<const double> charge) {
    plan_.longest = std::min(plan_.longest, system_.pace());
    const auto count = x.size();
    for (auto* v : {&scale_, &allowed_, &may_err_, &rounding_, &history_, &rate_, &error_, &turn_, &fastest_}) v->assign(count, 0);
    newton_.memory = system_.fresh_memory();
    newton_.instant.charges = true, newton_.instant.time = 0;
    system_.eval(x, newton_.instant, newton_.memory, newton_.sums);
    work_ = {}, equations_.iterations = 0, equations_.set_bend(1);
    alternations_.assign(count, 0), calming_ = 0, charged_.assign(count, 0);
    for (std::size_t n = 0; n < count; ++n)
        charged_[n] = newton_.sums.C[system_.pattern().place(static_cast<int>(n), static_cast<int>(n))] != 0;
    capacity_.assign(count, 0);
    const auto& pattern = system_.pattern();
    for (std::size_t column = 0; column < count; ++column)
        for (int e = pattern.begin()[column]; e < pattern.begin()[column + 1]; ++e)
            capacity_[static_cast<std::size_t>(pattern.rows()[static_cast<std::size_t>(e)])] +=
                std::abs(newton_.sums.C[static_cast<std::size_t>(e)]);
    find_held();
    past_.clear();
    auto& first = past_.next();
    first.t = 0, first.x = std::move(x), first.q.assign(count, 0);
    past_.accept();
    pace_.h = plan_.longest, pace_.calm = 0, bent_ = false;
    curve_ = 0, opening_ = plan_.all_reported ? Opening::at_once : Opening::none;
    equations_.at(0, past_[0].x, rate_, first.q);
    for (std::size_t n = 0; n < charge.size(); ++n) first.q[n] += charge[n];
    start_over(true);
    allow();
    if (!std::exchange(ordered_, true)) equations_.settle(past_[0].x, 1e3 / plan_.longest);
    if (settled) return {};
    auto ok = settle();
    start_over(true);
    return ok;
}

/// Computes the unknowns without charge by a step so short that no charge changes.
Result<void> Transient::settle() {
    const double h = 1e-15 * plan_.longest;
    auto now = past_[0];
    for (std::size_t n = 0; n < now.q.size(); ++n) history_[n] = -now.q[n] / h;
    equations_.prepare(0, 1 / h, history_);
    const auto allowed = std::exchange(allowed_, std::vector<double>(now.x.size(), plan_.vntol));
    auto status = StepEquations::Way::on;
    for (int k = 0; k < 100 && status != StepEquations::Way::arrived; ++k) {
        if (k % 10 == 9) equations_.prepare(0, 1 / h, history_);  // resets the iteration count
        status = equations_.iterate(now.x, allowed_);
    }
    allowed_ = allowed;
    if (status != StepEquations::Way::arrived) {
        past_.next() = std::move(now);
        return too_short(h);
    }
    past_.clear();
    past_.next() = std::move(now);
    past_.accept();
    allow();
    return {};
}

/// Integration continues from the newest point only; dq/dt there follows from the currents. With `exact`, the charge is recomputed from x.
/// Otherwise it keeps the value of the last step, whose small residual would be a large current in a short first step.
void Transient::start_over(bool forget, bool exact) {
    Moment& now = past_.newest();
    equations_.at(now.t, now.x, rate_, error_);
    if (exact) now.q = error_;
    for (double& r : rate_) r = -r;
    past_.start_over(forget);
    pace_.start_over();
}

void Transient::allow() {
    constexpr double of_largest = 1e-9;  // allowed error of a current, relative to the largest current
    double largest = 0;
    for (std::size_t n = 0; n < allowed_.size(); ++n) {
        const bool voltage = system_.is_voltage(static_cast<int>(n));
        scale_[n] = std::max(scale_[n], std::abs(past_[0].x[n]));
        may_err_[n] = plan_.reltol * scale_[n] + (voltage ? plan_.vntol : plan_.abstol);
        if (charged_[n] || (plan_.all_reported && voltage)) allowed_[n] = may_err_[n];
        if (!voltage) largest = std::max(largest, scale_[n]);
        if (!voltage && !plan_.all_reported) may_err_[n] *= Bend::current_may;
    }
    if (!plan_.all_reported) return;
    largest_charge_ = fastest_charge_ = 0;
    volts_ = 1;  // V: the charge of a junction is a difference of terms as large as at its built-in potential
    for (std::size_t n = 0; n < allowed_.size(); ++n) {
        largest_charge_ = std::max(largest_charge_, std::abs(past_[0].q[n]));
        fastest_charge_ = std::max(fastest_charge_, std::abs(rate_[n]));
        if (system_.is_voltage(static_cast<int>(n))) volts_ = std::max(volts_, scale_[n]);
        if (!system_.is_voltage(static_cast<int>(n))) may_err_[n] += of_largest * largest;
    }
    // A capacitor between nodes of similar voltage has a small charge, but the rounding error of its terminals' voltages.
    largest_charge_ = std::max(largest_charge_, *std::max_element(capacity_.begin(), capacity_.end()) * volts_);
}

/// Solves the step to t; the solution is history_points_.next_point(). Stops early if the error will be far too large. Returns false if the
/// iterations diverged.
bool Transient::attempt(double t, double& error) {
    const double h = t - past_[0].t;
    auto& next = past_.next();
    const auto count = scale_.size();
    next.t = t, next.x.resize(count), next.q.resize(count);
    const int points = std::min(pace_.order + 1, past_.count());
    past_.sum(past_.value(t, points), points, &Moment::x, next.x);
    if (trapezoid() && past_.count() > 1) {
        leading_ = 2 / h;
        for (std::size_t n = 0; n < count; ++n) history_[n] = -leading_ * past_[0].q[n] - rate_[n];
    } else {
        const auto weights = past_.slope(t, pace_.order, leading_);
        past_.sum(weights, pace_.order, &Moment::q, history_);
    }
    if (rounding_measured_) std::fill(rounding_.begin(), rounding_.end(), 0.0), rounding_measured_ = false;
    equations_.prepare(t, leading_, history_);
    equations_.check_formulas(!jump_, {plan_.reltol, plan_.vntol, plan_.abstol});
    const bool must_converge = plan_.all_reported && past_.count() == 1;  // rounding_error() of a first step needs the solution
    for (;;) {
        using Status = StepEquations::Way;
        const auto status = equations_.iterate(next.x, allowed_);
        if (status == Status::lost) return false;
        const bool far =
            status == Status::on && equations_.step_size() > large_newton_step && !must_converge;  // check whether to stop early
        if (status == Status::on && !far) continue;
        equations_.charges(next.q);
        arrived_ = status == Status::arrived;
        error = error_of(pace_.order);
        if (status == Status::arrived || error > hopeless_error) return true;
    }
}

double Transient::worst_error() {
    equations_.answer_to(error_);
    constexpr double uncharged_factor = 2;  // factor of the allowed error without charge, where the error does not reach the next step
    constexpr double sum_factor =
        1.5;  // stricter than in an afferent, so that the errors of many steps add up to less than ten allowed ones
    double worst = 0;
    others_ = 0;
    for (std::size_t n = 0; n < error_.size(); ++n)
        if (charged_[n] && allowed_[n] > 0) worst = std::max(worst, std::abs(error_[n]) / (allowed_[n] + rounding_[n]));
    if (plan_.all_reported) worst *= sum_factor;
    if (!plan_.all_reported || plan_.method != Integration::bdf) return worst;
    for (std::size_t n = 0; n < error_.size(); ++n)
        if (!charged_[n] && may_err_[n] > 0)
            others_ = std::max(others_, std::abs(error_[n]) / (uncharged_factor * (may_err_[n] + noise(static_cast<int>(n)))));
    return jump_ ? worst : std::max(worst, others_);
}

/// Rounding error of a current, from the charges and the step length. For a voltage: as measured by measure_rounding(), otherwise 0.
double Transient::noise(int unknown) const {
    const double measured = rounding_[static_cast<std::size_t>(unknown)];
    if (system_.is_voltage(unknown)) return measured;
    return std::max(measured, std::abs(leading_) * (1e-14 * largest_charge_ + 1e-15 * past_[0].t * fastest_charge_));
}

/// Before a step is rejected: computes the error of each unknown from the rounding of the charges, and adds it to the tolerances. This
/// error grows as the step gets shorter, most at nodes that are connected only to capacitors.
void Transient::measure_rounding(double& error, double& curve_error) {
    constexpr double roundoff = 1e-15;
    if (!arrived_ || !plan_.all_reported || std::max(error, curve_error) <= 1) return;
    for (std::size_t n = 0; n < rounding_.size(); ++n) rounding_[n] = roundoff * std::abs(leading_) * capacity_[n] * volts_;
    equations_.answer_to(rounding_);
    rounding_measured_ = true;
    for (double& r : rounding_) r = std::abs(r);
    error = error_of(pace_.order), curve_error = bend();
}

/// The interpolation error at the middle of the step just solved, relative to the allowed error. Uses the number of points with the
/// smallest error. The first step after a breakpoint has no third point for an estimate.
double Transient::bend() {
    constexpr double convergence_ratio = 3;  // each higher degree must change the curve at least this many times less
    constexpr double output_factor = 2.2;    // stricter than in an afferent, since users draw straight lines between the points
    curve_ = 0;
    if (curves_.empty()) return 0;
    const auto& next = past_.next();
    std::array<double, Past::most + 1> times{next.t};
    const auto before = past_.times();
    std::copy(before.begin(), before.end(), times.begin() + 1);
    std::array<const double*, Past::most + 1> x{next.x.data()};
    for (int k = 0; k < past_.seen(); ++k) x[static_cast<std::size_t>(k) + 1] = past_[k].x.data();
    auto& tolerance = error_;
    for (const int u : curves_) tolerance[static_cast<std::size_t>(u)] = may_err_[static_cast<std::size_t>(u)] + noise(u);
    const auto worst_of = [&](const PastWeights& w, int points) {
        double worst = 0;
        for (const int u : curves_) {
            const auto n = static_cast<std::size_t>(u);
            double sum = w[0] * x[0][n];
            for (std::size_t k = 1; k <= static_cast<std::size_t>(points); ++k) sum += w[k] * x[k][n];
            worst = std::max(worst, std::abs(sum) / tolerance[n]);
        }
        return worst;
    };
    const auto curve = least_bend(times, past_.seen(), worst_of);
    curve_ = curve.points;
    if (!plan_.all_reported) return curve.off;
    // A small change with one more degree may be coincidence, so the next degree is checked as well.
    const int more = curve.points + 1;
    if (more > past_.seen()) return output_factor * curve.off;
    const auto weights = weights_of_bend(std::span(times).first(static_cast<std::size_t>(more) + 1));
    return output_factor * std::max(curve.off, convergence_ratio * worst_of(weights, more) / StepControl::curved);
}

/// The error that the step just solved would have with this order, relative to the allowed error.
double Transient::error_of(int order) {
    constexpr double max_spacing = 1.2;  // step lengths per point: a longer history underestimates the error of this step
    const auto& next = past_.next();
    const double h = next.t - past_[0].t;
    if (past_.count() == 1) {
        for (std::size_t n = 0; n < error_.size(); ++n) error_[n] = (next.q[n] - past_[0].q[n]) / h - rate_[n];
        return worst_error();
    }
    const int points = std::min(order + 1, past_.count());
    past_.sum(past_.value(next.t, points), points, &Moment::q, error_);
    double scale = 1 / (next.t - past_[points - 1].t);
    if (plan_.all_reported) scale = std::max(scale, 1 / (max_spacing * points * h));
    if (trapezoid() && points == 3) scale *= h / (next.t - past_[1].t);
    for (std::size_t n = 0; n < error_.size(); ++n) error_[n] = (next.q[n] - error_[n]) * scale;
    return worst_error();
}

/// Chooses the order and length of the next step after a step of this length and error.
void Transient::choose(double h, double error) {
    const int points = past_.count(), highest = std::min(trapezoid() ? 2 : plan_.order, points - 1);
    if (!trapezoid()) return pace_.choose(h, error, points, highest, [this](int order) { return error_of(order); });
    const double factor = StepControl::growth(error, pace_.order);
    pace_.order = std::max(1, highest);
    pace_.stretch(h, factor, points);
}

/// Shortens the step after a rejection. error 0: its equations were not solved.
Result<void> Transient::shorten(double h, double error) {
    constexpr int max_failures = 3;  // before a restart with order 1, which gives inaccurate currents
    ++work_.rejected;
    if (error == 0) ++work_.lost;
    if (pace_.shorten(h, error, past_.count() > 1 ? past_[0].t - past_[1].t : 0, plan_.all_reported ? max_failures : 1))
        start_over(false, plan_.all_reported);
    if (pace_.h >= min_relative_step * plan_.stop) return {};
    return too_short(pace_.h);
}

Error Transient::too_short(double h) {
    return {ErrorCode::not_converged,
            fmt::format("transient stopped at {}: the step became too short ({}); {}", format_quantity(time(), "s"),
                        format_quantity(h, "s"), newton_.distance(past_.next().x)),
            SourceLocation{system_.circuit().file}};
}

/// Detects ringing of the trapezoidal rule: the change of some dq/dt alternates in sign from step to step.
void Transient::watch() {
    constexpr int min_alternations = 3;
    constexpr double visible = 1e-2;  // relative to the largest rate so far
    bool rings = false;
    for (std::size_t n = 0; n < rate_.size(); ++n) {
        const double before = std::exchange(turn_[n], leading_ * past_.next().q[n] + history_[n] - rate_[n]);
        fastest_[n] = std::max(fastest_[n], std::abs(rate_[n]));
        const bool reversed = turn_[n] * before < 0 && std::abs(turn_[n]) > 0.5 * std::abs(before);
        alternations_[n] = reversed && std::abs(turn_[n]) > visible * fastest_[n] ? alternations_[n] + 1 : 0;
        rings |= allowed_[n] > 0 && alternations_[n] >= min_alternations;
    }
    if (calming_ > 0) --calming_;
    if (!rings) return;
    calming_ = 2, pace_.order = std::min(2, past_.count());
    std::fill(alternations_.begin(), alternations_.end(), 0);
}

void Transient::take() {
    const auto& next = past_.next();
    if (plan_.method == Integration::trapezoidal) watch();
    for (std::size_t n = 0; n < rate_.size(); ++n) rate_[n] = leading_ * next.q[n] + history_[n];
    pace_.took(next.t - past_[0].t);
    past_.accept();
    allow();
    ++work_.steps, ++pace_.since_choice, pace_.failures = 0;
}

/// Takes a step right after a breakpoint, so short that no charge changes. It gives the values of unknowns without charge after their jump.
bool Transient::open(double t0, double breakpoint, double& t) {
    // Relative to the next step. A shorter step has more rounding error at nodes with only capacitors; the tolerance limits that error.
    const double fraction = 1e-8 * std::clamp(1e-5 / plan_.reltol, 1.0, 10.0);
    if (opening_ != Opening::at_once) return false;
    opening_ = Opening::first;
    start_over(true, true);
    t = t0 + fraction * std::min({pace_.h, plan_.longest, breakpoint - t0});
    double error = 0;
    jump_ = true;
    if (t - t0 < min_relative_gap * t0 || !attempt(t, error) || !(error <= 1)) return false;
    curve_ = 2;
    take();
    return bent_ = true;
}

Result<bool> Transient::step(double until) {
    constexpr double first_part = 1.0 / 256;  // length of the first step after a breakpoint, where the curvature is not known
    // An error that does not fall as the first step is shortened comes from rounding of the point where it starts. After three such
    // attempts the step is accepted.
    constexpr double no_better = 0.9;
    constexpr int max_alike = 3;
    if (std::exchange(bent_, false)) start_over(true, plan_.all_reported);
    double rejected = 0;  // error of the last attempt
    int alike = 0;        // number of successive attempts with no smaller error
    for (;;) {
        const double t0 = time(), breakpoint = std::min(plan_.stop, system_.next_corner(t0));
        double h = std::min(pace_.h, plan_.longest), after = 0;
        if (until < plan_.stop && t0 + 2.1 * h > until) return false;
        if (open(t0, breakpoint, after)) return true;
        if (std::exchange(opening_, Opening::none) == Opening::first)
            h = std::max(first_part * std::min(h, breakpoint - t0), min_relative_gap * t0);
        const bool last = t0 + 1.01 * h >= breakpoint;
        if (!last && t0 + 2 * h > breakpoint) h = (breakpoint - t0) / 2;
        const double t = last ? breakpoint : t0 + h;
        double error = 0;
        jump_ = !curves_.empty() && t - t0 <= pace_.jump(plan_.reltol, plan_.longest);
        const bool found = attempt(t, error);
        work_.iterations = equations_.iterations;
        double curve_error = found ? bend() : 0;
        if (found) measure_rounding(error, curve_error);
        const double worst = jump_ ? error : std::max(error, curve_error);
        alike =
            found && arrived_ && plan_.all_reported && past_.count() == 1 && worst > no_better * rejected && rejected > 0 ? alike + 1 : 0;
        rejected = found ? worst : 0;
        if (!found || (!(worst <= 1) && alike < max_alike)) {
            if (auto ok = shorten(t - t0, found ? worst : 0); !ok) return ok.error();
            continue;
        }
        const bool jumped = jump_ && (others_ > 1 || curve_error > 1);
        const double planned = pace_.h;
        choose(t - t0, error);
        if (!jump_) pace_.hold(t - t0, curve_error, curve_);
        if (last && t - t0 < planned) pace_.h = std::max(pace_.h, std::min(planned, plan_.longest));
        if (jumped) curve_ = 2;
        take();
        bent_ = last || jumped;
        if (last && plan_.all_reported) opening_ = Opening::at_once;
        return true;
    }
}

TransientState Transient::save() const {
    TransientState s;
    for (int k = 0; k < past_.seen(); ++k) s.past.push_back(past_[k]);
    s.order = pace_.order, s.since_choice = pace_.since_choice, s.failures = pace_.failures, s.calming = calming_,
    s.starting = pace_.starting, s.bent = bent_;
    s.count = past_.count(), s.curve = curve_, s.opening = static_cast<int>(opening_), s.calm = pace_.calm;
    s.h = pace_.h, s.bend = equations_.bend(), s.work = work_;
    s.scale = scale_, s.rate = rate_, s.turn = turn_, s.fastest = fastest_, s.alternations = alternations_, s.memory = newton_.memory;
    return s;
}

void Transient::restore(const TransientState& s) {
    past_.clear();
    for (auto point = s.past.rbegin(); point != s.past.rend(); ++point) past_.next() = *point, past_.accept();
    past_.count_only(s.count);
    curve_ = s.curve, opening_ = static_cast<Opening>(s.opening), pace_.calm = s.calm;
    pace_.order = s.order, pace_.since_choice = s.since_choice, pace_.failures = s.failures, calming_ = s.calming,
    pace_.starting = s.starting, bent_ = s.bent;
    pace_.h = s.h, equations_.set_bend(s.bend), work_ = s.work, equations_.iterations = s.work.iterations;
    scale_ = s.scale, rate_ = s.rate, turn_ = s.turn, fastest_ = s.fastest, alternations_ = s.alternations, newton_.memory = s.memory;
    allow();
}

Result<void> Transient::run(std::vector<double> x, bool settled, const Each& each, std::span<const double> charge) {
    auto done = begin(std::move(x), settled, charge);
    bool more = done && each(time(), this->x());
    while (more && time() < plan_.stop) {
        const auto stepped = step(plan_.stop);
        if (!stepped) done = stepped.error();
        more = stepped && tell(each);
    }
    newton_.instant.charges = false;
    return done;
}

}  // namespace corpuscle::circuit
