#pragma once
// One afferent under one stimulus, for studies.

#include <string>
#include <vector>

#include "model/catalog.hpp"
#include "signal/source.hpp"

namespace corpuscle {

struct Asked {
    std::string afferent, stimulus = "press";
    std::vector<std::string> settings = {};  ///< "press.F_max=2N", of either
    double rate = 10e3;                      ///< Hz
    std::uint64_t seed = 0;
};

/// The times of its spikes, s.
Result<std::vector<double>> train_of(const Asked&);

/// The force that `train_of` hands it, N, and the stimulus's phases.
struct Touched {
    Clock clock;
    std::vector<double> force;
    std::vector<Phase> phases;
};
Result<Touched> touch_of(const Asked&);

}  // namespace corpuscle
