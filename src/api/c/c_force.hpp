#pragma once
// The forces of C code.

#include "api/c/c_handle.hpp"
#include "corpuscle/force.hpp"

namespace corpuscle::api {

using Forces = HandleTable<Force, 1>;

}  // namespace corpuscle::api
