#pragma once
// Groups of options; some of the groups belong to several verbs.

#include "cli/verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// The error message for a report page whose name does not end in .html.
std::string page_name_error(const std::string& name);

/// The error message if --report is followed by a force `name` instead of a page. `forces`: the other forces of the command. The message
/// includes the correct command.
std::string report_argument_error(const std::string& name, std::vector<std::string> forces);

void add_netlist_options(CLI::App&, NetlistArguments&);
/// Adds all recording options except --rate, which means something different in each verb.
void add_recording_options(CLI::App&, RecordingArguments&);
void add_skin_options(CLI::App&, RespondArguments&);
/// Adds the option of each output format.
void add_output_formats(CLI::App&, RespondArguments&);

}  // namespace corpuscle
