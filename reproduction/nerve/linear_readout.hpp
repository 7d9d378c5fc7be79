#pragma once
// A linear read-out: how well the class of a stimulus can be read from spikes.

#include <cstddef>
#include <vector>

namespace corpuscle {

/// A trial of an experiment: what was measured, and the class of its stimulus, counted from 0.
struct ReadoutTrial {
    std::vector<double> features;  ///< the same number in each trial, at least one
    std::size_t label = 0;
};

/// The fraction of the trials whose class is read correctly, with cross-validation: trial k is read by a read-out that has learned from the
/// trials j with j / block % folds != k / block % folds. So `block` trials that follow each other are left out together; with as many as
/// there are classes, in turn, each fold has all classes equally often.
///
/// The read-out is a ridge regression of a 1 for the trial's class and a 0 for each other class. The largest value is the class that is
/// read. Each feature is scaled to mean 0 and deviation 1 over the trials that are learned, from which the left-out ones are separate. A
/// feature that is constant there is ignored. `ridge` is relative to the mean square of a trial's features.
double readout_accuracy(const std::vector<ReadoutTrial>&, std::size_t folds, std::size_t block, double ridge = 0.03);

}  // namespace corpuscle
