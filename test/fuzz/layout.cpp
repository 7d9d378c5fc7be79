// Any bytes as a layout of a recording of three channels: sensors that are channels, or an error that names a line that exists.

#include <cmath>
#include <cstdio>
#include <set>

#include "io/formats.hpp"
#include "io/layout.hpp"
#include "support.hpp"

using namespace corpuscle;

