#pragma once

#include <string>

namespace corpuscle::test {

std::string root();     ///< the project's folder
std::string program();  ///< the path of `corpuscle`

}  // namespace corpuscle::test
