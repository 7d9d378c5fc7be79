#pragma once
// A chip under the press beside the model that it is made after.

#include "study/thesis/press.hpp"

namespace corpuscle {

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
