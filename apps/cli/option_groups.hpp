#pragma once
// Groups of options, several of which are shared between verbs.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// The error message if the name of a report page does not end in .html.
std::string page_name_error(const std::string& name);

/// The error message if --report is followed by a force instead of a page name. It includes the correct command.
std::string report_argument_error(const std::string& name, std::vector<std::string> forces);

void add_netlist_options(CLI::App&, NetlistArguments&);
/// Adds all recording options except --rate, which means something different in each verb.
void add_recording_options(CLI::App&, RecordingArguments&);
void add_skin_options(CLI::App&, RespondArguments&);

}  // namespace corpuscle
