#pragma once
// Simulates one afferent under one stimulus, for studies.

#include <map>
#include <string>
#include <vector>

#include "core/force_source.hpp"
#include "model/catalog.hpp"
#include "reproduction/claims/study_curve.hpp"

namespace corpuscle {

struct TrialSpec {
    std::string afferent, stimulus = "press";  ///< the afferent may be a netlist, such as "sa1-circuit"
    std::vector<std::string> settings = {};    ///< parameters of the afferent or the stimulus: "press.F_max=2N"
    double rate = 10e3;                        ///< Hz, sample rate
    std::uint64_t seed = 0;                    ///< of the stimulus
    std::vector<std::string> probes = {};      ///< recordable quantities: "u", "I_B"; of a netlist "v(vf)", "i(m1)", as for --probe
    Method method = Method::exact;             ///< only for models
    bool sampled = false;                      ///< true: spikes at sample times, as in the thesis
};

/// The response of the afferent.
struct TrialResult {
    std::vector<double> spikes;                ///< times, s; the first sample of the force is at 0 s
    std::vector<std::string> range_warnings;   ///< ValidRange::meaning of each range that was violated
    std::map<std::string, StudyCurve> probes;  ///< over time in s; by the names in TrialSpec::probes
};
/// Simulates the afferent under the complete stimulus.
Result<TrialResult> run_trial(const TrialSpec&);

/// As run_trial, but returns only the spike times, s.
Result<std::vector<double>> simulate_train(const TrialSpec&);

/// The stimulus of a trial.
struct TrialForce {
    Clock clock;
    std::vector<double> force;  ///< N
    std::vector<Phase> phases;
    StudyCurve curve() const;  ///< the force over time in s
};
/// Computes the stimulus that run_trial() uses.
Result<TrialForce> trial_force(const TrialSpec&);

}  // namespace corpuscle
