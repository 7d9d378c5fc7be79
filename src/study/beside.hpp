#pragma once
// A chip under the press beside the model that it is made after.

#include "measure/measures.hpp"
#include "study/trains.hpp"

namespace corpuscle {

/// The phases of the thesis's press (1.2), s, and the plateau's last 100 ms.
struct PressPhases {
    static constexpr Stretch rest{0, 0.25}, up{0.25, 0.375}, hold{0.375, 0.625}, late{0.525, 0.625}, down{0.625, 0.75}, after{0.75, 1};
};

double spikes_in(const std::vector<double>& train, Stretch);

/// The thesis's instantaneous frequency, Hz, at each spike but the last (3.3).
Line frequency_of(const std::vector<double>& train);

struct Beside {
    Told chip;                  ///< with the traces asked for
    std::vector<double> model;  ///< its spikes, s
};
/// The chip is asked as it stands; the model's own numbers are the thesis's.
Result<Beside> beside(const Asked& chip, const std::string& model);

/// The largest value of a trace that begins at or after each of these spikes and lasts this long, over the largest in the same time
/// before it: the least of them all.
double least_jump(const Line& trace, const std::vector<double>& spikes, double lasts);

/// How long a trace stays above a level from each crossing on: the longest, s.
double longest_above(const Line& trace, double level);

}  // namespace corpuscle
