#pragma once
// The arguments of `corpuscle respond`, and the function that runs it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/netlist_arguments.hpp"
#include "cli/arguments/option_rows.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "cli/verb.hpp"

namespace corpuscle {

struct RespondArguments : RecordingArguments {
    NetlistArguments netlists;
    std::vector<std::string> forces, afferents = {"sa1", "fa1"}, settings, spreads;
    std::optional<std::string> noise;
    std::string method = "exact";
    bool sampled = false;
    bool has_report = false;                      ///< --report was given
    std::string out, report_file;                 ///< report_file: of --report; "" without a name
    std::string population, contact, checkpoint;  ///< options of a skin; "": not given
    OptionValues outputs;                         ///< the options of the output formats (run/sinks.hpp)
    std::uint64_t seed = 0;
    std::uint32_t copies = 0;   ///< 0: not given
    std::uint32_t threads = 0;  ///< 0: one per core
    bool use_float = false;     ///< --float
};

/// Runs the verb. Returns the exit status.
int respond(const RespondArguments&, const CommonArguments&);

}  // namespace corpuscle
