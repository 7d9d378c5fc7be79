#pragma once
// The deadband of a channel: removes the noise of a sensor at rest and while a force is held, without delay.
//
//     y[k] = the value nearest to y[k-1] between x[k] - b and x[k] + b        (play, or backlash; y[-1] = 0)
//     output = y - b for y > b, y + b for y < -b, otherwise 0
//
// x: the force, b: half the width of the band, N. While the noise stays within +-b, a constant force gives a constant output. A force of
// 0 then gives 0, independent of the force before. A rising force is 2 b too low, a falling one is exact. A reversal takes 2 b.

#include <vector>

#include "core/clock.hpp"

namespace corpuscle {

/// The argument of --deadband.
struct DeadbandOptions {
    /// Half the width of the band, N. nullopt ("auto"): max_noise times the noise that is measured in the rest period of --zero.
    std::optional<double> band = {};
};

/// The standard deviation of noise around `level`, N, estimated from the nine tenths of the samples that are nearest to it. So a few jumps
/// do not count. Reorders the samples.
double noise_deviation(std::vector<double>& samples, double level);

/// A Deadband without a band changes nothing.
class Deadband {
    double band_ = 0, y_ = 0;  // N
    bool is_used_ = false;

public:
    /// Noise within this number of standard deviations is inside a band that is measured. In normally distributed noise, one sample in
    /// 16,000 is further away, and the play needs an excursion of twice the band.
    static constexpr double max_noise = 4;

    Deadband() = default;
    explicit Deadband(double band) : band_(band), is_used_(true) {}
    void set_band(double band) { band_ = band, is_used_ = true; }
    bool is_used() const { return is_used_; }
    double band() const { return band_; }  ///< half the width, N
    double next(double x) {
        if (!is_used_) return x;
        y_ = y_ < x - band_ ? x - band_ : y_ > x + band_ ? x + band_ : y_;
        return y_ > band_ ? y_ - band_ : y_ < -band_ ? y_ + band_ : 0;
    }
};

}  // namespace corpuscle
