#pragma once
// How an independent source goes in time.

#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// PULSE, SIN, EXP and PWL as SPICE has them. What a netlist leaves out follows from the analysis: a rise and a fall take its step, a
/// pulse and a period its end, a sine goes round once.
class Course {
    Waveform wave_;
    double step_ = 0, stop_ = 0;
    std::vector<double> corners_;  // of what does not repeat, in order

    double number(std::size_t k, double otherwise) const { return k < wave_.numbers.size() ? wave_.numbers[k] : otherwise; }
    double pulse(double t) const;
    double sine(double t) const;
    double frequency() const { return number(2, 0) > 0 ? number(2, 0) : 1 / stop_; }
    double exponential(double t) const;
    double points(double t) const;

public:
    Course(Waveform, double step, double stop);

    double at(double t) const;
    /// The first time after t at which it bends or jumps; infinity: none.
    double next_corner(double t) const;
    /// A part of a sine's period; infinity: corners are all there is.
    double pace() const;
};

}  // namespace corpuscle::circuit
