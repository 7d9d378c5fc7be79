#pragma once
// The arguments of `corpuscle respond`, and the function that runs it.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cli/arguments/netlist_arguments.hpp"
#include "cli/arguments/option_rows.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "cli/verb.hpp"
#include "run/run_inputs.hpp"

namespace corpuscle {

struct RespondArguments {
    std::vector<std::string> forces, afferents = {"sa1", "fa1"};
    std::vector<ParameterOverride> settings, spreads;
    NetlistArguments netlists;
    RecordingOptions recording;  ///< `rate` also applies to stimuli
    RespondOptions simulation;
    bool has_report = false;                                  ///< --report was given
    std::string out, report_file;                             ///< report_file: of --report; "" without a name
    std::string population, contact, checkpoint;              ///< options of a skin; "": not given
    std::map<std::string, std::string, std::less<>> outputs;  ///< the options of the output formats (run/sinks.hpp)
    std::uint32_t copies = 0;                                 ///< 0: not given
    std::uint32_t threads = 0;                                ///< 0: one per core
};

/// Runs the verb. Returns the exit status.
int respond(const RespondArguments&, const CommonArguments&);

}  // namespace corpuscle
