#pragma once
// Words that several verbs take, or that make a group of their own.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// The error of a page whose name is none.
std::string page_name_needed(const std::string& name);

/// The error of a force that stands where a page's name may.
std::string force_behind_report(const std::string& name, std::vector<std::string> forces);

void add_netlist_words(CLI::App&, NetlistWords&);
/// How a recording is to be read, but for --rate, which means other things besides.
void add_recording_words(CLI::App&, RecordingWords&);
void add_skin_words(CLI::App&, RespondWords&);

}  // namespace corpuscle
