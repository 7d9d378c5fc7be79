#pragma once

#include <string>

namespace corpuscle::test {

std::string source_root();   ///< path of the source tree
std::string program_path();  ///< path of the program `corpuscle`

}  // namespace corpuscle::test
