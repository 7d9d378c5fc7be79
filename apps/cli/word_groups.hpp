#pragma once
// Words that several verbs take, or that make a group of their own.

#include "verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

void add_netlist_words(CLI::App&, NetlistWords&);
void add_skin_words(CLI::App&, RespondWords&);
/// --transpose and --no-transpose, which share a value.
void add_orientation(CLI::App&, std::optional<bool>&, const std::string& group);

}  // namespace corpuscle
