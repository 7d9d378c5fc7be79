#pragma once
// The measures that a table of targets may have: those of measure/measures.hpp, and some that simulate a stimulus with several strengths.
// To add one, write its function and its row in target_measures.cpp.

#include <functional>

#include "core/error.hpp"
#include "measure/measures.hpp"

namespace corpuscle {

/// The afferent under a stimulus, as far as measures see it.
struct StimulusResponse {
    /// Spike times, s, from the start of the stimulus, when its strength (N) has this value; without a value: as the stimulus is.
    std::function<Result<std::vector<double>>(std::optional<double> strength)> train;
    TimeWindow window;          ///< that is measured, with the stimulus's frequency
    bool has_strength = false;  ///< the stimulus has a parameter that is its strength: F_amp, F_max ...
};

inline constexpr double weakest = 1e-5, strongest = 100;  ///< N, of the strengths that are tried

/// A measure of the response to a stimulus.
struct TargetMeasure {
    MeasureInfo info;
    bool is_logarithmic = false;  ///< deviations are those of the logarithm, as for thresholds
    bool needs_cycle = false, needs_strength = false;
    /// The value; NaN: undefined. Infinity: not reached with any strength; minus infinity: reached with the weakest.
    std::function<Result<double>(const StimulusResponse&)> compute;
};

const std::vector<TargetMeasure>& target_measures();

/// The measure with this name; null if there is none.
const TargetMeasure* find_target_measure(std::string_view name);

}  // namespace corpuscle
