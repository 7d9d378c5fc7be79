#include "reproduction/texture/slide_spectrum.hpp"

#include <cmath>
#include <numeric>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

/// The frames less their mean, times a Hann window, scaled to deviation 1.
std::vector<double> windowed(std::vector<double> frames) {
    const auto n = static_cast<double>(frames.size());
    const double mean = std::accumulate(frames.begin(), frames.end(), 0.0) / n;
    double squares = 0;
    for (double& x : frames) x -= mean, squares += x * x;
    for (std::size_t k = 0; k < frames.size(); ++k)
        frames[k] *= (0.5 - 0.5 * num::cos_turns(static_cast<double>(k) / n)) / std::sqrt(squares / n);
    return frames;
}

double power_at(const std::vector<double>& values, double frequency) {
    double cosine = 0, sine = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double turns = frequency * static_cast<double>(k) / slide_frame_rate, phase = turns - std::floor(turns);
        cosine += values[k] * num::cos_turns(phase), sine += values[k] * num::cos_turns(phase - 0.25);
    }
    return cosine * cosine + sine * sine;
}

}  // namespace

double strongest_frequency(const TaxelValues& counts, double from, double to) {
    constexpr int steps_per_hertz = 20;
    std::vector<std::vector<double>> taxels;
    for (const auto& frames : counts.frames) taxels.push_back(windowed(frames));
    double best = from, largest = -1;
    for (int k = static_cast<int>(std::ceil(from * steps_per_hertz)); k <= static_cast<int>(to * steps_per_hertz); ++k) {
        const double frequency = static_cast<double>(k) / steps_per_hertz;
        double power = 0;
        for (const auto& values : taxels) power += power_at(values, frequency);
        if (power > largest) largest = power, best = frequency;
    }
    return best;
}

}  // namespace corpuscle
