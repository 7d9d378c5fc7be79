#pragma once

#include <string>

namespace corpuscle::test {

std::string project_root();     ///< the project's folder
std::string program_path();  ///< the path of `corpuscle`

}  // namespace corpuscle::test
