#include "circuit/device/source_waveform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number/elementary.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double no_time = std::numeric_limits<double>::infinity();
using Shape = Waveform::Shape;

}  // namespace

SourceWaveform::SourceWaveform(Waveform wave, double step, double stop) : wave_(std::move(wave)), step_(step), stop_(stop) {
    if (wave_.shape == Shape::piecewise_linear)
        for (std::size_t k = 0; k + 1 < wave_.numbers.size(); k += 2) breakpoints_.push_back(wave_.numbers[k]);
    if (wave_.shape == Shape::exponential) {
        const double rise_delay = number(2, 0);
        breakpoints_ = {rise_delay, number(4, rise_delay + step_)};
    }
    if (wave_.shape == Shape::sine) breakpoints_ = {number(3, 0)};
}

double SourceWaveform::at(double t) const {
    if (wave_.shape == Shape::pulse) return pulse(t);
    if (wave_.shape == Shape::sine) return sine(t);
    if (wave_.shape == Shape::exponential) return exponential(t);
    return wave_.shape == Shape::piecewise_linear ? piecewise_linear(t) : wave_.dc;
}

/// The arguments of PULSE are v1 v2 td tr tf pw per np; np is the number of pulses; 0: no limit.
SourceWaveform::PulseTimes SourceWaveform::pulse_times() const {
    PulseTimes out{positive_or(3, step_), positive_or(4, step_), number(5, stop_), 0};
    out.period = positive_or(6, std::max(stop_, out.rise + out.width + out.fall));
    return out;
}

double SourceWaveform::pulse(double t) const {
    const auto [rise, fall, width, period] = pulse_times();
    const double v1 = number(0, 0), v2 = number(1, 0);
    if (t < number(2, 0)) return v1;
    const double cycle = std::floor((t - number(2, 0)) / period);
    if (const double cycles = number(7, 0); cycles > 0 && cycle >= cycles) return v1;
    // Breakpoints are computed exactly as in next_breakpoint(): on a steep edge one unit in the last place of a time is visible.
    const double start = number(2, 0) + cycle * period, down = start + (rise + width);
    if (t < start + rise) return v1 + (v2 - v1) * ((t - start) / rise);
    if (t < down) return v2;
    return t < start + (rise + width + fall) ? v2 + (v1 - v2) * ((t - down) / fall) : v1;
}

/// The arguments of SIN are vo va freq td theta phase.
double SourceWaveform::sine(double t) const {
    const double elapsed = t - number(3, 0), phase = number(5, 0) / 360;
    if (elapsed < 0) return number(0, 0) + number(1, 0) * num::sin_turns(phase);
    const double turns = frequency() * elapsed + phase;
    return number(0, 0) + number(1, 0) * num::sin_turns(turns - std::floor(turns)) * num::exp(-elapsed * number(4, 0));
}

/// The arguments of EXP are v1 v2 td1 tau1 td2 tau2.
double SourceWaveform::exponential(double t) const {
    const double v1 = number(0, 0), v2 = number(1, 0), up = number(2, 0), down = number(4, up + step_);
    const auto approach = [](double s) { return s * num::exprel(-s); };  // 1 - e^-s, accurate also for small s
    double v = v1;
    if (t > up) v += (v2 - v1) * approach((t - up) / positive_or(3, step_));
    if (t > down) v += (v1 - v2) * approach((t - down) / positive_or(5, step_));
    return v;
}

/// The netlist reader guarantees at least one point, and ascending times.
double SourceWaveform::piecewise_linear(double t) const {
    const auto& x = wave_.numbers;
    const auto after = static_cast<std::size_t>(std::upper_bound(breakpoints_.begin(), breakpoints_.end(), t) - breakpoints_.begin());
    if (after == 0) return x[1];
    if (after == breakpoints_.size()) return x[2 * after - 1];
    const double t0 = x[2 * after - 2], v0 = x[2 * after - 1], t1 = x[2 * after], v1 = x[2 * after + 1];
    return v0 + (v1 - v0) * ((t - t0) / (t1 - t0));
}

double SourceWaveform::max_step() const { return wave_.shape == Shape::sine ? 0.1 / frequency() : no_time; }

double SourceWaveform::next_breakpoint(double t) const {
    if (wave_.shape != Shape::pulse) {
        const auto next = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), t);
        return next == breakpoints_.end() ? no_time : *next;
    }
    const auto [rise, fall, width, period] = pulse_times();
    const double delay = number(2, 0), cycles = number(7, 0);
    if (t < delay) return delay;
    // From one cycle earlier, since the quotient is rounded.
    for (double cycle = std::max(0.0, std::floor((t - delay) / period) - 1);; ++cycle) {
        if (cycles > 0 && cycle > cycles) return no_time;
        for (const double offset : {0.0, rise, rise + width, rise + width + fall})
            if (const double breakpoint = delay + cycle * period + offset; breakpoint > t) return breakpoint;
    }
}

}  // namespace corpuscle::circuit
