#pragma once
// The verbs that may follow "sweep", in the order of --help.

#include "cli/verb.hpp"

namespace corpuscle {

Verb make_sweep_merge_verb();
Verb make_sweep_dump_verb();
Verb make_sweep_show_verb();
Verb make_sweep_calibrate_verb();

}  // namespace corpuscle
