#include "reproduction/nerve/vibration_response.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "measure/measures.hpp"
#include "reproduction/nerve/graded_trials.hpp"

namespace corpuscle {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The mean phase of the spikes of the window in a cycle of the stimulus, in cycles.
double mean_phase(const std::vector<double>& train, const TimeWindow& window) {
    double x = 0, y = 0;
    for (const double t : train) {
        if (t < window.from) continue;
        const double angle = 2 * std::numbers::pi * window.stimulus_frequency * t;
        x += std::cos(angle), y += std::sin(angle);
    }
    return std::atan2(y, x) / (2 * std::numbers::pi);
}

/// The part of a window with complete cycles that begin half a cycle before the mean phase of the spikes, so that few spikes are near the
/// end of a cycle.
TimeWindow centred_cycles(const std::vector<double>& train, const TimeWindow& window) {
    const double f = window.stimulus_frequency, begin = mean_phase(train, window) - 0.5;
    const double from = (std::ceil(window.from * f - begin) + begin) / f, cycles = std::floor((window.to - from) * f + 1e-9);
    return {from, from + cycles / f, f};
}

/// The response of one copy.
CycleResponse cycle_response(double amplitude, const std::vector<double>& train, const TimeWindow& window) {
    const auto cycles = centred_cycles(train, window);
    const double count = std::round((cycles.to - cycles.from) * cycles.stimulus_frequency);
    return {amplitude, measure<SpikeCount>(train, cycles) / count, measure<Entrainment>(train, cycles) == 1,
            measure<VectorStrength>(train, cycles)};
}

/// The response of several copies together.
CycleResponse combined(std::span<const CycleResponse> copies) {
    CycleResponse out = copies.front();
    for (const auto& c : copies.subspan(1)) {
        out.spikes_per_cycle += c.spikes_per_cycle;
        out.one_to_one = out.one_to_one && c.one_to_one;
        out.vector_strength = c.vector_strength >= out.vector_strength ? out.vector_strength : c.vector_strength;
    }
    out.spikes_per_cycle /= static_cast<double>(copies.size());
    return out;
}

double shortest(const std::vector<double>& train, double limit) {
    for (std::size_t k = 1; k < train.size(); ++k) limit = std::min(limit, train[k] - train[k - 1]);
    return limit;
}

}  // namespace

double VibrationResponse::threshold() const {
    for (const auto& r : responses)
        if (r.spikes_per_cycle >= 1) return r.amplitude;
    return none;
}

double VibrationResponse::detection_threshold() const {
    for (const auto& r : responses)
        if (r.spikes_per_cycle > 0) return r.amplitude;
    return none;
}

VibrationResponse::Plateau VibrationResponse::plateau() const {
    Plateau widest{none, none, none}, now = widest;
    for (const auto& r : responses) {
        if (!r.one_to_one) {
            now.low = none;
            continue;
        }
        if (std::isnan(now.low)) now = {r.amplitude, r.amplitude, r.vector_strength};
        now.high = r.amplitude, now.min_vector_strength = std::min(now.min_vector_strength, r.vector_strength);
        if (std::isnan(widest.low) || now.high / now.low > widest.high / widest.low) widest = now;
    }
    return widest;
}

double VibrationResponse::spikes_per_cycle(double amplitude) const {
    double out = none;
    for (const auto& r : responses)
        if (r.amplitude <= amplitude * (1 + 1e-9)) out = r.spikes_per_cycle;
    return out;
}

Result<VibrationResponse> vibrate(const std::string& afferent, double f, std::size_t copies) {
    const double settling = std::ceil(std::max(2.0, 0.3 * f)) / f, measured = std::ceil(std::max(10.0, 0.3 * f)) / f;  // s: whole cycles
    const TimeWindow window{settling, settling + measured, f};
    std::vector<double> amplitudes;  // copies of the same amplitude follow one another
    for (const double a : geometric_series(10e-6, 40, 1.03)) amplitudes.insert(amplitudes.end(), copies, a);
    const TrialSpec sine{afferent,
                         "sine",
                         {"sine.F_mean=1", "sine.F_amp=1", fmt::format("sine.f={}", f), fmt::format("sine.duration={}", window.to)},
                         std::max(5e3, 20 * f)};
    const auto trains = TRY(simulate_factors(sine, amplitudes));
    VibrationResponse out{f, {}, std::numeric_limits<double>::infinity()};
    std::vector<CycleResponse> each;
    for (std::size_t k = 0; k < trains.size(); ++k) {
        each.push_back(cycle_response(amplitudes[k], trains[k], window));
        out.shortest_interval = shortest(trains[k], out.shortest_interval);
        if (each.size() == copies) out.responses.push_back(combined(each)), each.clear();
    }
    return out;
}

double most_excitable(std::span<const VibrationResponse> vibrations, double amplitude) {
    double most = 0, logarithms = 0, count = 0;
    for (const auto& v : vibrations) {
        const double here = v.spikes_per_cycle(amplitude);
        if (here > most) most = here, logarithms = count = 0;
        if (here == most && most > 0) logarithms += std::log(v.f), ++count;
    }
    return count > 0 ? std::exp(logarithms / count) : none;
}

}  // namespace corpuscle
