#include "support/test_paths.hpp"

namespace corpuscle::test {

std::string source_root() { return CORPUSCLE_ROOT; }
std::string program_path() { return CORPUSCLE_PROGRAM; }

}  // namespace corpuscle::test
