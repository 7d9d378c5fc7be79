#pragma once
// Finds the contacts in a force: the times at which it leaves its level at rest, and returns to it.

#include <optional>
#include <span>
#include <vector>

#include "core/clock.hpp"

namespace corpuscle {

/// A contact, s on the clock of the force. `release` is infinite if the force ends in contact.
struct ContactInterval {
    double onset = 0, release = 0;
};

struct Contacts {
    double level = 0;                  ///< N, at rest
    double noise = 0;                  ///< N, standard deviation at rest
    double threshold = 0, release = 0;  ///< N: a contact begins above `threshold`, and ends below `release`
    std::vector<ContactInterval> contacts = {};

    std::vector<double> onsets() const;
};

// Definitions. F: the force, N. Quantiles are over all its samples.
//
//     rest       the samples at or below q01 + (q99 - q01) / 4, where q01 and q99 are the quantiles of 1 % and 99 %
//     level      the median of rest
//     noise      the median of |F - level| over rest, divided by 0.6745: the standard deviation of normally distributed noise
//     threshold  level + max(max_noise noise, min_rise (q99 - level)), or as given
//     release    level + (threshold - level) / 2; if the threshold is not above the level, threshold
//
// A contact begins where F rises from below to above the threshold, on the straight line between two samples. It ends at the first sample
// below `release`. A pause shorter than min_pause does not end it. A contact shorter than min_contact is noise. A contact that has begun
// before the first sample has no onset and is left out.

inline constexpr double max_noise_of_rest = 5;    ///< standard deviations
inline constexpr double min_rise_of_contact = 0.02;  ///< of the largest rise
inline constexpr double min_pause = 50e-3;        ///< s
inline constexpr double min_contact = 20e-3;      ///< s

/// `threshold`: N; nullopt: automatic.
Contacts find_contacts(std::span<const double> force, const Clock&, std::optional<double> threshold = {});

}  // namespace corpuscle
