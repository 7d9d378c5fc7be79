#pragma once
// The parts of 'corpuscle fit afferent': its arguments, the reading of its data, and its tables.

#include "cli/arguments/shared_arguments.hpp"
#include "fit/afferent_fit.hpp"

namespace corpuscle {

struct FitArguments {
    std::vector<ForceArgument> forces;
    std::vector<std::string> spike_files;  // one for each force
    std::string targets;                   // instead of forces and spikes: a table
    std::string afferent = "sa1";
    std::vector<std::string> free, bounds, trains;
    std::vector<ParameterOverride> settings;  // of the afferent and of stimuli
    RecordingOptions recording;
    static constexpr double default_rate = 10e3;  // Hz, of stimuli
    double delay = 0;                             // s, of the recorded spikes behind those of the model
    double tau = 10e-3;                           // s
    double hold_out = 0;
    std::uint32_t starts = 8, points = 256, evaluations = 400;
    std::uint64_t seed = 1;
    std::uint32_t threads = 0;
    std::string out;  // file of the fitted values
};

/// Reads the forces and the spikes that were recorded under them.
Result<std::unique_ptr<FitProblem>> read_spike_problem(const FitArguments&, const AfferentPlan&, std::vector<ParameterOverride>& unused);

/// The tables of a result.
std::string fit_tables(const FitResult&, const FitProblem&);

}  // namespace corpuscle
