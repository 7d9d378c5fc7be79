#pragma once
// Groups of options, several of which are shared between verbs.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// The error of a report page whose name does not end in .html.
std::string page_name_error(const std::string& name);

/// The error of a force instead of a report page's name, with the command that works.
std::string report_argument_error(const std::string& name, std::vector<std::string> forces);

void add_netlist_options(CLI::App&, NetlistArguments&);
/// All recording options but --rate, which has further meanings.
void add_recording_options(CLI::App&, RecordingArguments&);
void add_skin_options(CLI::App&, RespondArguments&);

}  // namespace corpuscle
