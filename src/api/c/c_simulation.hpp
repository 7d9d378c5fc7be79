#pragma once
// The structure corpuscle_simulation of C code, of any version.

#include "corpuscle.h"
#include "corpuscle/respond.hpp"

namespace corpuscle::api {

/// The simulation that a structure of C code describes. NULL is the default. Throws BadCall and InputError.
Simulation simulation_of(const corpuscle_simulation*);

}  // namespace corpuscle::api
