#pragma once
// The arguments of `corpuscle respond`, and the function that runs it.

#include <map>

#include "cli/arguments/netlist_arguments.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "run/run_inputs.hpp"

namespace corpuscle {

/// The files that the run writes.
struct OutputArguments {
    std::string directory;                                    ///< of --out; "": not given
    std::optional<std::string> page;                          ///< path of the report page; no value without --report
    std::string checkpoint;                                   ///< "": not given
    std::map<std::string, std::string, std::less<>> formats;  ///< the options of the output formats (run/sinks.hpp)
};

struct RespondArguments {
    std::vector<ForceArgument> forces;
    std::vector<std::string> afferents;  ///< of --afferent; default: sa1, fa1. They are read only if there is no --population
    std::vector<ParameterOverride> settings, spreads;
    NetlistArguments netlists;
    RecordingOptions recording;  ///< `rate` also applies to stimuli
    RespondOptions simulation;
    OutputArguments outputs;
    std::string report_file;          ///< of --report; "" without a name
    std::string population, contact;  ///< options of a skin; "": not given
    std::uint32_t copies = 0;         ///< 0: not given
    std::uint32_t threads = 0;        ///< 0: one per core, or one per MPI rank
};

/// Runs the verb. Returns the exit status.
int respond(const RespondArguments&, const CommonArguments&);

}  // namespace corpuscle
