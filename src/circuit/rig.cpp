#include "circuit/rig.hpp"

#include <fmt/format.h>
#include <cmath>

#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double long_ago = 100;                         // s: then the transient's time begins anew, so that it keeps its digits
constexpr double end_of_time = 1e3, end_of_clock = 1e5;  // s: of a transient; of one whose time cannot begin anew

void put(std::vector<double>& out, std::span<const double> x) { out.insert(out.end(), x.begin(), x.end()); }

}  // namespace

Result<std::unique_ptr<Rig>> Rig::make(const CircuitDesign& design, double T, const std::optional<Draw>& chip) {
    auto bench = TestBench::make(design.circuit);
    if (!bench) return bench.error();
    std::unique_ptr<Rig> rig(new Rig(design, T));
    rig->bench_ = std::move(*bench);
    if (chip) rig->bench_->draw(*chip);
    auto& system = rig->bench_->system;
    system.go(design.times.step > 0 ? design.times.step : T, design.times.stop > 0 ? design.times.stop : 1);
    for (const auto& d : system.devices()) rig->clocked_ |= d->varies();
    system.hear(&rig->trace_);
    rig->rest();
    auto plan = design.plan;
    plan.stop = rig->clocked_ ? end_of_clock : end_of_time;
    rig->transient_.emplace(system, rig->bench_->newton, plan);
    (void)rig->transient_->begin(rig->rest_);  // it is the order of elimination that comes of it
    return rig;
}

/// Where it is at 0 N; if nowhere, as .ic has it.
void Rig::rest() {
    auto found = beginning(*bench_, design_.times.uic);
    rest_ = found ? std::move(found->x) : beginning(*bench_, true)->x;
    meter_.emplace(bench_->system, rest_, bench_->tolerances.gmin);
}

void Rig::draw(const Draw& chip) {
    bench_->draw(chip);
    trace_ = Trace(trace_.T());
    rest();
}

Result<Beginning> Rig::resting(std::span<const double> force, std::vector<double> from) {
    trace_ = Trace(trace_.T());
    trace_.append(force);
    return beginning(*bench_, design_.times.uic, std::move(from));
}

/// Where the circuit rests under this force, or as far on the way there as it can be led from 0 N.
std::vector<double> Rig::led_to(double force) {
    constexpr double shortest = 1.0 / 64;  // of the way
    auto there = rest_;
    for (double part = 0, step = 0.25; part < 1 && step >= shortest;) {
        const double next = std::min(1.0, part + step), steady[] = {next * force, next * force};
        if (auto x = resting(steady, there))
            part = next, there = std::move(x->x);
        else
            step /= 2;
    }
    return there;
}

Result<void> Rig::begin(std::span<const double> force) {
    origin_ = 0, coming_.reset(), now_.reset();
    auto x = resting(force, rest_);
    if (!x) x = resting(force, led_to(force[0]));
    if (!x) {
        auto error = x.error();
        error.sentence = fmt::format("under the first force, {}: {}", format_quantity(force[0], "N"), error.sentence);
        return error;
    }
    start_ = std::move(x->x);
    return transient_->begin(start_, x->settled, x->charge);
}

Result<void> Rig::step() {
    if (!clocked_ && transient_->time() > long_ago) shift();
    if (clocked_ && transient_->time() >= end_of_clock)
        return bad_input(fmt::format("a netlist with sources that go by time runs for {:g} s at the most", end_of_clock),
                         {design_.circuit->file});
    const double from = transient_->time();
    if (!now_) now_ = meter_->delivered(transient_->x(), from);
    const auto stepped = transient_->step(trace_.known());
    if (!stepped) return stepped.error();
    if (!*stepped) return bad_input("a step depends on force that has not come yet", {design_.circuit->file});  // never, see delay()
    spend(from);
    const auto spike = design_.output.within(*transient_);
    if (!spike) return {};
    const double at = *spike / trace_.T(), before = std::ceil(at) - 1;
    coming_ = {origin_ + static_cast<std::int64_t>(before) + 1, at - before, 0};
    return {};
}

/// What the last step took, as if power went straight.
void Rig::spend(double from) {
    const double to = transient_->time(), half = (to - from) / 2;
    const auto then = *now_;
    now_ = meter_->delivered(transient_->x(), to);
    spent_ += {to - from, half * (then.supplies + now_->supplies), half * (then.sensor + now_->sensor)};
}

void Rig::shift() {
    const auto samples = static_cast<std::int64_t>(std::floor(transient_->time() / trace_.T()));
    auto state = transient_->save();
    for (auto& point : state.past) point.t -= static_cast<double>(samples) * trace_.T();
    transient_->restore(state);
    trace_.shift(samples);
    origin_ += samples;
}

double Rig::shown(const Saved& saved, std::int64_t sample) const {
    if (sample <= 0) return saved.seen(bench_->system, [&](int u) { return u < 0 ? 0 : start_[static_cast<std::size_t>(u)]; });
    const double t = place(sample);
    return saved.seen(bench_->system, [&](int u) { return transient_->between(t, u); });
}

/// What save() gave, number by number; once something is missing or impossible, all that follows is 0.
class Numbers {
    std::span<const double> left_;

public:
    bool good = true;
    explicit Numbers(std::span<const double> in) : left_(in) {}

    double next() {
        good &= !left_.empty();
        if (!good) return 0;
        const double x = left_.front();
        left_ = left_.subspan(1);
        return x;
    }
    std::int64_t whole(double low, double high) {
        const double x = next();
        good &= x >= low && x <= high && x == std::floor(x);
        return good ? static_cast<std::int64_t>(x) : 0;
    }
    std::vector<double> many(std::size_t count) {
        good &= left_.size() >= count;
        if (!good) return std::vector<double>(count);
        std::vector<double> out(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(count));
        left_ = left_.subspan(count);
        return out;
    }
    std::span<const double> rest() const { return left_; }
};

void Rig::save(std::vector<double>& out) {
    const auto s = transient_->save();
    trace_.forget(transient_->time());
    put(out, std::vector<double>{static_cast<double>(origin_), static_cast<double>(coming_.has_value()),
                                 static_cast<double>(coming_.value_or(Spike{}).step), coming_.value_or(Spike{}).offset});
    put(out, start_);
    put(out, std::vector<double>{static_cast<double>(s.past.size()), static_cast<double>(s.order), static_cast<double>(s.since_choice),
                                 static_cast<double>(s.failures), static_cast<double>(s.calming), static_cast<double>(s.starting),
                                 static_cast<double>(s.bent), static_cast<double>(s.count), static_cast<double>(s.curve),
                                 static_cast<double>(s.opening), s.h, s.bend, s.calm, static_cast<double>(s.work.steps),
                                 static_cast<double>(s.work.rejected), static_cast<double>(s.work.lost),
                                 static_cast<double>(s.work.iterations)});
    for (const auto& point : s.past) out.push_back(point.t), put(out, point.x), put(out, point.q);
    put(out, s.scale), put(out, s.rate), put(out, s.turn), put(out, s.fastest), put(out, s.memory);
    put(out, std::vector<double>(s.alternations.begin(), s.alternations.end()));
    trace_.save(out);
}

void Rig::read(Numbers& in, TransientState& s) {
    constexpr double most = 0x1p53;
    const auto size = start_.size();
    const auto points = static_cast<std::size_t>(in.whole(1, Past::most));
    s.order = static_cast<int>(in.whole(1, design_.plan.order));
    s.since_choice = static_cast<int>(in.whole(0, 1e9)), s.failures = static_cast<int>(in.whole(0, 1e9));
    s.calming = static_cast<int>(in.whole(0, 2)), s.starting = in.whole(0, 1) != 0, s.bent = in.whole(0, 1) != 0;
    s.count = static_cast<int>(in.whole(1, static_cast<double>(points)));
    s.curve = static_cast<int>(in.whole(0, static_cast<double>(points))), s.opening = static_cast<int>(in.whole(0, 2));
    s.h = in.next(), s.bend = in.next(), s.calm = in.next();
    for (long* n : {&s.work.steps, &s.work.rejected, &s.work.lost, &s.work.iterations}) *n = in.whole(0, most);
    for (std::size_t k = 0; k < points; ++k) {
        s.past.push_back({in.next(), in.many(size), in.many(size)});
        in.good &= std::abs(s.past[k].t) <= end_of_clock && (k == 0 || s.past[k].t < s.past[k - 1].t);
    }
    s.scale = in.many(size), s.rate = in.many(size), s.turn = in.many(size), s.fastest = in.many(size),
    s.memory = in.many(bench_->system.fresh_memory().size());
    for (std::size_t n = 0; n < size; ++n) s.alternations.push_back(static_cast<int>(in.whole(0, 1e9)));
    in.good &= s.h > 0 && s.bend > 0 && s.calm >= 0;
}

bool Rig::restore(std::span<const double> values, std::int64_t samples) {
    constexpr double most = 0x1p53;
    Numbers in(values);
    origin_ = in.whole(0, most);
    const bool spike = in.whole(0, 1) != 0;
    const Spike at{in.whole(0, most), in.next(), 0};
    coming_ = spike ? std::optional(at) : std::nullopt;
    start_ = in.many(static_cast<std::size_t>(bench_->system.size()));
    TransientState s;
    now_.reset(), spent_ = {};
    read(in, s);
    if (!in.good || !trace_.restore(in.rest()) || trace_.end() + origin_ != samples) return false;
    if (!transient_->begin(start_)) return false;
    transient_->restore(s);
    return true;
}

}  // namespace corpuscle::circuit
