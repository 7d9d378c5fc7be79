#include "circuit/afferent/streaming_transient.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double max_time_before_shift = 100;  // s; after it the time origin is shifted, since doubles resolve small times better
constexpr double stop_time = 1e3;              // s, end of a transient whose origin can be shifted
constexpr double stop_time_unshifted = 1e5;    // s, end of a transient with sources that depend on absolute time

void append_values(std::vector<double>& out, std::span<const double> x) { out.insert(out.end(), x.begin(), x.end()); }

}  // namespace

Result<std::unique_ptr<StreamingTransient>> StreamingTransient::make(const CircuitAfferentFactory& factory, double T,
                                                                     const std::optional<ChipSample>& chip) {
    auto context = TRY(AnalysisContext::make(factory.circuit));
    std::unique_ptr<StreamingTransient> out(new StreamingTransient(factory, T));
    out->context_ = std::move(context);
    if (chip) out->context_->apply_variation(*chip);
    auto& system = out->context_->system;
    system.start_transient(factory.times.step > 0 ? factory.times.step : T, factory.times.stop > 0 ? factory.times.stop : 1);
    // Before set_force_input(), after which a FORCE source counts as time-dependent, too.
    for (const auto& d : system.devices()) out->is_time_dependent_ |= d->is_time_dependent();
    system.set_force_input(&out->force_);
    out->solve_rest();
    auto plan = factory.plan;
    plan.stop = out->is_time_dependent_ ? stop_time_unshifted : stop_time;
    out->transient_.emplace(system, out->context_->newton, plan);
    (void)out->transient_->begin(out->rest_);  // called only to choose the elimination order
    return out;
}

/// Finds the operating point at 0 N. If the search fails, uses the voltages of .ic: with uic = true, find_initial_condition() solves
/// nothing and cannot fail.
void StreamingTransient::solve_rest() {
    auto found = find_initial_condition(*context_, factory_.times.uic);
    rest_ = found ? std::move(found->x) : find_initial_condition(*context_, true)->x;
    meter_.emplace(context_->system, rest_, context_->tolerances.gmin);
}

void StreamingTransient::set_chip(const ChipSample& chip) {
    context_->apply_variation(chip);
    force_ = ForceWaveform(force_.T());
    solve_rest();
}

Result<InitialCondition> StreamingTransient::solve_start(std::span<const double> force, std::vector<double> from) {
    force_ = ForceWaveform(force_.T());
    force_.append(force);
    return find_initial_condition(*context_, factory_.times.uic, std::move(from));
}

/// The operating point under this force (N), found by raising the force in steps from 0 N. If a step fails, it is halved. If it becomes too
/// small, returns the operating point under the largest force that was reached.
std::vector<double> StreamingTransient::raise_force_from_rest(double force) {
    constexpr double min_step = 1.0 / 64;  // smallest step, as a fraction of the force
    auto found = rest_;
    for (double fraction = 0, step = 0.25; fraction < 1 && step >= min_step;) {
        const double next = std::min(1.0, fraction + step), steady[] = {next * force, next * force};
        if (auto x = solve_start(steady, found))
            fraction = next, found = std::move(x->x);
        else
            step /= 2;
    }
    return found;
}

Result<void> StreamingTransient::begin(std::span<const double> force) {
    origin_sample_ = 0, pending_spike_.reset(), power_now_.reset();
    auto x = solve_start(force, rest_);
    if (!x) x = solve_start(force, raise_force_from_rest(force[0]));
    if (!x) {
        auto error = x.error();
        error.message = fmt::format("under the first force, {}: {}", format_quantity(force[0], "N"), error.message);
        return error;
    }
    start_ = std::move(x->x);
    return transient_->begin(start_, x->is_consistent, x->charge);
}

Result<void> StreamingTransient::step() {
    if (!is_time_dependent_ && transient_->time() > max_time_before_shift) shift_origin();
    if (is_time_dependent_ && transient_->time() >= stop_time_unshifted)
        return bad_input(fmt::format("a netlist whose sources depend on time runs for at most {:g} s", stop_time_unshifted),
                         {factory_.circuit->file});
    const double from = transient_->time();
    if (!power_now_) power_now_ = meter_->delivered_at(transient_->x(), from);
    const auto stepped = TRY(transient_->step(force_.known_until()));
    if (!stepped)
        return bad_input("a time step needs force samples that were not given yet",
                         {factory_.circuit->file});  // cannot happen: delay() is long enough
    add_energy(from);
    const auto spike = factory_.spike_output.find_spike(*transient_);
    if (!spike) return {};
    // The spike is in the interval (before, before + 1], in samples since the origin.
    const double at = *spike / force_.T(), before = std::ceil(at) - 1;
    pending_spike_ = {origin_sample_ + static_cast<std::int64_t>(before) + 1, at - before, 0};
    return {};
}

/// Adds the energy of the step that began at `step_start` and ends now. The power is interpolated linearly.
void StreamingTransient::add_energy(double step_start) {
    const double t = transient_->time(), half = (t - step_start) / 2;
    const auto power_before = *power_now_;
    power_now_ = meter_->delivered_at(transient_->x(), t);
    energy_use_ +=
        {t - step_start, half * (power_before.supplies + power_now_->supplies), half * (power_before.sensor + power_now_->sensor)};
}

/// Moves the origin of time to the last sample before now.
void StreamingTransient::shift_origin() {
    const auto samples = static_cast<std::int64_t>(std::floor(transient_->time() / force_.T()));
    auto state = transient_->save();
    for (auto& point : state.history) point.t -= static_cast<double>(samples) * force_.T();
    transient_->restore(state);
    force_.shift_origin(samples);
    origin_sample_ += samples;
}

double StreamingTransient::probe_value(const SavedQuantity& saved, std::int64_t sample) const {
    if (sample <= 0) return saved.value(context_->system, [&](int u) { return u < 0 ? 0 : start_[static_cast<std::size_t>(u)]; });
    const double t = time_of(sample);
    return saved.value(context_->system, [&](int u) { return transient_->interpolate(t, u); });
}

/// Reads the numbers that save() wrote. After a missing or impossible number, all following values are 0.
class StateReader {
    std::span<const double> rest_;  // the numbers that are not read yet

public:
    bool is_valid = true;  ///< no number was missing or impossible so far
    explicit StateReader(std::span<const double> in) : rest_(in) {}

    double next() {
        is_valid &= !rest_.empty();
        if (!is_valid) return 0;
        const double x = rest_.front();
        rest_ = rest_.subspan(1);
        return x;
    }
    /// An integer from `low` to `high`.
    std::int64_t integer(double low, double high) {
        const double x = next();
        is_valid &= x >= low && x <= high && x == std::floor(x);
        return is_valid ? static_cast<std::int64_t>(x) : 0;
    }
    std::vector<double> many(std::size_t count) {
        is_valid &= rest_.size() >= count;
        if (!is_valid) return std::vector<double>(count);
        std::vector<double> out(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count));
        rest_ = rest_.subspan(count);
        return out;
    }
    std::span<const double> rest() const { return rest_; }
};

void StreamingTransient::save(std::vector<double>& out) {
    const auto s = transient_->save();
    force_.discard_before(transient_->time());
    append_values(out,
                  std::vector<double>{static_cast<double>(origin_sample_), static_cast<double>(pending_spike_.has_value()),
                                      static_cast<double>(pending_spike_.value_or(Spike{}).step), pending_spike_.value_or(Spike{}).offset});
    append_values(out, start_);
    append_values(out, std::vector<double>{static_cast<double>(s.history.size()), static_cast<double>(s.order),
                                           static_cast<double>(s.steps_since_order_change), static_cast<double>(s.failures),
                                           static_cast<double>(s.damping_steps), static_cast<double>(s.is_starting),
                                           static_cast<double>(s.restart_pending), static_cast<double>(s.count),
                                           static_cast<double>(s.curve_points), static_cast<double>(s.start_phase), s.h, s.quadratic_factor,
                                           s.recent_max_step, static_cast<double>(s.stats.steps), static_cast<double>(s.stats.rejected),
                                           static_cast<double>(s.stats.diverged), static_cast<double>(s.stats.iterations)});
    for (const auto& point : s.history) out.push_back(point.t), append_values(out, point.x), append_values(out, point.q);
    append_values(out, s.scale), append_values(out, s.rate), append_values(out, s.rate_change), append_values(out, s.max_rate),
        append_values(out, s.limiting_state);
    append_values(out, std::vector<double>(s.alternations.begin(), s.alternations.end()));
    force_.save(out);
}

void StreamingTransient::read_state(StateReader& in, TransientState& s) {
    constexpr double max_count = 0x1p53;
    const auto size = start_.size();
    const auto points = static_cast<std::size_t>(in.integer(1, History::max_points));
    s.order = static_cast<int>(in.integer(1, factory_.plan.max_order));
    s.steps_since_order_change = static_cast<int>(in.integer(0, 1e9)), s.failures = static_cast<int>(in.integer(0, 1e9));
    s.damping_steps = static_cast<int>(in.integer(0, 2)), s.is_starting = in.integer(0, 1) != 0, s.restart_pending = in.integer(0, 1) != 0;
    s.count = static_cast<int>(in.integer(1, static_cast<double>(points)));
    s.curve_points = static_cast<int>(in.integer(0, static_cast<double>(points))), s.start_phase = static_cast<int>(in.integer(0, 2));
    s.h = in.next(), s.quadratic_factor = in.next(), s.recent_max_step = in.next();
    for (long* n : {&s.stats.steps, &s.stats.rejected, &s.stats.diverged, &s.stats.iterations}) *n = in.integer(0, max_count);
    for (std::size_t k = 0; k < points; ++k) {
        s.history.push_back({in.next(), in.many(size), in.many(size)});
        in.is_valid &= std::abs(s.history[k].t) <= stop_time_unshifted && (k == 0 || s.history[k].t < s.history[k - 1].t);
    }
    s.scale = in.many(size), s.rate = in.many(size), s.rate_change = in.many(size), s.max_rate = in.many(size),
    s.limiting_state = in.many(context_->system.initial_limiting_state().size());
    for (std::size_t n = 0; n < size; ++n) s.alternations.push_back(static_cast<int>(in.integer(0, 1e9)));
    in.is_valid &= s.h > 0 && s.quadratic_factor > 0 && s.recent_max_step >= 0;
}

bool StreamingTransient::restore(std::span<const double> in, std::int64_t samples) {
    constexpr double max_count = 0x1p53;
    StateReader reader(in);
    origin_sample_ = reader.integer(0, max_count);
    const bool has_spike = reader.integer(0, 1) != 0;
    const Spike spike{reader.integer(0, max_count), reader.next(), 0};
    pending_spike_ = has_spike ? std::optional(spike) : std::nullopt;
    start_ = reader.many(static_cast<std::size_t>(context_->system.size()));
    TransientState s;
    power_now_.reset(), energy_use_ = {};
    read_state(reader, s);
    if (!reader.is_valid || !force_.restore(reader.rest()) || force_.end_sample() + origin_sample_ != samples) return false;
    if (!transient_->begin(start_)) return false;  // required before Transient::restore()
    transient_->restore(s);
    return true;
}

}  // namespace corpuscle::circuit
