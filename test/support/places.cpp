#include "support/places.hpp"

namespace corpuscle::test {

std::string root() { return CORPUSCLE_ROOT; }
std::string program() { return CORPUSCLE_PROGRAM; }

}  // namespace corpuscle::test
