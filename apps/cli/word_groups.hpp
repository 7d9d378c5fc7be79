#pragma once
// Groups of options, several of which are shared between verbs.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// The error of a report page whose name does not end in .html.
std::string page_name_needed(const std::string& name);

/// The error of a force in the place of a report page's name, with the command that works.
std::string force_behind_report(const std::string& name, std::vector<std::string> forces);

void add_netlist_words(CLI::App&, NetlistWords&);
/// All recording options but --rate, which has further meanings.
void add_recording_words(CLI::App&, RecordingWords&);
void add_skin_words(CLI::App&, RespondWords&);

}  // namespace corpuscle
