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

/// For each tested trial whether its class is read correctly by a read-out that has learned from other trials.
///
/// The read-out is a ridge regression of a 1 for the trial's class and a 0 for each other class. The largest value is the class that is
/// read; the first one if several are equal. Each feature is scaled to mean 0 and deviation 1 over the trials that are learned. A feature
/// that is constant there is ignored. `ridge` is relative to the mean square of a trial's features.
std::vector<bool> read_correctly(const std::vector<const ReadoutTrial*>& learned, const std::vector<const ReadoutTrial*>& tested,
                                 double ridge = 0.03);

/// The fraction of the trials whose class is read correctly (see read_correctly), with cross-validation: trial k is read by a read-out that
/// has learned from the trials j with j / block % folds != k / block % folds. So `block` trials that follow each other are left out
/// together; with as many as there are classes, in turn, each fold has all classes equally often.
double readout_accuracy(const std::vector<ReadoutTrial>&, std::size_t folds, std::size_t block, double ridge = 0.03);

}  // namespace corpuscle
