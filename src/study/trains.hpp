#pragma once
// One afferent under one stimulus, for studies.

#include <map>
#include <string>
#include <vector>

#include "model/catalog.hpp"
#include "signal/source.hpp"
#include "study/line.hpp"

namespace corpuscle {

struct Asked {
    std::string afferent, stimulus = "press";  ///< the afferent may be a netlist, such as "sa1-circuit"
    std::vector<std::string> settings = {};    ///< "press.F_max=2N", of either
    double rate = 10e3;                        ///< Hz
    std::uint64_t seed = 0;
    std::vector<std::string> traces = {};  ///< inner quantities to be told: "u", "I_B"; of a netlist "v(vf)", "i(m1)", as --trace has them
    Method method = Method::exact;         ///< of a model
    bool sampled = false;                  ///< spikes on the samples, as in the thesis
};

/// What it answers: the times of its spikes, s, and what it means to be outside each range that it left on the way.
struct Told {
    std::vector<double> spikes;
    std::vector<std::string> outside;
    std::map<std::string, Line> traces;  ///< over time, s; by the names asked for
};
Result<Told> told_of(const Asked&);

/// The times alone.
Result<std::vector<double>> train_of(const Asked&);

/// The force that `train_of` hands it, N, and the stimulus's phases.
struct Touched {
    Clock clock;
    std::vector<double> force;
    std::vector<Phase> phases;
    Line line() const;  ///< the force over time
};
Result<Touched> touch_of(const Asked&);

}  // namespace corpuscle
