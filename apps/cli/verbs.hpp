#pragma once
// The verbs of the program, in the order of --help. To add verb x, write apps/cli/x.cpp, which defines make_x_verb(), and add a line to
// this list.

#include "cli/verb.hpp"

#define CORPUSCLE_VERBS(VERB) \
    VERB(respond)             \
    VERB(compare)             \
    VERB(study)               \
    VERB(run)                 \
    VERB(export)              \
    VERB(sweep)               \
    VERB(optimize)            \
    VERB(fit)                 \
    VERB(stream)              \
    VERB(list)

namespace corpuscle {

#define CORPUSCLE_DECLARE_VERB(name) Verb make_##name##_verb();
CORPUSCLE_VERBS(CORPUSCLE_DECLARE_VERB)
#undef CORPUSCLE_DECLARE_VERB

// The verbs that may follow "sweep".
Verb make_sweep_merge_verb();
Verb make_sweep_dump_verb();
Verb make_sweep_show_verb();
Verb make_sweep_calibrate_verb();
// The verbs that may follow "fit".
Verb make_fit_afferent_verb();
Verb make_fit_transistor_verb();

/// Makes all verbs of the program.
inline std::vector<Verb> make_verbs() {
    std::vector<Verb> verbs;
#define CORPUSCLE_MAKE_VERB(name) verbs.push_back(make_##name##_verb());
    CORPUSCLE_VERBS(CORPUSCLE_MAKE_VERB)
#undef CORPUSCLE_MAKE_VERB
    return verbs;
}

}  // namespace corpuscle
