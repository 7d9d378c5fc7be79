#include "circuit/batch/seat.hpp"

#include <algorithm>
#include <cmath>

#include "circuit/solve/bend.hpp"
#include "circuit/solve/crossing.hpp"

namespace corpuscle::circuit {
namespace {

// As in transient.cpp.
constexpr double min_lane_step = 1e-15;  // relative to the end time
constexpr double large_lane_step = 20, hopeless_lane_error = 2;
constexpr long rounds_between_sums = 256;

}  // namespace

Result<bool> Seat::take(const Chip& chip, const BatchOptions& options) {
    options_ = &options, answer_ = {};
    if (rig_ && design_ == chip.design && T_ == chip.T && chip.draw) {
        rig_->set_chip(*chip.draw);
    } else {
        auto rig = StreamingTransient::make(*chip.design, chip.T, chip.draw);
        if (!rig) return rig.error();
        rig_ = std::move(*rig), design_ = chip.design, T_ = chip.T;
    }
    if (!can_be_held()) return false;
    std::vector<double> force(chip.force.begin(), chip.force.end());
    force.insert(force.end(), static_cast<std::size_t>(2 * ForceWaveform::lookahead + 2), force.back());
    if (auto ok = rig_->begin(force); !ok) return ok.error();
    chip_ = chip;

    auto& context = rig_->context();
    const auto start = rig_->transient().save();
    plan_ = rig_->transient().plan();
    pace_ = {}, newton_ = {}, bent_ = false, work_ = Work::nothing, looks_ = 0;
    pace_.h = start.h, times_ = {}, points_ = seen_ = 1, newest_ = curve_ = 0, corner_ = -1, jumped_ = false;
    end_ = static_cast<double>(chip_->force.size() - 1) * chip_->T;
    const Instant eval_context{0, 1, context.tolerances.gmin, true};
    memory_.seat(lane_, context.system, eval_context);
    context.newton.memory = start.memory;
    auto& b = memory_.block;
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        for (std::size_t s = 0; s < b.points; ++s) b.past_x[s * b.unknowns + n].of[lane_] = b.past_q[s * b.unknowns + n].of[lane_] = 0;
        b.past_x[n].of[lane_] = b.x[n].of[lane_] = start.past[0].x[n], b.past_q[n].of[lane_] = start.past[0].q[n];
        b.rate[n].of[lane_] = start.rate[n], b.scale[n].of[lane_] = start.scale[n];
        const bool charged = rig_->transient().charged(n), voltage = b.voltage[n] != 0;
        const double relative = charged ? plan_.reltol : 0, floor = !charged ? 0 : voltage ? plan_.vntol : plan_.abstol;
        const double allowed = relative * start.scale[n] + floor;
        b.relative[n].of[lane_] = relative, b.floor[n].of[lane_] = floor;
        b.per_allowed[n].of[lane_] = allowed > 0 ? 1 / allowed : 0;
    }
    sources_.clear();
    for (const auto k : context.system.alone())
        if (const auto& d = *context.system.devices()[k]; d.linear() && d.varies()) sources_.push_back(k);
    x_ = start.past[0].x;
    power_ = rig_->meter().delivered_at(x_, 0);
    answer_.outside.resize(chip_->design->operating_ranges.size());
    if (options.show_every > 0) answer_.shown.resize(chip_->design->probes.size());
    sample_ = 0;
    look_at_samples();
    return true;
}

bool Seat::can_be_held() const {
    const auto& plan = rig_->transient().plan();
    return memory_.fits(rig_->context().system) && plan.method == Integration::bdf &&
           static_cast<std::size_t>(plan.order) < memory_.block.points;
}

ChipAnswer Seat::leave() {
    chip_.reset();
    work_ = Work::nothing;
    return std::move(answer_);
}

/// Writes the currents of the time-dependent sources at t to the block's base.
void Seat::set_sources(double t) {
    const auto& system = rig_->context().system;
    Instant eval_context{t, 1, rig_->context().tolerances.gmin, true};
    for (const auto k : sources_)
        for (const int u : system.devices()[k]->unknowns)
            if (u >= 0) memory_.block.base[u].of[lane_] = 0;
    for (const auto k : sources_) {
        const Device& d = *system.devices()[k];
        const auto n = d.unknowns.size();
        v_.assign(n, 0), stamp_.assign(2 * n + 2 * n * n, 0);
        const std::span<double> all(stamp_);
        d.eval(v_, eval_context, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
        for (std::size_t row = 0; row < n; ++row)
            if (d.unknowns[row] >= 0) memory_.block.base[d.unknowns[row]].of[lane_] += stamp_[row];
    }
}

/// Chooses the end of the next step and its predictor, as Transient::step() and attempt() do.
void Seat::attempt() {
    const double now = times_[0];
    if (!(now < corner_)) corner_ = std::min(plan_.stop, rig_->context().system.next_corner(now));
    double h = std::min(pace_.h, plan_.longest);
    last_ = now + 1.01 * h >= corner_;
    if (!last_ && now + 2 * h > corner_) h = (corner_ - now) / 2;
    t_ = last_ ? corner_ : now + h;
    jump_ = !rig_->transient().curves().empty() && t_ - now <= pace_.jump(plan_.reltol, plan_.longest);
    value_ = weights_of_value(times(std::min(pace_.order + 1, points_)), t_);
    newton_.begin();
    begins_ = true;
}

Seat::Work Seat::prepare(lanes::PredictCall& call, std::span<lanes::Row> value, std::span<lanes::Row> slope, lanes::SolveCall& solve,
                         lanes::StepCall& step) {
    begins_ = false;
    if (!taken()) return work_ = Work::nothing;
    if (work_ == Work::restart) {  // at the last point, without history
        a_ = 0;
        set_sources(times_[0]);
        for (std::size_t n = 0; n < memory_.unknowns(); ++n)
            memory_.block.x[n].of[lane_] = past(memory_.block.past_x, 0, n), memory_.block.history[n].of[lane_] = 0;
    } else if (work_ == Work::nothing) {
        attempt();
        set_sources(t_);
        const auto weights = weights_of_slope(times(pace_.order), t_, a_);
        for (int k = 0; k < points_; ++k)
            value[ring(k)].of[lane_] = value_[static_cast<std::size_t>(k)], slope[ring(k)].of[lane_] = weights[static_cast<std::size_t>(k)];
        for (int k = points_; k < static_cast<int>(memory_.block.points); ++k) value[ring(k)].of[lane_] = slope[ring(k)].of[lane_] = 0;
        work_ = Work::iterate;
    }
    call.begins.of[lane_] = begins_;
    solve.a.of[lane_] = a_;
    step.moves.of[lane_] = work_ == Work::iterate;
    return work_;
}

void Seat::look_at_others() {
    if (++looks_ % rounds_between_sums == 0) memory_.freshen(lane_);
    auto& context = rig_->context();
    limited_ = memory_.look_at_others(lane_, context.system, {work_ == Work::restart ? times_[0] : t_, 1, context.tolerances.gmin, true},
                                      context.newton.memory);
}

Seat::Verdict Seat::iterated(double size, bool clamped, bool finite) {
    if (work_ == Work::restart) {
        for (std::size_t n = 0; n < memory_.unknowns(); ++n) memory_.block.rate[n].of[lane_] = -memory_.block.r[n].of[lane_];
        points_ = 1;
        if (bent_) seen_ = 1;
        pace_.start_over();
        work_ = Work::nothing;
        return Verdict::goes_on;
    }
    ++answer_.work.iterations;
    if (!finite || !std::isfinite(size)) {
        far_ = false;
        return Verdict::fails;
    }
    auto status = newton_.after(size, limited_ || clamped);
    if (status == NewtonControl::Way::arrived && !jump_) {
        auto& context = rig_->context();
        if (!memory_.formulas_hold(lane_, context.system, {t_, 1, context.tolerances.gmin, true},
                                   {plan_.reltol, plan_.vntol, plan_.abstol}))
            status = newton_.not_yet();
    }
    if (status == NewtonControl::Way::lost) return Verdict::fails;
    far_ = status == NewtonControl::Way::on;
    return !far_ || newton_.before > large_lane_step ? Verdict::wants_error : Verdict::goes_on;
}

void Seat::weigh(int order, lanes::ErrorCall& call, std::span<lanes::Row> of_past) const {
    for (auto& row : of_past) row.of[lane_] = 0;
    if (points_ == 1) {
        const double per = 1 / (t_ - times_[0]);
        call.of_q.of[lane_] = per, of_past[ring(0)].of[lane_] = -per, call.of_rate.of[lane_] = -1;
        return;
    }
    const int points = std::min(order + 1, points_);
    const auto weights = order == pace_.order ? value_ : weights_of_value(times(points), t_);
    const double per = 1 / (t_ - times_[static_cast<std::size_t>(points) - 1]);
    call.of_q.of[lane_] = per, call.of_rate.of[lane_] = 0;
    for (int k = 0; k < points; ++k) of_past[ring(k)].of[lane_] = -per * weights[static_cast<std::size_t>(k)];
}

/// As in Transient.
double Seat::bend() {
    const auto curves = rig_->transient().curves();
    curve_ = 0;
    if (curves.empty()) return 0;
    auto& b = memory_.block;
    std::array<double, 9> times{t_};
    std::copy(times_.begin(), times_.end(), times.begin() + 1);
    std::array<const lanes::Row*, StepControl::curve_points + 1> rows{b.x};
    for (int k = 0; k < StepControl::curve_points; ++k) rows[static_cast<std::size_t>(k) + 1] = b.past_x + ring(k) * b.unknowns;
    const auto curve = least_bend(times, seen_, [&](const PastWeights& w, int points) {
        double worst = 0;
        for (const int n : curves) {
            double sum = 0;
            for (std::size_t k = 0; k <= static_cast<std::size_t>(points); ++k) sum += w[k] * rows[k][n].of[lane_];
            const double tolerance = plan_.reltol * b.scale[n].of[lane_] + (b.voltage[n] ? plan_.vntol : plan_.abstol);
            worst = std::max(worst, std::abs(sum) / (b.voltage[n] ? tolerance : Bend::current_may * tolerance));
        }
        return worst;
    });
    curve_ = curve.points;
    return curve.off;
}

/// Decides about the step after the Newton iterations. error infinite: they diverged.
Seat::Judged Seat::judge(double error) {
    const bool diverged = std::isinf(error);
    if (!diverged && far_ && !(error > hopeless_lane_error)) return Judged::goes_on;
    off_ = diverged ? 0 : bend();
    const double worst = jump_ ? error : std::max(error, off_);
    jumped_ = !diverged && worst <= 1 && off_ > 1;
    if (!diverged && worst <= 1) return Judged::accepted;
    ++answer_.work.rejected;
    if (diverged) ++answer_.work.lost;
    work_ = Work::nothing, bent_ = false;
    if (pace_.shorten(t_ - times_[0], diverged ? 0 : worst, points_ > 1 ? times_[0] - times_[1] : 0)) work_ = Work::restart;
    return pace_.h >= min_lane_step * plan_.stop ? Judged::rejected : Judged::fails;
}

void Seat::choose(double error, double lower, double higher) {
    const double now = times_[0], planned = pace_.h;
    const int order = pace_.order;
    pace_.choose(t_ - now, error, points_, std::min(plan_.order, points_ - 1), [&](int other) { return other < order ? lower : higher; });
    if (!jump_) pace_.hold(t_ - now, off_, curve_);
    if (jumped_) curve_ = 2;
    if (last_ && t_ - now < planned) pace_.h = std::max(pace_.h, std::min(planned, plan_.longest));
}

/// Makes the end of the step the newest point.
void Seat::advance() {
    auto& b = memory_.block;
    const int capacity = static_cast<int>(b.points);
    pace_.took(t_ - times_[0]);
    newest_ = (newest_ + capacity - 1) % capacity, points_ = std::min(points_ + 1, capacity), seen_ = std::min(seen_ + 1, capacity);
    std::copy_backward(times_.begin(), times_.end() - 1, times_.end());
    times_[0] = t_;
    const auto first = static_cast<std::size_t>(newest_) * b.unknowns;
    for (std::size_t n = 0; n < b.unknowns; ++n) {
        x_[n] = b.past_x[first + n].of[lane_] = b.x[n].of[lane_];
        b.past_q[first + n].of[lane_] = b.q[n].of[lane_];
    }
    bent_ = last_ || jumped_;
    ++answer_.work.steps, ++pace_.since_choice, pace_.failures = 0;
    work_ = bent_ ? Work::restart : Work::nothing;
}

bool Seat::accepted() {
    const double from = times_[0];
    advance();
    spend(from);
    if (const auto at = spike(); at && std::ceil(*at / chip_->T) < static_cast<double>(chip_->force.size())) answer_.spikes.push_back(*at);
    look_at_samples();
    answer_.capped = options_->most_iterations > 0 && answer_.work.iterations > options_->most_iterations;
    return !answer_.capped && times_[0] < end_;
}

double Seat::between(double t, int unknown) const {
    if (unknown < 0) return 0;
    if (const auto source = rig_->transient().given(t, unknown)) return *source;
    const int points = curve_ > 0 ? curve_ : std::min(std::max(pace_.order + 1, 4), points_);
    const auto w = weights_of_value(times(points), t);
    double sum = 0;
    for (int k = 0; k < points; ++k)
        sum += w[static_cast<std::size_t>(k)] * past(memory_.block.past_x, k, static_cast<std::size_t>(unknown));
    return sum;
}

std::optional<double> Seat::spike() const {
    const auto& o = chip_->design->spike_output;
    const auto u = [&](int k, int unknown) { return unknown < 0 ? 0 : past(memory_.block.past_x, k, static_cast<std::size_t>(unknown)); };
    const double sign = o.is_rising ? 1 : -1;
    const auto beyond = [&](int k) { return sign * (u(k, o.unknowns.plus) - u(k, o.unknowns.minus) - o.level); };
    return crossing_within(times_[1], times_[0], beyond(1), beyond(0),
                           [&](double t) { return sign * (between(t, o.unknowns.plus) - between(t, o.unknowns.minus) - o.level); });
}

/// For all samples up to the current time: records the probes and checks the operating ranges.
void Seat::look_at_samples() {
    const auto& design = *chip_->design;
    const auto every = static_cast<std::int64_t>(options_->show_every), count = static_cast<std::int64_t>(chip_->force.size());
    if (design.operating_ranges.empty() && every == 0) return;
    const auto& system = rig_->context().system;
    for (; sample_ < count && static_cast<double>(sample_) * chip_->T <= times_[0]; ++sample_) {
        const double t = static_cast<double>(sample_) * chip_->T;
        const auto value = [&](int u) {
            return sample_ > 0 ? between(t, u) : u < 0 ? 0 : past(memory_.block.past_x, 0, static_cast<std::size_t>(u));
        };
        for (std::size_t k = 0; k < design.operating_ranges.size(); ++k)
            if (auto& o = answer_.outside[k]; !design.operating_ranges[k].contains(design.operating_ranges[k].quantity.value(system, value)))
                o = {o.samples + 1, o.first_sample < 0 ? sample_ : o.first_sample};
        for (std::size_t p = 0; every > 0 && sample_ % every == 0 && p < design.probes.size(); ++p)
            answer_.shown[p].push_back(static_cast<float>(design.probes[p].value(system, value)));
    }
}

/// Adds the energy of the last step, by the trapezoidal rule for the power.
void Seat::spend(double from) {
    const double half = (times_[0] - from) / 2;
    const auto last = power_;
    power_ = rig_->meter().delivered_at(x_, times_[0]);
    answer_.spent += {2 * half, half * (last.supplies + power_.supplies), half * (last.sensor + power_.sensor)};
}

}  // namespace corpuscle::circuit
