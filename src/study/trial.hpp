#pragma once
// One afferent with one stimulus, for studies.

#include <map>
#include <string>
#include <vector>

#include "model/catalog.hpp"
#include "signal/force_source.hpp"
#include "study/study_curve.hpp"

namespace corpuscle {

struct TrialSpec {
    std::string afferent, stimulus = "press";  ///< the afferent may be a netlist, such as "sa1-circuit"
    std::vector<std::string> settings = {};    ///< "press.F_max=2N", of afferent or stimulus
    double rate = 10e3;                        ///< Hz
    std::uint64_t seed = 0;
    std::vector<std::string> probes = {};  ///< recordable quantities: "u", "I_B"; of a netlist "v(vf)", "i(m1)", as for --probe
    Method method = Method::exact;         ///< of a model afferent
    bool sampled = false;                  ///< spikes at sample times, as in the thesis
};

/// The response: spike times, s, and a warning for each range that the afferent left.
struct TrialResult {
    std::vector<double> spikes;
    std::vector<std::string> range_warnings;
    std::map<std::string, StudyCurve> probes;  ///< over time, s; by the requested names
};
Result<TrialResult> run_trial(const TrialSpec&);

/// Only the spike times.
Result<std::vector<double>> simulate_train(const TrialSpec&);

/// The force used by `simulate_train`, N, and the stimulus's phases.
struct TrialForce {
    Clock clock;
    std::vector<double> force;
    std::vector<Phase> phases;
    StudyCurve curve() const;  ///< the force over time
};
Result<TrialForce> trial_force(const TrialSpec&);

}  // namespace corpuscle
