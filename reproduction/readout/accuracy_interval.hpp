#pragma once
// How sure an accuracy is that was counted in trials, some of which belong together.

#include <cstddef>
#include <string>
#include <vector>

namespace corpuscle {

/// A mean accuracy and its 95 % interval.
struct Accuracy {
    double mean = 0, low = 0, high = 0;
};

/// The mean of `correct`, one number from 0 to 1 for each trial, and its interval (Wilson 1927, J Am Stat Assoc 22:209). Trials of one
/// group, such as those of one passage, may be right or wrong together. The number of trials counts as divided by the design effect (Kish
/// 1965): the variance of the mean that the spread between the groups gives, over that of independent trials, but at least 1. If all
/// trials are right, or all wrong, there is no spread, and each group counts as one trial.
Accuracy accuracy_interval(const std::vector<double>& correct, const std::vector<std::size_t>& group);

/// "95 % interval 69 to 95 %".
std::string interval_text(const Accuracy&);

}  // namespace corpuscle
