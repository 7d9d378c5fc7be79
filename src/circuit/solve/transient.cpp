#include "circuit/solve/transient.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "circuit/solve/bend.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double told_apart = 1e-12;          // of time: what two points are apart, right after a corner
constexpr double shortest_part = 1e-15;       // of the whole: no step is shorter
constexpr double far_off = 20, hopeless = 2;  // allowed units: of a first iteration that is looked at, of its error

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

/// A step so short that no charge moves: what no charge holds finds its place.
Result<void> Transient::settle() {
    const double at_once = 1e-15 * plan_.longest;
    auto now = past_[0];
    for (std::size_t n = 0; n < now.q.size(); ++n) history_[n] = -now.q[n] / at_once;
    equations_.prepare(0, 1 / at_once, history_);
    const auto allowed = std::exchange(allowed_, std::vector<double>(now.x.size(), plan_.vntol));
    auto way = StepEquations::Way::on;
    for (int k = 0; k < 100 && way != StepEquations::Way::arrived; ++k) {
        if (k % 10 == 9) equations_.prepare(0, 1 / at_once, history_);  // where it goes on is a new beginning
        way = equations_.iterate(now.x, allowed_);
    }
    allowed_ = allowed;
    if (way != StepEquations::Way::arrived) {
        past_.next() = std::move(now);
        return too_short(at_once);
    }
    past_.clear();
    past_.next() = std::move(now);
    past_.accept();
    allow();
    return {};
}

/// Only the newest point counts from now on; dq/dt there is what the currents leave. Its charge stays what came of the steps before, or
/// (`exact`) becomes that of its x: what Newton's last step left over would be a large current in a first step that is short.
void Transient::start_over(bool forget, bool exact) {
    Moment& now = past_.newest();
    equations_.at(now.t, now.x, rate_, error_);
    if (exact) now.q = error_;
    for (double& r : rate_) r = -r;
    past_.start_over(forget);
    pace_.start_over();
}

void Transient::allow() {
    constexpr double of_largest = 1e-9;  // what a current may err, of the largest of all
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
    volts_ = 1;  // V: a junction's charge is a difference of parts as large as at its potential
    for (std::size_t n = 0; n < allowed_.size(); ++n) {
        largest_charge_ = std::max(largest_charge_, std::abs(past_[0].q[n]));
        fastest_charge_ = std::max(fastest_charge_, std::abs(rate_[n]));
        if (system_.is_voltage(static_cast<int>(n))) volts_ = std::max(volts_, scale_[n]);
        if (!system_.is_voltage(static_cast<int>(n))) may_err_[n] += of_largest * largest;
    }
    // Between nodes of much the same voltage, little of it is left.
    largest_charge_ = std::max(largest_charge_, *std::max_element(capacity_.begin(), capacity_.end()) * volts_);
}

/// Solves the step to t; the answer is past_.next(). One whose error will be far too large is left at once.
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
    const bool to_the_end = plan_.all_reported && past_.count() == 1;  // what rounding leaves in a first step is known only there
    for (;;) {
        using Way = StepEquations::Way;
        const auto way = equations_.iterate(next.x, allowed_);
        if (way == Way::lost) return false;
        const bool far = way == Way::on && equations_.step_size() > far_off && !to_the_end;  // is it worth to go on?
        if (way == Way::on && !far) continue;
        equations_.charges(next.q);
        arrived_ = way == Way::arrived;
        error = error_of(pace_.order);
        if (way == Way::arrived || error > hopeless) return true;
    }
}

double Transient::worst_error() {
    equations_.answer_to(error_);
    constexpr double passing = 2;      // allowed units: an error without a charge is not handed on to the next step
    constexpr double adding_up = 1.5;  // times what an afferent's charges err: many steps' errors are to be within ten allowed ones
    double worst = 0;
    others_ = 0;
    for (std::size_t n = 0; n < error_.size(); ++n)
        if (charged_[n] && allowed_[n] > 0) worst = std::max(worst, std::abs(error_[n]) / (allowed_[n] + rounding_[n]));
    if (plan_.all_reported) worst *= adding_up;
    if (!plan_.all_reported || plan_.method != Integration::bdf) return worst;
    for (std::size_t n = 0; n < error_.size(); ++n)
        if (!charged_[n] && may_err_[n] > 0)
            others_ = std::max(others_, std::abs(error_[n]) / (passing * (may_err_[n] + noise(static_cast<int>(n)))));
    return jump_ ? worst : std::max(worst, others_);
}

/// Rounding error of a current in a step as short as this one, from its charges and times. Of a voltage: as measured, else 0.
double Transient::noise(int unknown) const {
    const double measured = rounding_[static_cast<std::size_t>(unknown)];
    if (system_.is_voltage(unknown)) return measured;
    return std::max(measured, std::abs(leading_) * (1e-14 * largest_charge_ + 1e-15 * past_[0].t * fastest_charge_));
}

/// Before a step is refused: the error that rounding of the charges makes in each unknown. It grows as the step gets shorter, most in nodes
/// that are connected by capacitors alone.
void Transient::measure_rounding(double& error, double& off) {
    constexpr double digit = 1e-15;
    if (!arrived_ || !plan_.all_reported || std::max(error, off) <= 1) return;
    for (std::size_t n = 0; n < rounding_.size(); ++n) rounding_[n] = digit * std::abs(leading_) * capacity_[n] * volts_;
    equations_.answer_to(rounding_);
    rounding_measured_ = true;
    for (double& r : rounding_) r = std::abs(r);
    error = error_of(pace_.order), off = bend();
}

/// How far the curve in the step just solved is off half way, of what it may be; it goes through as many points as make that least.
/// The first step after a corner has no third point to tell.
double Transient::bend() {
    constexpr double falling = 3;    // times less, at least, than a degree takes away is what the next one does
    constexpr double written = 2.2;  // times as exact as what is only looked at: straight lines between points err, too
    curve_ = 0;
    if (curves_.empty()) return 0;
    const auto& next = past_.next();
    std::array<double, Past::most + 1> times{next.t};
    const auto before = past_.times();
    std::copy(before.begin(), before.end(), times.begin() + 1);
    std::array<const double*, Past::most + 1> x{next.x.data()};
    for (int k = 0; k < past_.seen(); ++k) x[static_cast<std::size_t>(k) + 1] = past_[k].x.data();
    auto& may = error_;
    for (const int u : curves_) may[static_cast<std::size_t>(u)] = may_err_[static_cast<std::size_t>(u)] + noise(u);
    const auto worst_of = [&](const PastWeights& w, int points) {
        double worst = 0;
        for (const int u : curves_) {
            const auto n = static_cast<std::size_t>(u);
            double sum = w[0] * x[0][n];
            for (std::size_t k = 1; k <= static_cast<std::size_t>(points); ++k) sum += w[k] * x[k][n];
            worst = std::max(worst, std::abs(sum) / may[n]);
        }
        return worst;
    };
    const auto curve = least_bend(times, past_.seen(), worst_of);
    curve_ = curve.points;
    if (!plan_.all_reported) return curve.off;
    // That one degree more changes little may be chance: the one after it must change still less.
    const int more = curve.points + 1;
    if (more > past_.seen()) return written * curve.off;
    const auto weights = weights_of_bend(std::span(times).first(static_cast<std::size_t>(more) + 1));
    return written * std::max(curve.off, falling * worst_of(weights, more) / StepControl::curved);
}

/// Of the step just solved, had it been of this order, in units of what is allowed. Infinity: too few points to tell.
double Transient::error_of(int order) {
    constexpr double far_back = 1.2;  // step lengths a point: a history that reaches further says less of what is new in this step
    const auto& next = past_.next();
    const double h = next.t - past_[0].t;
    if (past_.count() == 1) {
        for (std::size_t n = 0; n < error_.size(); ++n) error_[n] = (next.q[n] - past_[0].q[n]) / h - rate_[n];
        return worst_error();
    }
    const int points = std::min(order + 1, past_.count());
    past_.sum(past_.value(next.t, points), points, &Moment::q, error_);
    double per = 1 / (next.t - past_[points - 1].t);
    if (plan_.all_reported) per = std::max(per, 1 / (far_back * points * h));
    if (trapezoid() && points == 3) per *= h / (next.t - past_[1].t);
    for (std::size_t n = 0; n < error_.size(); ++n) error_[n] = (next.q[n] - error_[n]) * per;
    return worst_error();
}

/// The order and length of the next step, after one of this length and error.
void Transient::choose(double h, double error) {
    const int points = past_.count(), highest = std::min(trapezoid() ? 2 : plan_.order, points - 1);
    if (!trapezoid()) return pace_.choose(h, error, points, highest, [this](int order) { return error_of(order); });
    const double most = StepControl::growth(error, pace_.order);
    pace_.order = std::max(1, highest);
    pace_.stretch(h, most, points);
}

/// The step was too long, or its equations were not solved (error 0).
Result<void> Transient::shorten(double h, double error) {
    constexpr int patient = 3;  // attempts, before a start of order 1, which gives currents poorly
    ++work_.rejected;
    if (error == 0) ++work_.lost;
    if (pace_.shorten(h, error, past_.count() > 1 ? past_[0].t - past_[1].t : 0, plan_.all_reported ? patient : 1))
        start_over(false, plan_.all_reported);
    if (pace_.h >= shortest_part * plan_.stop) return {};
    return too_short(pace_.h);
}

Error Transient::too_short(double h) {
    return {Code::not_converged,
            fmt::format("at {} no step is short enough ({}); {}", format_quantity(time(), "s"), format_quantity(h, "s"),
                        newton_.distance(past_.next().x)),
            Place{system_.circuit().file}};
}

/// Whether some charge's rate, on top of its course, goes to and fro step by step, as nothing of that pace does.
void Transient::watch() {
    constexpr int enough = 3;
    constexpr double visible = 1e-2;  // of the fastest so far
    bool rings = false;
    for (std::size_t n = 0; n < rate_.size(); ++n) {
        const double before = std::exchange(turn_[n], leading_ * past_.next().q[n] + history_[n] - rate_[n]);
        fastest_[n] = std::max(fastest_[n], std::abs(rate_[n]));
        const bool back = turn_[n] * before < 0 && std::abs(turn_[n]) > 0.5 * std::abs(before);
        alternations_[n] = back && std::abs(turn_[n]) > visible * fastest_[n] ? alternations_[n] + 1 : 0;
        rings |= allowed_[n] > 0 && alternations_[n] >= enough;
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

/// Right after a corner: a point so soon that no charge has moved, where what has none stands after its jump.
bool Transient::open(double t0, double corner, double& t) {
    // Of the next step. The shorter, the more of a node that only capacitors hold is lost to rounding: no more than the tolerance allows.
    const double at_once = 1e-8 * std::clamp(1e-5 / plan_.reltol, 1.0, 10.0);
    if (opening_ != Opening::at_once) return false;
    opening_ = Opening::first;
    start_over(true, true);
    t = t0 + at_once * std::min({pace_.h, plan_.longest, corner - t0});
    double error = 0;
    jump_ = true;
    if (t - t0 < told_apart * t0 || !attempt(t, error) || !(error <= 1)) return false;
    curve_ = 2;
    take();
    return bent_ = true;
}

Result<bool> Transient::step(double until) {
    constexpr double first_part = 1.0 / 256;  // of a step after a corner, the first: nothing tells yet how much bends
    // An error that stays however short a first step is: it is of the point where it begins, which rounding has put a little aside.
    constexpr double no_better = 0.9;
    constexpr int enough = 3;
    if (std::exchange(bent_, false)) start_over(true, plan_.all_reported);
    double rejected = 0;  // of the last attempt: its error
    int alike = 0;        // how many in a row were no better for being shorter
    for (;;) {
        const double t0 = time(), corner = std::min(plan_.stop, system_.next_corner(t0));
        double h = std::min(pace_.h, plan_.longest), soon = 0;
        if (until < plan_.stop && t0 + 2.1 * h > until) return false;
        if (open(t0, corner, soon)) return true;
        if (std::exchange(opening_, Opening::none) == Opening::first) h = std::max(first_part * std::min(h, corner - t0), told_apart * t0);
        const bool last = t0 + 1.01 * h >= corner;
        if (!last && t0 + 2 * h > corner) h = (corner - t0) / 2;
        const double t = last ? corner : t0 + h;
        double error = 0;
        jump_ = !curves_.empty() && t - t0 <= pace_.jump(plan_.reltol, plan_.longest);
        const bool found = attempt(t, error);
        work_.iterations = equations_.iterations;
        double off = found ? bend() : 0;
        if (found) measure_rounding(error, off);
        const double worst = jump_ ? error : std::max(error, off);
        alike =
            found && arrived_ && plan_.all_reported && past_.count() == 1 && worst > no_better * rejected && rejected > 0 ? alike + 1 : 0;
        rejected = found ? worst : 0;
        if (!found || (!(worst <= 1) && alike < enough)) {
            if (auto ok = shorten(t - t0, found ? worst : 0); !ok) return ok.error();
            continue;
        }
        const bool jumped = jump_ && (others_ > 1 || off > 1);
        const double wanted = pace_.h;
        choose(t - t0, error);
        if (!jump_) pace_.hold(t - t0, off, curve_);
        if (last && t - t0 < wanted) pace_.h = std::max(pace_.h, std::min(wanted, plan_.longest));
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
